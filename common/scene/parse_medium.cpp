#include <fmt/format.h>

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

// Koschmieder 1924: the distance at which a dark object keeps 2 % of contrast; ln(50) = 3.912.
constexpr double koschmieder = 3.912;

double parse_homogeneous(const Node& node) {
  static constexpr auto known = keys("extinction", "visibility");
  const Object o(node, known);
  const auto extinction = o.find("extinction"), visibility = o.find("visibility");
  if (extinction && visibility) visibility->fail("extinction is given too, expected one of extinction and visibility");
  if (visibility) return koschmieder / visibility->number({koschmieder / limits::extinction.most, 1e9, "m"});
  return o.require("extinction").number(limits::extinction);
}

Gaussian parse_gaussian(const Node& node, const Medium& medium) {
  static constexpr auto known = keys("center", "radius", "extinction", "albedo", "emission");
  const Object o(node, known);
  Gaussian g;
  g.center = o.require("center").vec3(limits::coordinate);
  g.radius = o.require("radius").number(limits::radius);
  g.extinction = o.require("extinction").number(limits::extinction);
  const auto albedo = o.find("albedo"), emission = o.find("emission");
  g.albedo = albedo ? albedo->vec3(limits::fraction) : medium.albedo;
  g.emission = emission ? emission->vec3(limits::emission) : medium.emission;
  return g;
}

}  // namespace

Medium parse_medium(const Node& node) {
  static constexpr auto known = keys("phase", "albedo", "ambient", "emission", "homogeneous", "gaussians");
  static constexpr std::array<LaterKey, 3> later{
      {{"grid", "voxel grids are"}, {"gaussians_file", "files of Gaussians are"}, {"particles_file", "files of particles are"}}};
  const Object o(node, known, later);
  Medium m;
  if (const auto phase = o.find("phase")) m.phase = parse_phase(*phase);
  if (const auto albedo = o.find("albedo")) m.albedo = albedo->vec3(limits::fraction);
  if (const auto ambient = o.find("ambient")) m.ambient = ambient->vec3(limits::radiance);
  if (const auto emission = o.find("emission")) m.emission = emission->vec3(limits::emission);
  if (const auto homogeneous = o.find("homogeneous")) m.extinction = parse_homogeneous(*homogeneous);
  if (const auto gaussians = o.find("gaussians")) {
    for (const Node& g : gaussians->array()) m.gaussians.push_back(parse_gaussian(g, m));
  }
  return m;
}

}  // namespace airlight
