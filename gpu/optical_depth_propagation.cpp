#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>

#include "gpu/halves.h"
#include "gpu/medium.h"

namespace airlight {

namespace {

constexpr GLuint sharpened_number = 43, packed_number = 45;  // buffers of this step

// A layer of cells after the other, away from the light's: none reads what another of the same distance writes.
void sweep(const OpticalDepthPropagation& a, StepRunner& r, const std::vector<std::string>& defines, const Progress& progress) {
  Program& program = r.compute("gpu/optical_depth_propagation.glsl", defines);
  const glm::ivec3 n(a.volume.nodes);
  const float cell = 1 / a.volume.rows[0].x;
  int at[3], levels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const float light = a.light.vector[axis];
    at[axis] = a.light.directional ? (light > 0 ? -1 : n[axis])
                                   : static_cast<int>(std::clamp(std::floor(light / cell), -1.0F, static_cast<float>(n[axis])));
    levels += n[axis];
  }
  program.set("light_x", at[0]);
  program.set("light_y", at[1]);
  program.set("light_z", at[2]);
  for (int level = 0; level < levels; ++level) {
    if (level % 32 == 0) progress.check();
    program.set("level", level);
    r.each(program, static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z), 64);
  }
}

}  // namespace

void run(const OpticalDepthPropagation& a, StepRunner& r, const Progress& progress) {
  const DepthVolume& v = a.volume;
  const std::vector<std::string> medium = bind_medium(r, a.gaussians, a.grid, a.voxels, 1, LightDepth::analytic);
  struct {
    glm::vec4 rows[3], first_kind, scale_samples, nodes_scheme, light_directional;
  } const knobs{{v.rows[0], v.rows[1], v.rows[2]},
                {v.first, static_cast<float>(v.kind)},
                {v.scale, static_cast<float>(a.samples)},
                {v.nodes, static_cast<float>(a.scheme)},
                {a.light.vector, a.light.directional ? 1.0F : 0.0F}};
  r.block(knobs_binding, knobs);
  const std::size_t bytes = sizeof(float) * (DepthVolume::head + v.depths());  // before they become halves
  if (v.halves) r.reserve(packed_number, bytes);
  const auto bind_depths = [&](GLuint binding) {
    if (v.halves) {
      r.bind(binding, packed_number);
    } else {
      r.storage(binding, a.depths);
    }
  };
  bind_depths(0);
  const auto with = [&](const char* define) {
    std::vector<std::string> defines = medium;
    defines.push_back(define);
    return defines;
  };
  if (v.kind == DepthVolume::Kind::cells) {
    sweep(a, r, with("CELLS"), progress);
    return;
  }
  const std::size_t rays =
      static_cast<std::size_t>(v.faces()) * static_cast<std::size_t>(v.nodes.x) * static_cast<std::size_t>(v.nodes.y);
  r.each(r.compute("gpu/optical_depth_propagation.glsl", with("GRID")), rays, 64);
  const std::size_t nodes = rays * static_cast<std::size_t>(v.nodes.z);
  if (!a.gaussians.empty()) {
    Program& gaussians = r.compute("gpu/optical_depth_propagation.glsl", with("GAUSSIANS"));
    constexpr int most = LoopBudget::most / LoopBudget::rays_at_once;
    const int all = static_cast<int>(a.gaussians.size());
    for (int first = 0; first < all; first += most) {
      progress.check();
      gaussians.set("first_gaussian", first);
      gaussians.set("end_gaussian", std::min(first + most, all));
      r.each(gaussians, nodes, 64);
    }
  }
  // Three times from one buffer to the other, and back.
  Program& sharpen = r.compute("gpu/optical_depth_propagation.glsl", {"SHARPEN"});
  r.reserve(sharpened_number, bytes);
  for (const int axis : {2, 0, 1}) {
    sharpen.set("axis", axis);
    if (axis == 0) {
      r.bind(0, sharpened_number);
      bind_depths(1);
    } else {
      bind_depths(0);
      r.bind(1, sharpened_number);
    }
    r.each(sharpen, nodes, 64);
  }
  if (v.halves) {
    pack_halves(r, sharpened_number, DepthVolume::head, v.depths(), 1, a.depths);
  } else {
    r.copy_back(sharpened_number, r.buffer_name(a.depths), bytes);
  }
}

}  // namespace airlight
