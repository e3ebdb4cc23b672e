#include <gtest/gtest.h>

#include <array>
#include <set>

#include "common/scene/load.h"
#include "common/scene/sha256.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

std::string sha256(const std::string& text) {
  Sha256 hash;
  hash.add(text);
  return hash.hex();
}

// FIPS 180-4 examples, and NIST's million letters.
TEST(Sha256, KnownValues) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, PiecesGiveTheSameAsTheWhole) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += static_cast<char>(i * 7);
  for (std::size_t piece = 1; piece < 140; ++piece) {
    Sha256 hash;
    for (std::size_t at = 0; at < text.size(); at += piece) {
      hash.hex();  // looking does not change it
      hash.add(std::string_view(text).substr(at, piece));
    }
    EXPECT_EQ(hash.hex(), sha256(text)) << piece;
  }
}

const std::string scene_text = R"({
  "airlight": 1,
  "camera": { "position": [0, 1, 6], "look_at": [0, 1, 0], "vertical_fov": 40, "resolution": [320, 200] },
  "sky_distance": 100,
  "medium": { "phase": { "type": "henyey_greenstein", "g": 0.5 }, "albedo": [1, 0.9, 0.8], "ambient": [0.1, 0.2, 0.3],
    "emission": [0.01, 0.02, 0.03], "homogeneous": { "extinction": 0.25 },
    "gaussians": [ { "center": [1, 2, 3], "radius": 0.5, "extinction": 1.5, "albedo": [0.5, 0.6, 0.7], "emission": [4, 5, 6] } ],
    "grid": { "file": "grid.vdb", "name": "density", "translate": [34, 35, 36], "scale": 37.5, "albedo": [0.31, 0.32, 0.33] } },
  "lights": [ { "type": "point", "name": "lamp", "position": [7, 8, 9], "intensity": [10, 11, 12], "radius": 0.125 },
    { "type": "directional", "direction": [0, -1, 0], "irradiance": [13, 14, 15] } ],
  "surfaces": [ { "mesh": "square.obj", "translate": [16, 17, 18], "casts_shadow": false,
    "material": { "diffuse": [0.21, 0.22, 0.23], "specular": [0.24, 0.26, 0.27], "shininess": 28 } } ],
  "background": [29, 31, 32],
  "technique": { "name": "reference", "rays": 33, "kind": "fine" }
})";

class SceneHash : public testing::Test {
 protected:
  SceneHash() {
    folder.write("square.obj", square_obj);
    folder.write("grid.vdb", bytes_of(AIRLIGHT_TEST_DATA "/broken/grid.vdb"));
  }
  std::string hash(const std::string& text) const { return load_scene(folder.write("scene.json", text)).hash; }
  Folder folder;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == text.npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

TEST_F(SceneHash, EveryValueChangesIt) {
  const std::array<std::array<std::string, 2>, 45> changes{{{"[0, 1, 6]", "[0, 1, 5]"},
                                                            {"\"look_at\": [0, 1, 0]", "\"look_at\": [0, 1.5, 0]"},
                                                            {"\"vertical_fov\": 40", "\"vertical_fov\": 41, \"up\": [0, 1, 0]"},
                                                            {"\"vertical_fov\"", "\"up\": [1, 1, 0], \"vertical_fov\""},
                                                            {"320", "321"},
                                                            {"200", "201"},
                                                            {"100", "101"},
                                                            {"henyey_greenstein", "cornette_shanks"},
                                                            {"0.5 }", "0.51 }"},
                                                            {"[1, 0.9,", "[1, 0.91,"},
                                                            {"0.2, 0.3", "0.2, 0.31"},
                                                            {"0.01", "0.011"},
                                                            {"0.25", "0.25000000000000006"},
                                                            {"[1, 2, 3]", "[1, 2, 3.5]"},
                                                            {"\"radius\": 0.5", "\"radius\": 0.75"},
                                                            {"\"extinction\": 1.5", "\"extinction\": 1.25"},
                                                            {"0.5, 0.6", "0.5, 0.65"},
                                                            {"[4, 5, 6]", "[4, 5, 7]"},
                                                            {"lamp", "bulb"},
                                                            {"[7, 8, 9]", "[7, 8, 8]"},
                                                            {"[10, 11", "[10.5, 11"},
                                                            {"0.125", "0.25"},
                                                            {"[0, -1, 0]", "[0, -1, 0.5]"},
                                                            {"14", "14.5"},
                                                            {"17", "17.5"},
                                                            {"false", "true"},
                                                            {"0.22", "0.225"},
                                                            {"0.26", "0.265"},
                                                            {"28", "28.5"},
                                                            {"31, 32", "31, 32.5"},
                                                            {"[34, 35", "[34, 35.5"},
                                                            {"37.5", "38"},
                                                            {"0.32", "0.325"},
                                                            {"\"name\": \"density\", ", "\"size\": 2, "},
                                                            {"reference", "marching"},
                                                            {"33", "34"},
                                                            {"fine", "coarse"},
                                                            {"\"kind\"", "\"sort\""},
                                                            {"\"translate\": [16", "\"scale\": 2, \"translate\": [16"},
                                                            {"\"translate\": [16", "\"rotate\": [0, 1, 0], \"translate\": [16"},
                                                            {"\"translate\": [16", "\"normals\": \"flat\", \"translate\": [16"},
                                                            {"\"sky_distance\": 100,", ""},
                                                            {", \"emission\": [4, 5, 6]", ""},
                                                            {"\"name\": \"lamp\", ", ""},
                                                            {", \"shininess\": 28", ""}}};
  std::set<std::string> hashes{hash(scene_text)};
  for (const auto& [from, to] : changes)
    EXPECT_TRUE(hashes.insert(hash(replaced(scene_text, from, to))).second) << from << " -> " << to;
  std::cout << hashes.size() << " different hashes\n";
}

TEST_F(SceneHash, EveryMeshByteChangesIt) {
  std::set<std::string> hashes{hash(scene_text)};
  folder.write("square.obj", "# a comment\n" + square_obj);
  EXPECT_TRUE(hashes.insert(hash(scene_text)).second);
  folder.write("square.obj", square_obj + "\n");
  EXPECT_TRUE(hashes.insert(hash(scene_text)).second);
}

TEST_F(SceneHash, EveryGridByteChangesIt) {
  std::set<std::string> hashes{hash(scene_text)};
  std::string bytes = bytes_of(folder.file("grid.vdb"));
  bytes[21] ^= 1;  // of the file's own name, which changes no value
  folder.write("grid.vdb", bytes);
  EXPECT_TRUE(hashes.insert(hash(scene_text)).second);
  bytes += ' ';
  folder.write("grid.vdb", bytes);
  EXPECT_TRUE(hashes.insert(hash(scene_text)).second);
}

TEST_F(SceneHash, FormattingOrderAndDefaultsKeepIt) {
  const std::string before = hash(scene_text);
  std::string text = scene_text;
  for (char& c : text) c = c == '\n' ? '\t' : c;
  EXPECT_EQ(hash("// a scene\r\n" + text), before);
  EXPECT_EQ(hash(replaced(scene_text, "\"vertical_fov\": 40, \"resolution\": [320, 200]",
                          "\"resolution\": [320.0, 2e2], /* turned */ \"vertical_fov\": 4.00e1")),
            before);
  EXPECT_EQ(hash(replaced(scene_text, "\"rays\": 33, \"kind\": \"fine\"", "\"kind\": \"fine\", \"rays\": 33.0")), before);
  EXPECT_EQ(hash(replaced(scene_text, "\"vertical_fov\"", "\"up\": [0, 1, 0], \"vertical_fov\"")), before);
  EXPECT_EQ(hash(replaced(scene_text, "\"casts_shadow\"",
                          "\"rotate\": [0, 360, 0], \"prt\": false, \"normals\": \"auto\", \"scale\": 1, \"casts_shadow\"")),
            before);
  EXPECT_EQ(hash(replaced(scene_text, "\"name\": \"density\"", "\"size\": [1, 1, 1]")), before);
  EXPECT_EQ(
      hash(replaced(scene_text, "\"translate\": [16, 17, 18]", "\"transform\": [1,0,0,0, 0,1,0,0, 0,0,1,-0.0, 16,17,18,1]")),
      before);
}

TEST_F(SceneHash, PlacesOfFilesKeepIt) {
  const std::string before = hash(scene_text);
  const Folder other("elsewhere");
  other.write("box.obj", square_obj);
  other.write("grid.vdb", bytes_of(folder.file("grid.vdb")));
  EXPECT_EQ(load_scene(other.write("other.json", replaced(scene_text, "square.obj", "box.obj"))).hash, before);
  EXPECT_EQ(hash(replaced(scene_text, "square.obj", other.file("box.obj"))), before);
  EXPECT_EQ(hash(replaced(scene_text, "square.obj", "../folder/./square.obj")), before);
}

}  // namespace
}  // namespace airlight
