// Which folder knows which, as HACKING.md tells: read off the includes. A crossing fails here before anything is built on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Room {
  std::string_view name;                // of the folder, or of a file: the longest that a path begins with counts
  std::vector<std::string_view> known;  // what paths begin with that it may include, itself aside
};

// Top down: nothing knows what stands above it.
const std::vector<Room>& rooms() {
  static const std::vector<Room> all{
      {"common/formulas", {"common/half.h"}},
      {"common/error.h", {}},
      {"common/image.h", {}},
      {"common/random.h", {}},
      {"common/rows.h", {}},
      {"common/spelling.h", {}},
      {"common/stats.h", {}},
      {"common/relative_rmse.h", {}},
      {"common/progress.h", {"common/error.h"}},
      {"common/half.h", {}},
      {"common/algorithms", {"common/half.h", "common/image.h"}},
      {"common/gl_host.h", {"common/image.h"}},
      {"common/backend.h", {"common/algorithms", "common/gl_host.h", "common/progress.h", "common/rows.h", "common/stats.h"}},
      {"common/scene",
       {"common/algorithms", "common/error.h", "common/image.h", "common/progress.h", "common/rows.h", "common/spelling.h"}},
      {"common/plan",
       {"common/algorithms", "common/error.h", "common/formulas", "common/image.h", "common/progress.h", "common/scene",
        "common/random.h", "common/rows.h", "common/spelling.h"}},
      {"common/techniques",
       {"common/algorithms", "common/error.h", "common/formulas", "common/plan", "common/scene", "common/spelling.h"}},
      {"common/transfer",
       {"common/error.h", "common/formulas", "common/plan/surface_transfer.h", "common/progress.h", "common/scene",
        "common/stats.h"}},
      // Mathematics of its own: of plans it knows what is asked for, and no table.
      {"common/reference",
       {"common/algorithms/view.h", "common/error.h", "common/formulas", "common/image.h", "common/plan/plan.h",
        "common/plan/image_names.h", "common/progress.h", "common/random.h", "common/rows.h", "common/scene", "common/stats.h"}},
      // Tools beside the renderer: nothing renders by them.
      {"common/design", {"common/error.h", "common/progress.h", "common/random.h", "common/reference", "common/scene"}},
      {"common/fit", {"common/error.h", "common/progress.h", "common/random.h", "common/reference", "common/scene"}},
      {"cpu",
       {"common/algorithms", "common/backend.h", "common/error.h", "common/formulas", "common/half.h", "common/image.h",
        "common/plan", "common/progress.h", "common/rows.h", "common/stats.h"}},
      {"gpu",
       {"common/algorithms", "common/backend.h", "common/error.h", "common/formulas", "common/gl_host.h", "common/half.h",
        "common/image.h", "common/plan", "common/progress.h", "common/rows.h", "common/stats.h"}},
      {"app", {"common", "cpu/backend.h", "cpu/parallel.h", "cpu/targets.h", "cpu/tile.h", "gpu/backend.h", "gpu/context.h"}},
  };
  return all;
}

// Headers of plans that speak of scenes: backends see what comes of them.
constexpr std::string_view of_scenes = "common/scene";

const Room* room_of(std::string_view path) {
  const Room* found = nullptr;
  for (const Room& room : rooms()) {
    if (path.starts_with(room.name) && (!found || room.name.size() > found->name.size())) found = &room;
  }
  return found;
}

bool may_include(const Room& from, std::string_view path) {
  if (path.starts_with(from.name)) return true;
  return std::any_of(from.known.begin(), from.known.end(), [&](std::string_view known) { return path.starts_with(known); });
}

std::vector<std::string> includes_of(std::istream& text) {
  constexpr std::string_view begin = "#include \"";
  std::vector<std::string> found;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with(begin)) continue;
    found.push_back(line.substr(begin.size(), line.rfind('"') - begin.size()));
  }
  return found;
}

// Where a file includes what it must not know, one line each.
std::vector<std::string> crossings(std::string_view path, const std::vector<std::string>& includes) {
  const Room* room = room_of(path);
  if (!room) return {std::string(path) + " is in no room"};
  std::vector<std::string> found;
  for (const std::string& name : includes) {
    if (!may_include(*room, name)) found.push_back(std::string(path) + " includes " + name);
  }
  return found;
}

bool is_source(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp" || path.extension() == ".glsl";
}

std::vector<fs::path> sources(std::string_view folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(AIRLIGHT_SOURCE) / folder)) {
    if (entry.is_regular_file() && is_source(entry.path())) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string relative_name(const fs::path& path) { return fs::relative(path, AIRLIGHT_SOURCE).generic_string(); }

TEST(Walls, NoFileKnowsWhatStandsAboveIt) {
  std::size_t files = 0, includes = 0;
  for (const std::string_view folder : {"common", "cpu", "gpu", "app"}) {
    for (const fs::path& path : sources(folder)) {
      std::ifstream text(path);
      const std::vector<std::string> named = includes_of(text);
      ++files, includes += named.size();
      for (const std::string& crossing : crossings(relative_name(path), named)) ADD_FAILURE() << crossing;
    }
  }
  std::printf("%zu files, %zu includes\n", files, includes);
  EXPECT_GT(files, 200U);
  EXPECT_GT(includes, 700U);
}

TEST(Walls, ACrossingIsSeen) {
  EXPECT_EQ(crossings("cpu/compose.cpp", {"cpu/kernels.h", "common/algorithms/compose.h"}).size(), 0U);
  EXPECT_EQ(crossings("cpu/compose.cpp", {"gpu/functions.h"}).size(), 1U);
  EXPECT_EQ(crossings("common/formulas/gaussian.h", {"common/image.h"}).size(), 1U);
  EXPECT_EQ(crossings("common/plan/frame.h", {"common/techniques/technique.h", "cpu/backend.h"}).size(), 2U);
  EXPECT_EQ(crossings("common/reference/airlight.cpp", {"common/plan/environment.h"}).size(), 1U);
  EXPECT_EQ(crossings("common/unheard_of.h", {}).size(), 1U);
  std::istringstream text("#include <vector>\n#include \"gpu/gl.h\"\n  // #include \"cpu/simd.h\"\n");
  EXPECT_EQ(includes_of(text), std::vector<std::string>{"gpu/gl.h"});
}

// Backends run what plans were made into: of the folder of plans they see no header that sees a scene.
TEST(Walls, BackendsSeeNoScene) {
  for (const std::string_view folder : {"cpu", "gpu"}) {
    for (const fs::path& path : sources(folder)) {
      std::ifstream text(path);
      std::vector<std::string> waiting = includes_of(text), seen;
      while (!waiting.empty()) {
        const std::string name = waiting.back();
        waiting.pop_back();
        if (std::find(seen.begin(), seen.end(), name) != seen.end()) continue;
        seen.push_back(name);
        EXPECT_FALSE(name.starts_with(of_scenes)) << relative_name(path) << " comes to see " << name;
        std::ifstream header(fs::path(AIRLIGHT_SOURCE) / name);
        for (const std::string& next : includes_of(header)) waiting.push_back(next);
      }
    }
  }
}

TEST(Walls, FilesHaveASizeThatIsRead) {
  constexpr int most = 400;
  for (const std::string_view folder : {"common", "cpu", "gpu", "app", "bench", "tests"}) {
    for (const fs::path& path : sources(folder)) {
      std::ifstream text(path);
      const auto lines = std::count(std::istreambuf_iterator<char>(text), {}, '\n');
      EXPECT_LE(lines, most) << relative_name(path);
    }
  }
}

}  // namespace
