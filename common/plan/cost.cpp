#include "common/plan/cost.h"

#include <algorithm>
#include <cmath>

#include "common/plan/gaussian_panels.h"

namespace airlight {

namespace {

double count(const auto& list) { return static_cast<double>(list.size()); }

// Gaussians, and a lookup where there is a grid, at one place along a way.
double of_medium(const std::vector<GaussianDensity>& gaussians, const GridDensity& grid) {
  return 0.4 * count(gaussians) + (grid ? 4 : 0);
}

// Nanoseconds an item. Of what has no line here two: it reads and writes, and computes little.
struct Nanoseconds {
  double operator()(const auto&) const { return 2; }
  // A triangle takes a quarter of a microsecond; the pixels are counted as if one in four had been met twice.
  double operator()(const SurfaceVisibility& a) const {
    const double pixels = static_cast<double>(a.view.extent.width) * a.view.extent.height;
    return 8 + 250 * static_cast<double>(a.triangles.bytes) / 16 / std::max(pixels, 1.0);
  }
  double operator()(const ShadowPlanes& a) const { return 100 * count(a.lights); }
  double operator()(const ViewTransmittance&) const { return 0.8; }
  double operator()(const SurfaceAirlight& a) const { return 6 * count(a.lights); }
  double operator()(const SurfaceShading& a) const { return 2 + 2.7 * count(a.lights); }
  double operator()(const HomogeneousAirlight& a) const { return 1 + (a.scattered ? 1 : 16) * count(a.lights); }
  double operator()(const MeanDepthLattice& a) const { return 0.2 * count(a.gaussians); }
  double operator()(const MeanDepth& a) const { return 1 + (a.lattices.empty() ? 0.2 * count(a.gaussians) : 1); }
  double operator()(const EnvironmentLight& a) const { return a.brdf.empty() ? 8 : 30; }
  double operator()(const HiddenEnvironment& a) const { return 2 + (a.specular ? 10 : 0) + (a.brdfs > 0 ? 40 : 0); }
  double operator()(const DensityInjection& a) const { return 1 + 0.02 * count(a.gaussians) + (a.grid ? 5 : 0); }
  double operator()(const OpticalDepthPropagation& a) const {
    return 0.5 + 0.3 * count(a.gaussians) + (a.grid ? 3 * a.samples : 0);
  }
  double operator()(const VisibilityNetwork&) const { return 8; }
  double operator()(const ParticleLight& a) const { return 2 * count(a.lights); }
  double operator()(const NetworkIteration&) const { return 2000; }  // some twenty rounds, each through all links
  double operator()(const SourceFunction& a) const { return 20 * a.line_count; }
  double operator()(const RayMarch& a) const {
    const double medium = of_medium(a.gaussians, a.grid), lights = count(a.lights);
    const double way = a.light_depth == LightDepth::volume ? 6 : 2 + medium * a.light_steps;
    return 0.5 * a.steps * (3 + medium + lights * way) * (medium > 0 || a.extinction > 0 ? 1 : 0);
  }
  double operator()(const GaussianAirlight& a) const {
    const double met = std::pow(count(a.gaussians), 0.75), lights = count(a.lights);
    if (!shines(a)) return met;
    return 16 * lights + a.samples * met * (a.depths.empty() ? 3 + 4 * lights : 1.3) + (a.depths.empty() ? 0 : 60 * lights);
  }
  double operator()(const ProjectedGaussians& a) const { return 3 * std::pow(count(a.gaussians), 0.75) * (1 + count(a.lights)); }
  double operator()(const LightMarch& a) const {
    return count(a.lights) * (a.light_depth == LightDepth::volume ? 8 : 2 + of_medium(a.gaussians, a.grid) * a.light_steps);
  }
  double operator()(const ParticleSplats&) const { return 25; }
};

}  // namespace

StepCost cost_of(const Algorithm& what) {
  StepCost cost;
  for (const Image& image : outputs_of(what)) {
    const auto pixels = static_cast<std::uint64_t>(image.extent.width) * static_cast<std::uint64_t>(image.extent.height);
    cost.items = std::max(cost.items, pixels);
    cost.bytes += sizeof(float) * image.floats();
  }
  for (const Buffer& buffer : buffers_made_by(what)) {
    cost.items += buffer.bytes / sizeof(float);
    cost.bytes += buffer.bytes;
  }
  cost.seconds = 1e-9 * static_cast<double>(cost.items) * std::visit(Nanoseconds{}, what);
  return cost;
}

}  // namespace airlight
