// NRRD grids: values, places, mistakes.
#include "common/scene/nrrd_file.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>

#include "common/error.h"
#include "common/scene/grid_file.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

std::string header(const std::string& fields) { return "NRRD0004\n# a comment\nkey:=value\ndimension: 3\n" + fields + "\n"; }

std::string message(const std::string& bytes) {
  NoProgress none;
  try {
    read_nrrd("a.nrrd", bytes, none);
  } catch (const InputError& e) {
    std::cout << e.what() << "\n";
    return e.what();
  }
  return "";
}

template <class T>
std::string raw(const std::vector<T>& values, bool big) {
  std::string bytes;
  for (const T v : values) {
    auto one = std::bit_cast<std::array<char, sizeof(T)>>(v);
    if (big == (std::endian::native == std::endian::little)) std::reverse(one.begin(), one.end());
    bytes.append(one.data(), one.size());
  }
  return bytes;
}

TEST(Nrrd, ValuesStandWhereTheFileSays) {
  const Folder folder;
  const std::string where = "sizes: 3 2 1\nspace directions: (0,2,0) (3,0,0) (0,0,5)\nspace origin: (10,20,30)\n";
  const std::vector<float> values{0, 0.5F, 0, 0, 2, 1};
  std::vector<std::string> files{header("type: float\nencoding: ascii\n" + where) + "0 0.5 0\n0 2,1\n"};
  for (const bool big : {false, true}) {
    const std::string rest = "encoding: raw\nendian: " + std::string(big ? "big" : "little") + "\n" + where;
    files.push_back(header("type: float\n" + rest) + raw(values, big));
    files.push_back(header("type: double\n" + rest) + raw(std::vector<double>(values.begin(), values.end()), big));
  }
  NoProgress none;
  for (const std::string& bytes : files) {
    const GridFile file = read_grid_file(folder.write("a.nrrd", bytes), "density", none);
    ASSERT_EQ(file.voxels->size, glm::ivec3(2, 2, 1));
    EXPECT_EQ(file.voxels->values, (std::vector<float>{0.5F, 0, 2, 1}));
    const auto at = [&](const glm::dvec3& cell) { return glm::dvec3(file.transform * glm::dvec4(cell, 1)); };
    EXPECT_EQ(at({0.5, 0.5, 0.5}), glm::dvec3(10, 22, 30));  // cell (1, 0, 0) of the file
    EXPECT_EQ(at({1.5, 1.5, 0.5}), glm::dvec3(13, 24, 30));
  }
  const SparseGrid bytes =
      read_nrrd("a.nrrd", header("type: uchar\nencoding: raw\nsizes: 2 1 1\nspacings: 0.5 1 1\n") + "\1\377", none);
  EXPECT_EQ(bytes.blocks.at(0).values[1], 255);
  EXPECT_EQ(bytes.transform[0][0], 0.5);
}

TEST(Nrrd, MistakesAreToldWhereTheyStand) {
  const auto expect = [](const std::string& bytes, const std::string& told) {
    EXPECT_EQ(message(bytes).rfind("a.nrrd:" + told, 0), 0U) << "expected " << told;
  };
  const std::string sizes = "sizes: 2 1 1\n";
  expect("NRRD0004\ndimension: 4\n", "2: dimension \"4\", expected 3");
  expect(header("type: block\n"), "5: type \"block\"");
  expect(header("sizes: 2 1\n"), "5: 2 numbers, expected 3");
  expect(header("sizes: 2000 2000 2000\n"), "5: 2000 x 2000 x 2000 cells, expected at most");
  expect(header("sizes: 2 1.5 1\n"), "5: a size of 1.5");
  expect(header("encoding: gzip\n"), "5: encoding \"gzip\", expected raw or ascii");
  expect(header("data file: other.raw\n"), "5: values in another file");
  expect(header("nonsense\n"), "5: expected \"field: value\"");
  expect(header("type: float\nencoding: raw\n" + sizes), "8: the header ends without endian");
  expect("NRRD0004\ntype: float\n", "2: the file ends within the header");
  const std::string good = header("type: float\nencoding: raw\nendian: little\n" + sizes);
  expect(good + "1234", " ends at byte " + std::to_string(good.size() + 4) + ", expected 2 values to end at byte");
  expect(good + raw<float>({1, -2}, false), " byte " + std::to_string(good.size() + 4) + ": the value is -2");
  expect(good + raw<float>({0, 0}, false), " no value above 0");
  const std::string text = header("type: float\nencoding: text\n" + sizes);
  expect(text + "1 x\n", "9:3: \"x\", expected a finite number >= 0");
  expect(text + "1\n", "9: the file ends after 1 values, expected 2");
}

}  // namespace
}  // namespace airlight
