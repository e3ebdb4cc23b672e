#include "gpu/medium.h"

#include <algorithm>
#include <glm/vec4.hpp>

#include "common/algorithms/voxel_table.h"
#include "common/error.h"

namespace airlight {

namespace {

constexpr std::size_t block_gaussians = 128;  // 6 KiB; GL promises 16
constexpr GLuint medium_binding = 3, many_gaussians_binding = 5, depths_number = 42;

struct Head {  // of a light's volume, as gpu/medium.glsl reads it
  glm::vec4 rows[3];
  std::int32_t kind, at, halves, unused;
};

struct MediumBlock {
  glm::ivec4 counts;  // Gaussians, steps to a light, where the bricks begin
  glm::vec4 cells[3], size, albedo;
  glm::vec4 gaussians[3 * block_gaussians];
};

}  // namespace

std::vector<std::string> bind_medium(StepRunner& r, const std::vector<GaussianDensity>& gaussians, const GridDensity& grid,
                                     const Buffer& voxels, int light_steps, LightDepth light_depth, Erf erf) {
  std::vector<glm::vec4> values;
  for (const GaussianDensity& g : gaussians) {
    values.emplace_back(g.center, g.radius);
    values.emplace_back(g.albedo, g.extinction);
    values.emplace_back(g.emission, g.reach);
  }
  const bool few = gaussians.size() <= block_gaussians;
  MediumBlock block{};
  block.counts = {static_cast<int>(gaussians.size()), light_steps, grid ? static_cast<int>(bricks_at(grid)) : 0, 0};
  std::copy(std::begin(grid.cells), std::end(grid.cells), block.cells);
  block.size = glm::vec4(grid.size, grid.half_unit);
  block.albedo = glm::vec4(grid.albedo, 0);
  if (few) std::copy(values.begin(), values.end(), block.gaussians);
  r.block(medium_binding, block);
  std::vector<std::string> defines{"GAUSSIAN_ERF " + std::to_string(static_cast<int>(erf))};
  if (!gaussians.empty()) {
    if (!few) r.storage(many_gaussians_binding, std::as_bytes(std::span(values)));
    defines.push_back("WITH_GAUSSIANS");
    if (!few) defines.push_back("MANY_GAUSSIANS");
    if (light_depth == LightDepth::analytic) defines.push_back("ANALYTIC_LIGHT_DEPTH");
  }
  if (grid) {
    r.storage(tables_binding, voxels);
    defines.push_back("WITH_GRID");
  }
  return defines;
}

DepthTables::DepthTables(StepRunner& r, const Buffer& tables, const std::vector<Buffer>& depths,
                         const std::vector<DepthVolume>& volumes, std::vector<std::string>& defines, const Buffer& sources)
    : r_(r), tables_(tables), sources_(sources), depths_(depths), volumes_(volumes) {
  if (!depths.empty()) defines.push_back("WITH_DEPTH_VOLUMES");
  if (sources) defines.push_back("WITH_SOURCES");
}

void DepthTables::make(int first) {
  std::vector<Head> heads;
  sources_at_ = tables_.bytes;
  heads_at_ = sources_at_ + sources_.bytes;
  std::size_t bytes = heads_at_;
  const auto fits = [&](std::size_t light) { return bytes + sizeof(Head) + depths_[light].bytes <= r_.storage_limit(); };
  const auto begin = static_cast<std::size_t>(first);
  std::size_t end = begin;
  for (; end < depths_.size() && (end == begin || fits(end)); ++end) bytes += sizeof(Head) + depths_[end].bytes;
  if (bytes > r_.storage_limit()) {
    throw MachineError("OpenGL: the volumes of a light and of sources take " + std::to_string(bytes >> 20U) +
                       " MiB, more than a storage buffer may have (" + std::to_string(r_.storage_limit() >> 20U) +
                       "), expected a smaller resolution");
  }
  first_ = first, end_ = static_cast<int>(end);
  r_.reserve(depths_number, bytes);
  if (tables_) r_.copy(r_.buffer_name(tables_), depths_number, 0, tables_.bytes);
  if (sources_) r_.copy(r_.buffer_name(sources_), depths_number, sources_at_, sources_.bytes);
  std::size_t at = heads_at_ + sizeof(Head) * (end - begin);
  for (std::size_t k = begin; k < end; ++k) {
    const DepthVolume& v = volumes_[k];
    heads.push_back({{v.rows[0], v.rows[1], v.rows[2]},
                     static_cast<std::int32_t>(v.kind),
                     static_cast<std::int32_t>(at / sizeof(float)),
                     v.halves ? 1 : 0,
                     0});
    r_.copy(r_.buffer_name(depths_[k]), depths_number, at, depths_[k].bytes);
    at += depths_[k].bytes;
  }
  r_.write_storage(depths_number, heads_at_, std::as_bytes(std::span(heads)));
}

int DepthTables::hold(Program& program, int light, std::size_t lights) {
  const auto all = static_cast<int>(lights);
  if (depths_.empty() && !sources_) return all;
  const bool held = depths_.empty() ? made_ : first_ <= light && light < end_;
  if (!held) make(light);
  made_ = true;
  r_.bind(tables_binding, depths_number);
  program.set("sources_at", static_cast<int>(sources_at_ / sizeof(float)));
  program.set("depth_volumes_at",
              static_cast<int>(heads_at_ / sizeof(float)) - static_cast<int>(sizeof(Head) / sizeof(float)) * first_);
  return depths_.empty() ? all : end_;
}

LoopBudget loop_budget(const std::vector<GaussianDensity>& gaussians, const GridDensity& grid, int light_steps,
                       LightDepth light_depth, std::size_t lights, std::int64_t most, int parts) {
  const auto count = static_cast<std::int64_t>(gaussians.size()), n = static_cast<std::int64_t>(light_steps);
  // A place's depth, and the medium where the light is near.
  std::int64_t a_place = (light_depth == LightDepth::volume ? 4 : 2 + count) + count;
  if (count > 0 && light_depth == LightDepth::march) a_place += n * (1 + count);
  if (grid && light_depth != LightDepth::volume) a_place += n + 3;
  // Each part, and what it passes by on its way there.
  const std::int64_t passed = parts > 1 ? parts * (2 + count) : 0;
  const auto of_light = [&] { return parts * a_place + passed; };
  while (parts > 1 && of_light() + count + 2 > most) parts /= 2;
  LoopBudget budget{of_light(), 1, parts};
  if (budget.a_light + count + 2 > most) {
    throw MachineError("OpenGL: " + std::to_string(light_steps) + " steps to a light through " + std::to_string(count) +
                       " Gaussians are more loops than a shader may run, expected fewer light_steps or shadow=analytic");
  }
  const std::int64_t fit = (most - count - 2) / budget.a_light;
  budget.lights = static_cast<int>(std::clamp<std::int64_t>(static_cast<std::int64_t>(lights), 1, fit));
  return budget;
}

}  // namespace airlight
