// Broken scenes and meshes: each is refused in one line that names the place and what was expected. The table is
// tests/data/broken/expected.tsv.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "common/error.h"
#include "common/scene/load.h"

namespace airlight {
namespace {

const std::string folder = AIRLIGHT_TEST_DATA "/broken/";

struct Broken {
  std::string file, place, fragment;
};

void PrintTo(const Broken& b, std::ostream* out) { *out << b.file; }

std::vector<Broken> table() {
  std::vector<Broken> rows;
  std::ifstream in(folder + "expected.tsv");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream cells(line);
    Broken b;
    std::getline(cells, b.file, '\t');
    std::getline(cells, b.place, '\t');
    std::getline(cells, b.fragment);
    rows.push_back(b);
  }
  return rows;
}

bool is_scene(const std::string& file) { return file.ends_with(".json") || file.ends_with(".gltf") || file.ends_with(".glb"); }

class BrokenInput : public testing::TestWithParam<Broken> {};

TEST_P(BrokenInput, IsRefusedInOneLineWithItsPlace) {
  const Broken& b = GetParam();
  const std::string path = folder + b.file;
  std::string message;
  try {
    NoProgress none;
    if (is_scene(b.file)) {
      load_scene(path, none);
    } else {
      load_mesh(path, false, none);
    }
  } catch (const InputError& e) {
    message = e.what();
  }
  std::cout << message << "\n";
  ASSERT_FALSE(message.empty()) << "no InputError";
  const std::string begin = path + ":" + (b.place == "-" ? "" : b.place + ":") + " ";
  EXPECT_EQ(message.substr(0, begin.size()), begin);
  EXPECT_NE(message.find(b.fragment), message.npos) << "expected in it: " << b.fragment;
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0);
}

INSTANTIATE_TEST_SUITE_P(Files, BrokenInput, testing::ValuesIn(table()), [](const auto& row) {
  std::string name = row.param.file;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.'; }, '_');
  return name;
});

TEST(BrokenInput, HasItsTable) { EXPECT_GE(table().size(), 90U); }

}  // namespace
}  // namespace airlight
