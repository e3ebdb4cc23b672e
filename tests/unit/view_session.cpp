// The viewer without its window: how a hand moves the camera, and that what was done by hand is recorded.
#include "app/view_session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/view_camera.h"
#include "common/design/screen.h"
#include "common/error.h"
#include "tests/tolerances.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

Camera oblique() {
  Camera c;
  c.position = {3, 4, 5};
  c.look_at = {1, 1, -1};
  return c;
}

TEST(ViewCamera, TurnsShiftsAndGoesNearer) {
  const Camera c = oblique();
  const double distance = glm::distance(c.position, c.look_at), none = tolerance("design_place");
  const Camera o = orbited(c, {0.7, 0.2});
  EXPECT_EQ(o.look_at, c.look_at);
  EXPECT_NEAR(glm::distance(o.position, o.look_at), distance, none);
  const glm::dvec3 a = c.look_at - c.position, b = o.look_at - o.position;
  EXPECT_NEAR(std::asin(b.y / distance) - std::asin(a.y / distance), 0.2, none) << "up";
  EXPECT_NEAR(std::atan2(b.x, -b.z) - std::atan2(a.x, -a.z), 0.7, none) << "to the right";
  const Camera t = turned(c, {0.7, 0.2});
  EXPECT_EQ(t.position, c.position);
  EXPECT_LT(glm::distance(t.look_at - t.position, b), none);
  const Camera pole = orbited(c, {0, 9});
  EXPECT_GT(glm::length(glm::cross(glm::normalize(pole.look_at - pole.position), pole.up)), 0.017) << "never over it";

  const Camera p = panned(c, {0.5, -0.25});  // what was there is now in the middle
  EXPECT_LT(glm::distance(Screen(c).seen(p.look_at)->at, glm::dvec2(0.5, -0.25)), none);
  EXPECT_NEAR(glm::distance(dollied(c, 0.5).position, c.look_at), distance / 2, none);
  const Camera m = moved(c, {1, 2, 3});
  EXPECT_NEAR(glm::dot(m.position - c.position, Screen(c).forward()), 3, none);
  EXPECT_LT(glm::distance(m.look_at - m.position, a), none);
}

TEST(ViewCamera, FramesWhatMatters) {
  Scene scene;
  scene.camera = oblique();
  scene.medium.gaussians = {{{50, 2, 3}, 4, 1, {}, {}}, {{20, -9, 3}, 1, 1, {}, {}}};
  for (const double aspect : {0.5, 1.0, 2.0}) {
    const Camera c = framing(scene, aspect);
    const Screen screen(c);
    EXPECT_LT(glm::distance(screen.forward(), Screen(scene.camera).forward()), tolerance("design_place"));
    double farthest = 0;
    for (const Gaussian& g : scene.medium.gaussians) {
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p = g.center + g.radius * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const auto seen = screen.seen(p);
        ASSERT_TRUE(seen);
        farthest = std::max({farthest, std::abs(seen->at.y), std::abs(seen->at.x) / aspect});
      }
    }
    EXPECT_LE(farthest, 1) << aspect;
    EXPECT_GT(farthest, 0.3) << "as near as it may be";
  }
}

class ViewSessions : public testing::Test {
 protected:
  ViewSessions() {
    folder.write("square.obj", square_obj);
    path = folder.write("scene.json", R"({ "airlight": 1, "camera": { "position": [0, 1, 8], "look_at": [0, 0.5, 0] },
      "lights": [ { "type": "point", "position": [0, 3, 0], "intensity": [10, 10, 10] } ], "surfaces": [ { "mesh": "square.obj" } ] })");
  }
  static PaintEdit stroke(double x, std::int64_t seed) {
    PaintEdit e;
    e.stroke.screen = {{0, 0}, {x, 0.1}};
    e.stroke.plane = DesignPlane{{0, 0.5, 0}, {0, 0, 1}};
    e.seed = seed;
    return e;
  }
  Folder folder;
  std::string path;
  NoProgress none;
};

TEST_F(ViewSessions, RecordWhatGivesTheSavedScene) {
  ViewSession session(path, folder.file("saved.json"), folder.file("record.jsonl"), none);
  session.begin_record();
  EXPECT_FALSE(session.changed());
  for (const double x : {0.1, 0.2, 0.4}) session.attempt(stroke(x, 1));  // one drag
  const std::size_t once = session.scene().medium.gaussians.size();
  session.look(orbited(session.scene().camera, {0.5, 0.1}));  // in the middle of it: the stroke was drawn from before
  session.attempt(stroke(0.3, 2));
  session.abandon();
  EXPECT_EQ(session.scene().medium.gaussians.size(), once);
  EXPECT_FALSE(session.can_redo()) << "what was given up is no history";
  session.attempt(LightEdit{"0", glm::dvec3(1, 2, 3), {}, {}});
  session.commit();
  session.apply(stroke(-0.4, 3));
  EXPECT_THROW(session.apply(LightEdit{"moon", {}, {}, {}}), InputError);
  session.apply(UndoEdit{});
  session.apply(UndoEdit{});
  session.apply(RedoEdit{});
  session.look(dollied(session.scene().camera, 0.5));
  session.apply(TechniqueEdit{"marching", {{"steps", "32"}}});
  EXPECT_TRUE(session.changed());
  EXPECT_EQ(session.save(), folder.file("saved.json"));
  EXPECT_FALSE(session.changed());
  session.finish();

  const SceneDocument document(path);
  SceneEditor editor(document.scene());
  replay(parse_edits(bytes_of(folder.file("record.jsonl")), "record.jsonl"), "record.jsonl", editor, none);
  EXPECT_EQ(document.text(editor.scene(), folder.path()), bytes_of(folder.file("saved.json")));
  const Scene saved = load_scene(folder.file("saved.json"));
  EXPECT_EQ(saved.medium.gaussians.size(), once);
  EXPECT_EQ(saved.lights[0].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(saved.camera.position, session.scene().camera.position);
}

TEST_F(ViewSessions, LookAtWhatCannotBeSaved) {
  const std::string moving = folder.write("moving.json", R"({ "airlight": 1, "camera": { "position": [0, 0, 1] },
    "animation": { "tracks": { "camera.position": { "0": [0, 0, 2], "4": [0, 0, 1] } } } })");
  ViewSession session(moving, "", "", none);
  EXPECT_EQ(session.scene().camera.position, glm::dvec3(0, 0, 2));
  EXPECT_THROW(session.save(), InputError);
  EXPECT_THROW(ViewSession(folder.file("none.json"), "", "", none), InputError);
}

}  // namespace
}  // namespace airlight
