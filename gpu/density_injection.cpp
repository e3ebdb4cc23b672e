#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/algorithms/voxel_table.h"
#include "gpu/halves.h"
#include "gpu/medium.h"

namespace airlight {

namespace {

constexpr int block_side = 8;                                              // cells, as in the shader
constexpr GLuint begin_number = 40, list_number = 41, packed_number = 44;  // buffers of this step

// Which Gaussians reach into each block of cells, in their order.
struct BlockLists {
  std::vector<std::int32_t> begin, list;
  std::int32_t longest = 0;

  explicit BlockLists(const DensityInjection& a) {
    const glm::ivec3 size(a.size), blocks = (size + block_side - 1) / block_side;
    struct Range {
      glm::ivec3 first, last;
    };
    std::vector<Range> ranges;
    begin.assign(static_cast<std::size_t>(blocks.x) * static_cast<std::size_t>(blocks.y) * static_cast<std::size_t>(blocks.z) + 1,
                 0);
    const auto each_block = [&](const Range& r, auto&& body) {
      for (int k = r.first.z; k <= r.last.z; ++k) {
        for (int j = r.first.y; j <= r.last.y; ++j) {
          for (int i = r.first.x; i <= r.last.x; ++i) body(static_cast<std::size_t>(i + blocks.x * (j + blocks.y * k)));
        }
      }
    };
    for (const GaussianDensity& g : a.gaussians) {
      Range r;
      for (int axis = 0; axis < 3; ++axis) {
        const auto block = [&](float x) {
          return static_cast<int>(std::clamp(std::floor(x / a.cell / block_side), -1.0F, static_cast<float>(blocks[axis])));
        };
        r.first[axis] = std::max(block(g.center[axis] - g.reach - a.cell), 0);
        r.last[axis] = std::min(block(g.center[axis] + g.reach + a.cell), blocks[axis] - 1);
      }
      ranges.push_back(r);
      each_block(r, [&](std::size_t b) { ++begin[b + 1]; });
    }
    for (std::size_t b = 1; b < begin.size(); ++b) {
      longest = std::max(longest, begin[b]);
      begin[b] += begin[b - 1];
    }
    list.resize(std::max<std::size_t>(static_cast<std::size_t>(begin.back()), 1));
    std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t g = 0; g < ranges.size(); ++g)
      each_block(ranges[g], [&](std::size_t b) { list[static_cast<std::size_t>(next[b]++)] = static_cast<std::int32_t>(g); });
  }
};

}  // namespace

void run(const DensityInjection& a, StepRunner& r, const Progress& progress) {
  std::vector<std::string> defines = bind_medium(r, a.gaussians, a.grid, a.voxels, 1, LightDepth::analytic);
  defines.push_back("INJECT");
  const BlockLists lists(a);
  const glm::ivec3 size(a.size);
  const auto count = [](const glm::ivec3& n) {
    return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z);
  };
  const bool halves = a.half_unit > 0;
  if (halves) r.reserve(packed_number, sizeof(float) * voxel_table_floats(size));
  const auto set_up = [&](Program& program) {
    program.set("size_x", size.x);
    program.set("size_y", size.y);
    program.set("size_z", size.z);
    program.set("cell", a.cell);
    if (halves) {
      r.bind(0, packed_number);
    } else {
      r.storage(0, a.extinction);
    }
  };
  Program& inject = r.compute("gpu/density_injection.glsl", defines);
  set_up(inject);
  r.fill(begin_number, std::as_bytes(std::span(lists.begin)));
  r.fill(list_number, std::as_bytes(std::span(lists.list)));
  r.bind(1, begin_number);
  r.bind(2, list_number);
  std::int32_t first = 0;
  do {
    progress.check();
    const auto end =
        std::min<std::int32_t>(first + static_cast<std::int32_t>(LoopBudget::most / LoopBudget::rays_at_once), lists.longest);
    inject.set("first_entry", first);
    inject.set("end_entry", end);
    r.each(inject, count(size + 2), 64);
    first = end;
  } while (first < lists.longest);

  Program& bound = r.compute("gpu/density_injection.glsl", {"BOUND"});
  set_up(bound);
  r.each(bound, count({bricks_an_axis(size.x), bricks_an_axis(size.y), bricks_an_axis(size.z)}), 64);
  if (halves) pack_halves(r, packed_number, 3, voxel_values(size), 1 / a.half_unit, a.extinction);
}

}  // namespace airlight
