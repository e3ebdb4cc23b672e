#include <gtest/gtest.h>
#include <openvdb/Grid.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "common/error.h"
#include "common/scene/grid_file.h"
#include "common/scene/load.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

using openvdb::Coord;

class GridFiles : public testing::Test {
 protected:
  GridFiles() { openvdb::initialize(); }

  std::string write(const openvdb::GridPtrVec& grids,
                    unsigned compression = openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK) const {
    openvdb::io::File file(folder.file("grid.vdb"));
    file.setCompression(compression);
    file.write(grids);
    return file.filename();
  }
  std::string message(const std::string& path, const std::string& name = "density") const {
    NoProgress none;
    try {
      read_grid_file(path, name, none);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  // Of a grid that holds this beside a good value.
  std::string message_of(float value) const {
    const auto grid = density();
    grid->tree().setValueOn(Coord(-7, 100, 3), value);
    return message(write({grid}));
  }
  static openvdb::FloatGrid::Ptr density() {
    const auto grid = openvdb::FloatGrid::create();
    grid->setName("density");
    grid->tree().setValueOn(Coord(1, 2, 3), 0.5F);
    return grid;
  }
  void expect_part(const std::string& message, const std::string& part) const {
    std::cout << message << "\n";
    EXPECT_EQ(message.rfind(folder.file("grid.vdb") + ": ", 0), 0U) << message;
    EXPECT_NE(message.find(part), message.npos) << message << "\nexpected in it: " << part;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0);
  }
  Folder folder;
};

glm::dvec3 moved(const glm::dmat4& m, const glm::dvec3& p) { return glm::dvec3(m * glm::dvec4(p, 1)); }

TEST_F(GridFiles, ValuesStandWhereTheFileSays) {
  const auto grid = density();
  grid->tree().setValueOn(Coord(-4, 5, 3), 2);
  grid->tree().setValueOn(Coord(40, 50, 60), 0);   // active, but nothing
  grid->tree().setValueOff(Coord(30, 50, 60), 7);  // not active
  grid->setTransform(
      openvdb::math::Transform::createLinearTransform(openvdb::Mat4d(0, 2, 0, 0, 3, 0, 0, 0, 0, 0, 5, 0, 10, 20, 30, 1)));
  NoProgress none;
  const GridFile file = read_grid_file(write({grid}), "density", none);
  const VoxelGrid& v = *file.voxels;
  ASSERT_EQ(v.size, glm::ivec3(6, 4, 1));
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      const float expected = x == 0 && y == 3 ? 2.0F : x == 5 && y == 0 ? 0.5F : 0.0F;
      EXPECT_EQ(v.values[static_cast<std::size_t>(x + 6 * y)], expected) << x << ' ' << y;
    }
  }
  // Index (i, j, k) is at (3 j + 10, 2 i + 20, 5 k + 30), and its value stands in the middle of a cell.
  EXPECT_EQ(moved(file.transform, {5.5, 0.5, 0.5}), glm::dvec3(3 * 2 + 10, 2 * 1 + 20, 5 * 3 + 30));
  EXPECT_EQ(moved(file.transform, {0.5, 3.5, 0.5}), glm::dvec3(3 * 5 + 10, 2 * -4 + 20, 5 * 3 + 30));
  EXPECT_EQ(moved(file.transform, {0, 0, 0}), glm::dvec3(3 * 1.5 + 10, 2 * -4.5 + 20, 5 * 2.5 + 30));
}

template <class Grid>
void expect_same_values(const Grid& grid, const GridFile& file) {
  const VoxelGrid& v = *file.voxels;
  const auto accessor = grid.getConstAccessor();
  const glm::dvec3 first = moved(file.transform, glm::dvec3(0.5));  // no transform: the index
  std::size_t at = 0;
  double sum = 0;
  for (int z = 0; z < v.size.z; ++z) {
    for (int y = 0; y < v.size.y; ++y) {
      for (int x = 0; x < v.size.x; ++x) {
        const Coord c(x + static_cast<int>(first.x), y + static_cast<int>(first.y), z + static_cast<int>(first.z));
        const auto expected = static_cast<float>(accessor.getValue(c));
        ASSERT_EQ(v.values[at++], expected) << c;
        sum += static_cast<double>(expected);
      }
    }
  }
  EXPECT_GT(sum, 0);
  EXPECT_GT(std::count(v.values.begin(), v.values.end(), 0.0F), 0);
}

// Every way to store values, with cells of their own and with tiles of two sizes.
TEST_F(GridFiles, EveryStorageGivesTheSameValues) {
  using namespace openvdb::io;
  const auto fill = [](auto& grid) {
    std::mt19937 random(7);
    grid.setName("density");
    for (int i = 0; i < 3000; ++i) {
      const auto at = [&] { return static_cast<int>(random() % 60U) - 30; };
      const Coord c(at(), at(), at());
      grid.tree().setValueOn(c, static_cast<float>(random() % 64U) / 64);  // exact in 16 bits
    }
    grid.tree().fill(openvdb::CoordBBox(Coord(32, -8, 0), Coord(47, 23, 7)), 0.25F);         // tiles of 8
    grid.tree().fill(openvdb::CoordBBox(Coord(0, -128, -128), Coord(127, -1, -1)), 0.125F);  // one of 128
  };
  NoProgress none;
  int cases = 0;
  for (const bool half : {false, true}) {
    const auto floats = openvdb::FloatGrid::create();
    const auto doubles = openvdb::DoubleGrid::create();
    fill(*floats), fill(*doubles);
    floats->setSaveFloatAsHalf(half), doubles->setSaveFloatAsHalf(half);
    for (const unsigned compression : {unsigned{COMPRESS_NONE}, unsigned{COMPRESS_ZIP}, unsigned{COMPRESS_BLOSC}}) {
      for (const unsigned mask : {0U, unsigned{COMPRESS_ACTIVE_MASK}}) {
        expect_same_values(*floats, read_grid_file(write({floats}, compression | mask), "density", none));
        expect_same_values(*doubles, read_grid_file(write({doubles}, compression | mask), "density", none));
        cases += 2;
      }
    }
  }
  std::cout << cases << " files\n";
}

TEST_F(GridFiles, NamesChoose) {
  const auto one = density(), two = density();
  one->setName("fuel"), two->setName("flame");
  two->tree().setValueOn(Coord(1, 2, 3), 3);
  const std::string path = write({one, two, density()});
  NoProgress none;
  EXPECT_EQ(read_grid_file(path, "fuel", none).voxels->values.at(0), 0.5F);
  EXPECT_EQ(read_grid_file(path, "flame", none).voxels->values.at(0), 3);
  expect_part(message(path, "smoke"), "no grid \"smoke\", expected one of \"fuel\", \"flame\", \"density\"");
  expect_part(message(write({})), "no grid \"density\", expected at least one grid");
}

TEST_F(GridFiles, OtherGridsAreRefusedByTheirKind) {
  auto surface = density();
  surface->setGridClass(openvdb::GRID_LEVEL_SET);
  expect_part(message(write({surface})), "is a level set, expected a fog volume");
  const auto vectors = openvdb::Vec3SGrid::create();
  vectors->setName("density");
  expect_part(message(write({vectors})), "is of type Tree_vec3s_5_4_3, expected Tree_float_5_4_3 or Tree_double_5_4_3");
  const auto numbers = openvdb::Int32Grid::create();
  numbers->setName("density");
  expect_part(message(write({numbers})), "is of type Tree_int32_5_4_3");
  const auto first = density();
  const auto second = first->copyGrid();
  second->setName("copy");
  expect_part(message(write({first, second}), "copy"), "shares the values of another grid");
}

TEST_F(GridFiles, BadContentIsRefusedWithItsPlace) {
  expect_part(message_of(-0.25F), "cell (-7, 100, 3) is -0.25, expected a finite number >= 0");
  expect_part(message_of(std::numeric_limits<float>::infinity()), "cell (-7, 100, 3) is inf");
  expect_part(message_of(std::numeric_limits<float>::quiet_NaN()), "cell (-7, 100, 3) is nan");
  const auto huge = openvdb::DoubleGrid::create();
  huge->setName("density");
  huge->tree().setValueOn(Coord(1, 1, 1), 1e39);
  expect_part(message(write({huge})), "cell (1, 1, 1) is 1e+39");
  const auto outside = openvdb::FloatGrid::create(0.5F);
  outside->setName("density");
  expect_part(message(write({outside})), "is 0.5 outside its cells, expected 0");
  const auto nothing = openvdb::FloatGrid::create();
  nothing->setName("density");
  expect_part(message(write({nothing})), "has no value above 0");
  const auto wide = density();
  wide->tree().setValueOn(Coord(1000, 1001, 1002), 1);
  expect_part(message(write({wide})), "has 1000 x 1000 x 1000 cells, expected at most 536870912 in all");
  const auto bent = density();
  bent->setTransform(openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 10, 1));
  expect_part(message(write({bent})), "a transform of type \"NonlinearFrustumMap\", expected a linear one");
  folder.write("grid.vdb", "");
  expect_part(message(folder.file("grid.vdb")), "not an OpenVDB file");
}

// Every beginning of a file, and thousands with one byte changed: refused in a line, or loaded. Run under the address sanitizer
// too (./dev test asan).
TEST_F(GridFiles, DamagedFilesAreRefusedOrLoaded) {
  using namespace openvdb::io;
  std::mt19937 random(11);
  const auto grid = density();
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  for (int i = 0; i < 300; ++i)
    grid->tree().setValueOn(Coord(static_cast<int>(random() % 24U), i % 9, i / 30), static_cast<float>(i));
  grid->tree().addTile(1, Coord(24, 0, 0), 1, true);
  NoProgress none;
  for (const unsigned compression : {unsigned{COMPRESS_ZIP}, unsigned{COMPRESS_BLOSC}, unsigned{COMPRESS_NONE}}) {
    const std::string path = write({grid}, compression | COMPRESS_ACTIVE_MASK), bytes = bytes_of(path);
    // Most bytes are empty masks: most changes are where there is something.
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (bytes[i] != 0 ? random() % 2 == 0 : i < 600 || random() % 64 == 0) places.push_back(i);
    }
    int refused = 0, loaded = 0;
    const auto load = [&](const std::string& damaged) {
      folder.write("damaged.vdb", damaged);
      try {
        const GridFile file = read_grid_file(folder.file("damaged.vdb"), "density", none);
        ++loaded;
        for (const float v : file.voxels->values) {
          if (!(v >= 0) || !std::isfinite(v)) return false;
        }
      } catch (const InputError& e) {
        ++refused;
        const std::string text = e.what();
        if (text.find('\n') != text.npos || text.rfind(folder.file("damaged.vdb") + ": ", 0) != 0) return false;
      }
      return true;
    };
    for (std::size_t size = 0; size < bytes.size(); size += 1 + random() % 40U) ASSERT_TRUE(load(bytes.substr(0, size))) << size;
    const int shorter = refused;
    EXPECT_EQ(loaded, 0);
    for (const std::size_t at : places) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(random() % 3 == 0 ? 0xff : damaged[at] ^ (1 << (random() % 8U)));
      ASSERT_TRUE(load(damaged)) << "byte " << at;
    }
    std::printf("compression %u, %zu bytes: %d beginnings refused; of %zu changes %d refused, %d loaded\n", compression,
                bytes.size(), shorter, places.size(), refused - shorter, loaded);
  }
}

class Stopping final : public Progress {
 public:
  void report(std::string_view, double) override {}
  bool stop_requested() const override { return true; }
};

TEST_F(GridFiles, StopsWhenAsked) {
  Stopping stop;
  EXPECT_THROW(read_grid_file(write({density()}), "density", stop), Interrupted);
}

TEST_F(GridFiles, ScenePlacesThem) {
  const auto grid = density();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  write({grid});
  NoProgress none;
  const Scene s = parse_scene(R"({ "airlight": 1, "medium": { "albedo": [0.5, 0.6, 0.7],
    "grid": { "file": "grid.vdb", "scale": 3, "size": 2, "rotate": [-90, 0, 0], "translate": [10, 20, 30] } } })",
                              "scene.json", folder.path(), none);
  ASSERT_TRUE(s.medium.grid.has_value());
  EXPECT_FALSE(s.medium.empty());
  EXPECT_EQ(s.medium.grid->scale, 3);
  EXPECT_EQ(s.medium.grid->albedo, glm::dvec3(0.5, 0.6, 0.7));
  EXPECT_EQ(s.medium.grid->voxels->size, glm::ivec3(1));
  // Cell (1, 2, 3) is at (0.5, 1, 1.5) in the file, (1, 2, 3) after the size; z goes up.
  EXPECT_EQ(moved(s.medium.grid->transform, glm::dvec3(0.5)), glm::dvec3(11, 23, 28));
}

}  // namespace
}  // namespace airlight
