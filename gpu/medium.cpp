#include "gpu/medium.h"

#include <algorithm>
#include <glm/vec4.hpp>

#include "common/error.h"
#include "common/plan/voxels.h"

namespace airlight {

namespace {

constexpr std::size_t block_gaussians = 128;  // 6 KiB; GL promises 16
constexpr GLuint medium_binding = 3, many_gaussians_binding = 5;

struct MediumBlock {
  glm::ivec4 counts;  // Gaussians, steps to a light, where the bricks begin
  glm::vec4 cells[3], size, albedo;
  glm::vec4 gaussians[3 * block_gaussians];
};

}  // namespace

std::vector<std::string> bind_medium(StepRunner& r, const std::vector<GaussianDensity>& gaussians, const GridDensity& grid,
                                     const Buffer& voxels, int light_steps, LightDepth light_depth) {
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
  block.size = glm::vec4(grid.size, 0);
  block.albedo = glm::vec4(grid.albedo, 0);
  if (few) std::copy(values.begin(), values.end(), block.gaussians);
  r.block(medium_binding, block);
  std::vector<std::string> defines;
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

LoopBudget loop_budget(const std::vector<GaussianDensity>& gaussians, const GridDensity& grid, int light_steps,
                       LightDepth light_depth, std::size_t lights, std::int64_t most) {
  const auto count = static_cast<std::int64_t>(gaussians.size()), n = static_cast<std::int64_t>(light_steps);
  LoopBudget budget{2 + count, 1};
  if (count > 0 && light_depth == LightDepth::march) budget.a_light += n * (1 + count);
  if (grid) budget.a_light += n + 3;
  if (budget.a_light + count + 2 > most) {
    throw MachineError("OpenGL: " + std::to_string(light_steps) + " steps to a light through " + std::to_string(count) +
                       " Gaussians are more loops than a shader may run, expected fewer light_steps or shadow=analytic");
  }
  const std::int64_t fit = (most - count - 2) / budget.a_light;
  budget.lights = static_cast<int>(std::clamp<std::int64_t>(static_cast<std::int64_t>(lights), 1, fit));
  return budget;
}

}  // namespace airlight
