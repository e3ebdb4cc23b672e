#include "common/plan/particle_splats.h"

#include "tests/parity/inputs.h"
#include "tests/parity/network.h"

namespace airlight {

namespace {

struct Parts {
  NetworkParts network = {.iterations = 4};
  double extinction_scale = 1;  // of the Gaussians
  glm::dvec3 camera{0, 0, 0};   // in the world of test_gaussian_scene(), whose camera is at the origin
  float extinction = 0;         // of the homogeneous part
  bool optical_depth = false;
  bool coincident = false;  // all particles in one place
};

template <class T>
Buffer add(Case& c, std::uint32_t id, const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  c.buffers.emplace_back(Buffer{{id}, bytes.size()}, std::vector<std::byte>(bytes.begin(), bytes.end()));
  return c.buffers.back().first;
}

Case splat(Extent extent, const Parts& parts) {
  Case c;
  Scene scene = test_gaussian_scene(6);
  scene.camera.position = parts.camera;
  for (Gaussian& g : scene.medium.gaussians) g.extinction *= parts.extinction_scale;
  const TestNetwork t = test_network(c, scene, network_lights(), parts.network);
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 20);
  add_to(c, surfaces);
  // The particles are the case's first buffer.
  std::vector<float> particles(c.buffers[0].second.size() / sizeof(float));
  std::copy_n(reinterpret_cast<const float*>(c.buffers[0].second.data()), particles.size(), particles.begin());
  if (parts.coincident) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto begin = particles.begin() + static_cast<std::ptrdiff_t>(axis * particles.size() / particle_planes);
      std::fill_n(begin, particles.size() / particle_planes, *begin);
    }
  }
  const NetworkFrame frame = network_frame(medium_box(scene, 12));
  const std::vector<float> splats = particle_splats(particles, frame, network_mass(scene, frame), 0.8, parts.camera);

  const Image airlight{{30}, Format::rgb32f, extent, 1, true};
  const Image through{{31}, Format::r32f, extent, 1, true};
  const Image depth{{32}, Format::r32f, extent, 1, true};
  const Image before{{33}, Format::rgb32f, extent, 1, false};
  ParticleSplats s;
  s.distance = surfaces.distance;
  if (parts.extinction > 0) {
    s.scattered = before;
    std::vector<float> values(before.floats());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(0.1 * uniform(951, static_cast<std::uint32_t>(i)));
    c.images.emplace_back(before, values);
  }
  s.lines = t.network.lines, s.particle_sources = t.iteration.sources;
  s.splats = add(c, 34, splats), s.bins = add(c, 35, splat_bins(view, splats));
  s.view = view, s.phase = parts.network.phase;
  s.particle_count = t.network.particle_count, s.line_count = t.network.line_count;
  s.extinction = parts.extinction, s.sky_distance = 100, s.ambient = {0.01F, 0.02F, 0.03F};
  s.airlight = airlight, s.transmittance = through;
  if (parts.optical_depth) s.optical_depth = depth;
  c.steps = {{t.network, ""}, {t.light, ""}, {t.iteration, ""}, {s, ""}};
  c.results = {{"airlight", airlight}, {"transmittance", through}};
  if (parts.optical_depth) c.results.emplace_back("optical_depth", depth);
  return c;
}

const NamedCase cases[] = {
    {"particle_splats/isotropic", [](Extent e) { return splat(e, {}); }},
    {"particle_splats/forward",
     [](Extent e) {
       return splat(e, {.network = {.phase = {PhaseKind::henyey_greenstein, 0.5}, .iterations = 4}, .optical_depth = true});
     }},
    {"particle_splats/in_fog", [](Extent e) { return splat(e, {.extinction = 0.06F, .optical_depth = true}); }},
    {"particle_splats/opaque", [](Extent e) { return splat(e, {.extinction_scale = 200}); }},
    {"particle_splats/camera_within",
     [](Extent e) {
       return splat(e, {.camera = {0.3, -0.2, -5}});
     }},
    {"particle_splats/one_particle",
     [](Extent e) { return splat(e, {.network = {.particles = 1, .lines = 1, .window = 1, .iterations = 2}}); }},
    {"particle_splats/coincident",
     [](Extent e) { return splat(e, {.network = {.particles = 40, .iterations = 2}, .coincident = true}); }},
};

}  // namespace

std::span<const NamedCase> particle_splats_cases() { return cases; }

}  // namespace airlight
