// Edits as lines of a script: read, written, undone, replayed, saved.
#include <gtest/gtest.h>

#include <string>

#include "common/design/edit_script.h"
#include "common/design/scene_document.h"
#include "common/error.h"
#include "common/scene/load.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

const std::string every_edit =
    R"({"edit": "paint", "screen": [[-0.5, 0.25], [0.1, 0.3]], "plane": {"point": [0, 1, 0], "normal": [0, 1, 0.5]}, "radius": 0.75, "extinction": 0.1, "albedo": [0.5, 0.6, 0.7], "emission": [0, 1, 2], "spacing": 0.3, "scatter": 0.2, "seed": 4294967295}
{"edit": "paint", "points": [[0, 0, 0], [1, 2, 3.3333333333333335]]}
{"edit": "airbrush", "points": [[0, 0, 1]], "radius": 0.25, "rate": 7, "seconds": 0.5, "velocity": [1, 0, 0], "spread": 0.5, "acceleration": [0, -1, 0], "drag": 0.25, "diffusion": 0.1, "bounce": 1, "seed": 3}
{"edit": "erase", "screen": [[0.1, 0.2]], "radius": 0.25, "amount": 0.125}
{"edit": "emit", "position": [0, 0, 0], "rate": 3, "lifetime": 4, "time": 5, "velocity": [0, 2, 0], "spread": 0.1, "acceleration": [0, -0.1, 0], "seed": 9}
{"edit": "copy", "from": [-1, -1], "to": [1, 1]}
{"edit": "paste", "offset": [0, 0.5, 0]}
{"edit": "move", "from": [0, 0], "to": [0.5, 0.5], "offset": [1, 0, 0]}
{"edit": "light", "light": "lamp", "position": [1, 2, 3], "power": [4, 5, 6]}
{"edit": "light", "light": "1", "direction": [0, -1, 0.1]}
{"edit": "fog", "extinction": 0.02}
{"edit": "camera", "position": [0, 1, 9], "look_at": [0, 0.5, 0], "up": [0, 1, 0.1], "vertical_fov": 40}
{"edit": "technique", "name": "marching", "settings": {"steps": "64"}}
{"edit": "undo"}
{"edit": "redo"}
)";

const std::string scene_text = R"({
  "airlight": 1,
  "camera": { "position": [0, 1, 8], "look_at": [0, 0.5, 0], "resolution": [64, 48] },
  "medium": { "albedo": [0.9, 0.9, 0.9], "gaussians": [ { "center": [1, 1, 0], "radius": 0.5, "extinction": 1 } ] },
  "lights": [
    { "type": "point", "name": "lamp", "position": [0, 3, 0], "intensity": [10, 10, 10] },
    { "type": "environment", "radiance": [0.1, 0.1, 0.1] },
    { "type": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1] }
  ],
  "surfaces": [ { "mesh": "square.obj", "translate": [-0.5, -0.5, 0], "scale": 3 } ]
}
)";

class DesignEdits : public testing::Test {
 protected:
  DesignEdits() {
    folder.write("square.obj", square_obj);
    path = folder.write("scene.json", scene_text);
  }
  Scene replayed(const std::string& script) const {
    SceneEditor editor{SceneDocument(path).scene()};
    NoProgress none;
    replay(parse_edits(script, "edits.jsonl"), "edits.jsonl", editor, none);
    return editor.scene();
  }
  std::string refused(const std::string& script) const {
    try {
      replayed(script);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
  Folder folder;
  std::string path;
};

TEST_F(DesignEdits, AreReadAndWrittenWithoutLoss) {
  const std::vector<ScriptLine> lines = parse_edits(every_edit, "edits.jsonl");
  ASSERT_EQ(lines.size(), 15U);
  std::string again;
  for (const ScriptLine& l : lines) again += line_of(l.edit);
  EXPECT_EQ(again, every_edit);
  EXPECT_EQ(parse_edits("\n // nothing\r\n\n{\"edit\": \"undo\"} // once\n", "e")[0].place.line, 4);
}

TEST_F(DesignEdits, ReplayToTheSameScene) {
  const Scene a = replayed(every_edit), b = replayed(every_edit);
  EXPECT_GT(a.medium.gaussians.size(), 20U);
  const SceneDocument document(path);
  const std::string text = document.text(a, folder.path());
  EXPECT_EQ(text, document.text(b, folder.path()));

  // Saved and read again it is the same scene, in every bit, also from another folder.
  std::filesystem::create_directories(folder.file("deeper"));
  for (const std::string name : {"saved.json", "deeper/saved.json"}) {
    document.save(a, folder.file(name));
    const Scene c = load_scene(folder.file(name));
    ASSERT_EQ(c.medium.gaussians.size(), a.medium.gaussians.size());
    for (std::size_t i = 0; i < c.medium.gaussians.size(); ++i) {
      const Gaussian &g = c.medium.gaussians[i], &h = a.medium.gaussians[i];
      EXPECT_TRUE(g.center == h.center && g.radius == h.radius && g.extinction == h.extinction && g.albedo == h.albedo &&
                  g.emission == h.emission)
          << i;
    }
    EXPECT_EQ(c.lights[0].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(c.lights[0].power, glm::dvec3(4, 5, 6));
    EXPECT_EQ(c.lights[1].direction, a.lights[1].direction);
    EXPECT_TRUE(c.environment);
    EXPECT_EQ(c.camera.position, glm::dvec3(0, 1, 9));
    EXPECT_EQ(c.medium.extinction, 0.02);
    EXPECT_EQ(c.technique, "marching");
    EXPECT_EQ(c.settings, a.settings);
    ASSERT_EQ(c.surfaces.size(), 1U);
  }
  EXPECT_EQ(load_scene(folder.file("saved.json")).hash, load_scene(folder.file("deeper/saved.json")).hash);
  EXPECT_EQ(document.text(document.scene(), folder.path()).find("vertical_fov"), std::string::npos) << "nothing is added";
}

TEST_F(DesignEdits, AreUndoneInEveryBit) {
  SceneEditor editor{SceneDocument(path).scene()};
  std::vector<std::string> texts;
  const SceneDocument document(path);
  const auto now = [&] { return document.text(editor.scene(), folder.path()); };
  std::vector<Edit> edits;
  for (const ScriptLine& l : parse_edits(every_edit, "e")) edits.push_back(l.edit);
  const std::size_t undoable[] = {0, 1, 2, 3, 4, 7, 8, 9, 10};
  for (const std::size_t i : undoable) {
    texts.push_back(now());
    editor.apply(edits[i]);
  }
  const std::string last = now();
  for (auto text = texts.rbegin(); text != texts.rend(); ++text) {
    editor.apply(UndoEdit{});
    ASSERT_EQ(now(), *text);
  }
  EXPECT_FALSE(editor.can_undo());
  for (std::size_t i = 0; i < texts.size(); ++i) editor.apply(RedoEdit{});
  EXPECT_EQ(now(), last);
  editor.apply(UndoEdit{});
  editor.apply(FogEdit{0.5});
  EXPECT_FALSE(editor.can_redo()) << "another way was taken";
}

TEST_F(DesignEdits, ThatAreWrongAreToldWithTheirPlace) {
  const std::pair<std::string, std::string> cases[] = {
      {"{\"edit\": \"undo\"}", "edits.jsonl:1:1: nothing to undo"},
      {"\n\n{\"edit\": \"piant\"}", "edits.jsonl:3:10: edit: unknown \"piant\", did you mean \"paint\"?"},
      {"{}", "edits.jsonl:1:1: missing key, expected \"edit\""},
      {"[1]", "edits.jsonl:1:1: expected an edit, a JSON object with the key \"edit\""},
      {"{\"edit\": \"undo\"", "edits.jsonl:1:16: unfinished object, expected ',' or '}'"},
      {"{\"edit\": \"undo\"} {\"edit\": \"undo\"}", "edits.jsonl:1:18: unexpected text, expected the end of the file"},
      {"\n{\"edit\": \"erase\", \"points\": [[0, 0, 0]], \"radios\": 1}",
       "edits.jsonl:2:42: unknown key \"radios\", did you mean \"radius\"?"},
      {"{\"edit\": \"erase\", \"points\": [[0, 0, 0]], \"radius\": 0}", "edits.jsonl:1:52: radius: 0, expected a number > 0"},
      {"{\"edit\": \"paint\", \"points\": [[0, 0]]}",
       "edits.jsonl:1:30: points[0]: an array of 2, expected an array of 3 numbers"},
      {"{\"edit\": \"paint\"}", "edits.jsonl:1:1: expected the stroke's points either in \"screen\" or in \"points\""},
      {"{\"edit\": \"paint\", \"screen\": [[0, 0]]}", "edits.jsonl:1:1: missing key, expected \"plane\" beside \"screen\""},
      {"{\"edit\": \"paste\"}", "edits.jsonl:1:1: missing key, expected \"offset\""},
      {"{\"edit\": \"copy\", \"from\": [0, 0], \"to\": [1, 1, 1]}", "edits.jsonl:1:40: to: expected an array of 2 numbers"},
      {"{\"edit\": \"light\", \"light\": \"moon\"}", "edits.jsonl:1:1: no light \"moon\", expected its name or a number below 2"},
      {"{\"edit\": \"light\", \"light\": 0, \"direction\": [1, 0, 0]}", "edits.jsonl:1:1: \"direction\" of a point light"},
      {"{\"edit\": \"camera\", \"look_at\": [0, 1, 8]}", "edits.jsonl:1:1: the camera looks at its own position"},
      {"{\"edit\": \"emit\", \"position\": [0, 0, 0], \"rate\": 1000000, \"lifetime\": 9, \"time\": 9}",
       "edits.jsonl:1:1: the emitter would place 9e+06"},
      {"{\"edit\": \"airbrush\", \"points\": [[0, 0, 0]], \"rate\": 90000, \"seconds\": 9}",
       "edits.jsonl:1:1: the airbrush would take"},
      {"{\"edit\": \"paint\", \"points\": [[0, 0, 0]], \"seed\": 0.5}", "edits.jsonl:1:50: seed: expected a whole number"},
      {"{\"edit\": \"copy\", \"from\": [-9, -9], \"to\": [9, 9]}\n{\"edit\": \"paste\", \"offset\": [1e9, 0, 0]}",
       "edits.jsonl:2:1: a Gaussian would come to"},
  };
  for (const auto& [script, expected] : cases) {
    const std::string told = refused(script);
    EXPECT_EQ(told.substr(0, expected.size()), expected) << script;
    EXPECT_EQ(told.find('\n'), std::string::npos);
  }
}

TEST_F(DesignEdits, RefuseWhatIsNotOneSceneInJson) {
  const std::string moving = folder.write("moving.json", R"({ "airlight": 1, "camera": { "position": [0, 0, 1] },
    "animation": { "tracks": { "camera.position": { "0": [0, 0, 1] } } } })");
  EXPECT_THROW(SceneDocument{moving}, InputError);
  EXPECT_THROW(SceneDocument{folder.file("scene.glb")}, InputError);
}

TEST_F(DesignEdits, MakeTheFogOfTheCity) {
  const std::string scenes = AIRLIGHT_SCENES;
  const SceneDocument clear(scenes + "/fog_city/clear.json");
  SceneEditor editor(clear.scene());
  NoProgress none;
  replay(parse_edits(bytes_of(scenes + "/fog_city.jsonl"), "fog_city.jsonl"), "fog_city.jsonl", editor, none);
  EXPECT_TRUE(clear.text(editor.scene(), scenes) == bytes_of(scenes + "/fog_city.json"))
      << "airlight edit scenes/fog_city/clear.json scenes/fog_city.jsonl -o scenes/fog_city.json";
  EXPECT_GT(editor.scene().medium.gaussians.size(), 200U);
}

}  // namespace
}  // namespace airlight
