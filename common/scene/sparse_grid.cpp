#include "common/scene/sparse_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <tuple>
#include <unordered_map>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/nrrd_file.h"
#include "common/scene/sha256.h"
#include "common/scene/vdb_values.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{8} << 30U;
constexpr std::size_t most_blocks = std::size_t{1} << 21U;  // 4 GiB
constexpr std::string_view float_type = "Tree_float_5_4_3", double_type = "Tree_double_5_4_3";

const VdbGrid& named(const VdbFile& file, const std::string& path, const std::string& name) {
  std::string there;
  for (const VdbGrid& grid : file.grids) {
    if (grid.name == name) return grid;
    there += fmt::format("{}\"{}\"", there.empty() ? "" : ", ", printable(grid.name));
    if (there.size() > 1000) {
      there += ", ...";
      break;
    }
  }
  if (there.empty()) there = "at least one grid";
  throw InputError(fmt::format("{}: no grid \"{}\", expected {}{}", path, name, file.grids.size() > 1 ? "one of " : "", there));
}

SparseGrid from_vdb(const std::string& path, std::string_view bytes, const std::string& name, Progress& progress) {
  const VdbFile file = vdb_layout(path, bytes);
  const VdbGrid& entry = named(file, path, name);
  if (entry.type != float_type && entry.type != double_type && !entry.instance) {
    throw InputError(fmt::format("{}: grid \"{}\" is of type {}, expected {} or {}", path, printable(name), printable(entry.type),
                                 float_type, double_type));
  }
  const VdbValues values(path, bytes, file, entry, progress);
  if (!values.grid_class().empty() && values.grid_class() != "fog volume" && values.grid_class() != "unknown") {
    throw InputError(
        fmt::format("{}: grid \"{}\" is a {}, expected a fog volume", path, printable(name), printable(values.grid_class())));
  }
  if (values.background() != 0) {
    throw InputError(
        fmt::format("{}: grid \"{}\" is {} outside its cells, expected 0", path, printable(name), values.background()));
  }
  SparseGridBuilder builder(path);
  values.each(
      [&](const VdbCells& cells) {
        const auto value = static_cast<float>(cells.value);
        if (!(cells.value >= 0) || !std::isfinite(value)) {
          throw InputError(fmt::format("{}: the value of cell ({}, {}, {}) is {}, expected a finite number >= 0", path,
                                       cells.least.x, cells.least.y, cells.least.z, cells.value));
        }
        if (value > 0) builder.set(cells.least, cells.most, value);
      },
      progress);
  SparseGrid grid;
  if (!builder.finish(grid))
    throw InputError(fmt::format("{}: grid \"{}\" has no value above 0, expected at least one", path, printable(name)));
  grid.transform = values.transform();
  const glm::dmat4& m = grid.transform;
  if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
    throw InputError(fmt::format("{}: grid \"{}\" has a transform that is not affine", path, printable(name)));
  return grid;
}

glm::ivec3 block_of(const glm::ivec3& cell) { return {cell.x >> 3, cell.y >> 3, cell.z >> 3}; }

struct BlockHash {
  std::size_t operator()(const glm::ivec3& b) const {
    std::uint64_t h = 0x9E3779B97F4A7C15ULL;
    for (int k = 0; k < 3; ++k) h = (h ^ static_cast<std::uint32_t>(b[k])) * 0xD6E8FEB86659FD93ULL, h ^= h >> 32;
    return static_cast<std::size_t>(h);
  }
};

}  // namespace

struct SparseGridBuilder::State {
  std::string path;
  std::vector<GridBlock> blocks;
  std::unordered_map<glm::ivec3, std::size_t, BlockHash> places;
  std::size_t last = 0;  // the block that was asked for last
  glm::ivec3 least{0}, most{0};

  GridBlock& at(const glm::ivec3& block) {
    if (!blocks.empty() && blocks[last].first == 8 * block) return blocks[last];
    const auto [found, is_new] = places.try_emplace(block, blocks.size());
    if (is_new) {
      if (blocks.size() == most_blocks)
        throw InputError(
            fmt::format("{}: expected at most {} blocks of 8 x 8 x 8 cells with a value above 0", path, most_blocks));
      blocks.emplace_back().first = 8 * block;
    }
    last = found->second;
    return blocks[last];
  }
};

SparseGridBuilder::SparseGridBuilder(const std::string& path) : state_(std::make_unique<State>()) { state_->path = path; }
SparseGridBuilder::~SparseGridBuilder() = default;

void SparseGridBuilder::set(const glm::ivec3& least, const glm::ivec3& most, float value) {
  State& s = *state_;
  if (s.blocks.empty()) s.least = least, s.most = most;
  const glm::ivec3 from = block_of(least), to = block_of(most);
  for (int k = 0; k < 3; ++k) s.least[k] = std::min(s.least[k], least[k]), s.most[k] = std::max(s.most[k], most[k]);
  glm::ivec3 b;
  for (b.z = from.z; b.z <= to.z; ++b.z) {
    for (b.y = from.y; b.y <= to.y; ++b.y) {
      for (b.x = from.x; b.x <= to.x; ++b.x) {
        GridBlock& block = s.at(b);
        const auto begin = [&](int k) { return std::max(least[k] - block.first[k], 0); };
        const auto end = [&](int k) { return std::min(most[k] - block.first[k], 7); };
        for (int z = begin(2); z <= end(2); ++z) {
          for (int y = begin(1); y <= end(1); ++y) {
            const auto first = block.values.begin() + 8 * (y + 8 * z);
            std::fill(first + begin(0), first + end(0) + 1, value);
          }
        }
      }
    }
  }
}

bool SparseGridBuilder::finish(SparseGrid& grid) {
  State& s = *state_;
  if (s.blocks.empty()) return false;
  std::sort(s.blocks.begin(), s.blocks.end(), [](const GridBlock& a, const GridBlock& b) {
    return std::tie(a.first.z, a.first.y, a.first.x) < std::tie(b.first.z, b.first.y, b.first.x);
  });
  grid.blocks = std::move(s.blocks);
  grid.least = s.least, grid.most = s.most;
  return true;
}

SparseGrid read_sparse_grid(const std::string& path, const std::string& name, Progress& progress) {
  progress.report("loading the grid", 0);
  const std::string bytes = read_file(path, most_bytes);
  progress.check();
  try {
    SparseGrid grid = is_nrrd(bytes) ? read_nrrd(path, bytes, progress) : from_vdb(path, bytes, name, progress);
    Sha256 hash;
    hash.add(bytes);
    grid.content_hash = hash.hex();
    return grid;
  } catch (const std::bad_alloc&) {
    throw MachineError(path + ": not enough memory for its grid");
  }
}

}  // namespace airlight
