#include "tests/parity/network.h"

#include <cmath>
#include <glm/common.hpp>
#include <memory>
#include <span>

#include "common/plan/geometry.h"
#include "common/plan/source_nodes.h"
#include "common/plan/voxels.h"
#include "tests/parity/inputs.h"

namespace airlight {

Scene two_gaussians(double albedo) {
  Scene scene;
  scene.camera.position = {0, 0, 4};
  for (const double x : {-0.5, 0.8}) {
    Gaussian g;
    g.center = {x, 0.2 * x, 0};
    g.radius = x < 0 ? 0.7 : 0.5;
    g.extinction = x < 0 ? 2 : 5;
    g.albedo = glm::dvec3(albedo);
    scene.medium.gaussians.push_back(g);
  }
  return scene;
}

Scene far_gaussians() {
  Scene scene = two_gaussians(0.9);
  scene.medium.gaussians[0].radius = scene.medium.gaussians[1].radius = 0.1;
  scene.medium.gaussians[1].center = {1.5, -1.2, -1.4};
  return scene;
}

Environment network_environment() {
  constexpr Extent extent{8, 4};
  auto image = std::make_shared<HostImage>(extent, 3);
  for (std::uint32_t i = 0; i < image->values.size(); ++i) image->values[i] = static_cast<float>(uniform(840, i));
  for (int c = 0; c < 3; ++c) image->at(5, 1, c) = static_cast<float>(9 - 2 * c);
  return {image, {0.7, 0.8, 0.9}, 25};
}

std::vector<LightSource> network_lights() {
  LightSource lamp, sun;
  lamp.position = {0.4, 0.3, -5};
  lamp.power = {3, 2, 1};
  sun.type = LightType::directional;
  sun.direction = glm::dvec3(0.6, -0.8, 0);
  sun.power = {1, 2, 3};
  return {lamp, sun};
}

TestNetwork test_network(Case& c, const Scene& scene, const std::vector<LightSource>& lights, const NetworkParts& asked) {
  NetworkParts parts = asked;
  if (parts.particle_set == ParticleSet::gaussians) parts.particles = gaussian_particles(scene);
  const MediumBox box = medium_box(scene, 12);
  const NetworkFrame frame = network_frame(box);
  TestNetwork t;
  for (const Plan::Upload& upload :
       network_uploads(scene, box, parts.particles, parts.lines, parts.window, 1, parts.set, parts.particle_set))
    c.buffers.emplace_back(upload.buffer, upload.make());
  const auto floats = [](std::uint32_t id, std::size_t n) { return Buffer{{id}, sizeof(float) * n}; };
  VisibilityNetwork& n = t.network;
  n.particles = c.buffers[c.buffers.size() - 2].first;
  n.lines = c.buffers.back().first;
  if (scene.medium.grid) {
    n.voxels = add_voxels(c, *scene.medium.grid, 3);
    n.grid = grid_density(*scene.medium.grid, frame.middle);
  }
  n.gaussians = gaussians_of(scene, frame.middle);
  n.particle_count = parts.particles, n.line_count = parts.lines, n.window = parts.window;
  n.unit = static_cast<float>(frame.unit);
  n.extinction = parts.extinction;
  n.links = floats(4, n.shape().links());

  const bool isotropic = parts.phase.kind == PhaseKind::isotropic;
  const std::size_t sources =
      4 * static_cast<std::size_t>(parts.particles) * (isotropic ? 1 : 2 * static_cast<std::size_t>(parts.lines));
  ParticleLight& l = t.light;
  l.particles = n.particles, l.lines = n.lines, l.voxels = n.voxels;
  l.gaussians = n.gaussians, l.grid = n.grid, l.phase = parts.phase;
  for (const LightSource& one : lights) l.lights.push_back(light_of(one, frame.middle));
  l.particle_count = n.particle_count, l.line_count = n.line_count;
  l.unit = n.unit, l.extinction = n.extinction;
  l.first = floats(5, sources);

  NetworkIteration& i = t.iteration;
  i.particles = n.particles, i.lines = n.lines, i.links = n.links, i.first = l.first, i.phase = parts.phase;
  i.particle_count = n.particle_count, i.line_count = n.line_count, i.window = n.window;
  i.tolerance = parts.tolerance, i.iterations = parts.iterations;
  i.sources = floats(6, sources);
  i.gradients = parts.gradients;
  i.residuals = floats(7, i.residual_floats());

  if (scene.environment) {
    const std::vector<float> sky = network_sky(*scene.environment, parts.lines, parts.set);
    const auto sky_bytes = std::as_bytes(std::span(sky));
    i.sky = floats(9, sky.size());
    c.buffers.emplace_back(i.sky, std::vector<std::byte>(sky_bytes.begin(), sky_bytes.end()));
  }

  SourceFunction& s = t.source;
  s.sky = i.sky;
  s.particles = n.particles, s.lines = n.lines, s.links = n.links, s.particle_sources = i.sources, s.phase = parts.phase;
  s.particle_count = n.particle_count, s.line_count = n.line_count, s.window = n.window, s.unit = n.unit;
  s.camera = scene.camera.position - frame.middle;
  if (parts.sparse) {
    const SourceNodes nodes = source_nodes(scene, frame, 16);
    s.first = nodes.first, s.stride = nodes.stride;
    s.nodes = nodes.nodes, s.bricks = nodes.bricks, s.filled = nodes.filled;
  } else {
    s.first = glm::floor((box.corner - frame.middle) / frame.unit);
    s.stride = static_cast<int>(std::ceil(box.cell / frame.unit));
    s.nodes = glm::vec3(box.cells + 1);
  }
  s.sources = floats(8, s.floats());
  return t;
}

}  // namespace airlight
