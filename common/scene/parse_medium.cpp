#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>

#include "common/scene/limits.h"
#include "common/scene/parse.h"

namespace airlight {

namespace {

// In the order of PhaseKind.
constexpr auto phase_names = keys("isotropic", "rayleigh", "henyey_greenstein", "cornette_shanks", "mie_hazy", "mie_murky");

Phase parse_phase(const Node& node) {
  static constexpr auto known = keys("type", "g");
  const Object o(node, known);
  const std::string type = o.require("type").choice(phase_names);
  Phase phase;
  while (phase_names[static_cast<std::size_t>(phase.kind)] != type)
    phase.kind = static_cast<PhaseKind>(static_cast<int>(phase.kind) + 1);
  const bool takes_g = phase.kind == PhaseKind::henyey_greenstein || phase.kind == PhaseKind::cornette_shanks;
  if (takes_g) phase.g = o.require("g").number(limits::asymmetry);
  if (const auto g = o.find("g"); g && !takes_g) g->fail(fmt::format("the phase function {} has no g, expected none", type));
  return phase;
}

double parse_homogeneous(const Node& node) {
  static constexpr auto known = keys("extinction", "visibility");
  const Object o(node, known);
  const auto extinction = o.find("extinction"), visibility = o.find("visibility");
  if (extinction && visibility) visibility->fail("extinction is given too, expected one of extinction and visibility");
  if (visibility) return limits::koschmieder / visibility->number({limits::koschmieder / limits::extinction.most, 1e9, "m"});
  return o.require("extinction").number(limits::extinction);
}

// Its box, half a cell wider as its extinction is, within what single precision can hold.
void check_extent(const Node& node, const GridMedium& grid) {
  const glm::dvec3 size(grid.voxels->size);
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 cell;
    for (int k = 0; k < 3; ++k) cell[k] = (corner >> k & 1) != 0 ? size[k] + 0.5 : -0.5;
    const glm::dvec3 w(grid.transform * glm::dvec4(cell, 1.0));
    const double largest = std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
    if (!(largest <= limits::farthest)) {
      node.fail(fmt::format("a corner of the grid is at ({}, {}, {}), expected coordinates up to {} m", w.x, w.y, w.z,
                            limits::farthest));
    }
  }
}

GridMedium parse_grid(const Node& node, SceneFiles& files, Loading& loading, Progress& progress) {
  static constexpr auto known = keys("file", "name", "scale", "transform", "translate", "rotate", "size", "albedo");
  const Object o(node, known);
  GridMedium grid;
  const glm::dmat4 placement = parse_transform(o, "size");
  const auto name = o.find("name"), scale = o.find("scale"), albedo = o.find("albedo");
  if (scale) grid.scale = scale->number(limits::extinction);
  grid.albedo = albedo ? albedo->vec3(limits::fraction) : loading.scene.medium.albedo;
  loading.grid_name = name ? name->string() : "density";

  // The file comes last: what the scene says itself is checked without it.
  const Node file = o.require("file");
  const auto read = files.grid(file, loading.grid_name, progress);
  if (!read) return grid;
  loading.grid_hash = read->content_hash;
  grid.voxels = read->voxels;
  grid.transform = placement * read->transform;
  if (singular(read->transform)) file.fail("its file's transform is singular, expected an invertible one");
  if (singular(grid.transform)) node.fail("a singular transform with that of the file, expected an invertible one");
  check_extent(file, grid);
  const auto largest = static_cast<double>(*std::max_element(grid.voxels->values.begin(), grid.voxels->values.end()));
  if (largest * grid.scale > limits::extinction.most) {
    (scale ? *scale : file)
        .fail(fmt::format("extinction {} 1/m where the grid's value is {}, expected at most {} 1/m", largest * grid.scale,
                          largest, limits::extinction.most));
  }
  return grid;
}

}  // namespace

Noise parse_noise(const Node& node) {
  static constexpr auto known = keys("scale", "amplitude", "offset");
  const Object o(node, known);
  Noise noise;
  noise.amplitude = o.require("amplitude").number(limits::fraction);
  if (const auto scale = o.find("scale")) noise.scale = scale->number(limits::noise_scale);
  if (const auto offset = o.find("offset")) noise.offset = offset->vec3(limits::noise_offset);
  return noise;
}

void parse_medium(const Node& node, SceneFiles& files, Loading& loading, Progress& progress) {
  static constexpr auto known =
      keys("phase", "albedo", "ambient", "emission", "homogeneous", "gaussians", "gaussians_file", "grid");
  static constexpr std::array<LaterKey, 1> later{{{"particles_file", "files of particles are"}}};
  const Object o(node, known, later);
  Medium& m = loading.scene.medium;
  if (const auto phase = o.find("phase")) m.phase = parse_phase(*phase);
  if (const auto albedo = o.find("albedo")) m.albedo = albedo->vec3(limits::fraction);
  if (const auto ambient = o.find("ambient")) m.ambient = ambient->vec3(limits::radiance);
  if (const auto emission = o.find("emission")) m.emission = emission->vec3(limits::emission);
  if (const auto homogeneous = o.find("homogeneous")) m.extinction = parse_homogeneous(*homogeneous);
  if (const auto gaussians = o.find("gaussians")) parse_gaussians(*gaussians, m);
  if (const auto file = o.find("gaussians_file")) parse_gaussians_file(*file, files, m, progress);
  if (const auto grid = o.find("grid")) m.grid = parse_grid(*grid, files, loading, progress);
}

}  // namespace airlight
