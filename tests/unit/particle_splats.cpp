// Splats of particles: what the plan makes of a network's particles, the image beside a plain sum in double, what is at the ends
// of what may be, and what of a frame is made, made again, and refused.
#include "common/plan/particle_splats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/airlight.h"
#include "cpu/backend.h"
#include "tests/parity/inputs.h"
#include "tests/parity/network.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

constexpr double pi = 3.141592653589793;

double field(const std::vector<float>& splats, std::size_t k, int which) {
  return static_cast<double>(splats[splat_fields * k + static_cast<std::size_t>(which)]);
}
glm::dvec3 center(const std::vector<float>& splats, std::size_t k) {
  return {field(splats, k, 0), field(splats, k, 1), field(splats, k, 2)};
}

// Nearest first; each has its share of the mass, spread as wide as its neighbours are away.
TEST(ParticleSplats, ShareTheMass) {
  const Scene scene = two_gaussians(0.7);
  const MediumBox box = medium_box(scene, 16);
  const NetworkFrame frame = network_frame(box);
  constexpr int n = 2000;
  const std::vector<float> particles = network_particles(scene, frame, n);
  double mass = 0;
  for (const Gaussian& g : scene.medium.gaussians) mass += g.extinction * std::pow(g.radius, 3) * std::pow(pi, 1.5);
  const double found = network_mass(scene, frame);
  EXPECT_NEAR(found, mass, 1e-6 * mass);
  const glm::dvec3 camera(0.3, 0.2, 1);
  const std::vector<float> splats = particle_splats(particles, frame, found, 0.8, camera);
  double sum = 0, worst = 0, mean = 0;
  for (std::size_t v = 0; v < n; ++v) mean += static_cast<double>(particles[particle_extinction * n + v]) / n;
  std::vector<bool> seen(n, false);
  for (std::size_t k = 0; k < n; ++k) {
    const auto v = static_cast<std::size_t>(splats[splat_fields * k + splat_particle]);
    EXPECT_FALSE(seen[v]);
    seen[v] = true;
    const double support = 1 / field(splats, k, splat_inverse_support);
    sum += field(splats, k, splat_peak) * pi * support * support / 3;
    const double extinction = std::max(static_cast<double>(particles[particle_extinction * n + v]), mean / 64);
    worst = std::max(worst, std::fabs(support / (1.6 * std::pow(n / 1024.0, 1 / 6.0) * std::cbrt(found / n / extinction)) - 1));
    if (k > 0) {
      EXPECT_GE(glm::length(center(splats, k)), glm::length(center(splats, k - 1)) * (1 - 1e-6));
    }
  }
  std::printf("mass off by %g, supports by %g\n", sum / mass - 1, worst);
  EXPECT_NEAR(sum, mass, 1e-5 * mass);
  EXPECT_LE(worst, 1e-6);
}

// Equally near ones stand in the order of their numbers, and one on the camera has a direction.
TEST(ParticleSplats, OfOnePlaceHaveAnOrder) {
  constexpr std::size_t n = 30;
  std::vector<float> particles(particle_planes * n, 0.0F);
  for (std::size_t k = 0; k < n; ++k)
    particles[k] = 5, particles[particle_extinction * n + k] = k == 3 ? 0.0F : 2.0F, particles[particle_mass * n + k] = 1;
  const NetworkFrame frame{{1, 2, 3}, 0.01};
  const std::vector<float> splats = particle_splats(particles, frame, 4, 1, {1.05, 2, 3});
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_EQ(splats[splat_fields * k + splat_particle], static_cast<float>(k));
    EXPECT_GT(glm::length(center(splats, k)), 0);
    EXPECT_TRUE(std::isfinite(splats[splat_fields * k + splat_peak]));
  }
  const double wide = field(splats, 0, splat_inverse_support) / field(splats, 3, splat_inverse_support);
  EXPECT_NEAR(wide, std::cbrt(64 * 30 / 29.0), 1e-5) << "none is wider";
  for (std::size_t k = 0; k < n; ++k) particles[particle_extinction * n + k] = 0;
  const std::vector<float> nothing = particle_splats(particles, frame, 0, 1, {1.05, 2, 3});
  EXPECT_EQ(nothing[splat_peak], 0);
  EXPECT_NEAR(1 / field(nothing, 0, splat_inverse_support), 0.01 * lattice_side, 1e-4) << "half the lattice";
}

// A ParticleSplats with inputs of its own, and what comes out.
struct Drawn {
  std::vector<float> splats, sources, distances, scattered;
  std::vector<std::int32_t> lines;
  ParticleSplats a;
  std::vector<float> airlight, transmittance, depth;

  explicit Drawn(Extent extent) {
    a.view = test_view(extent);
    a.distance = {{1}, Format::r32f, extent, 1, false};
    a.scattered = {{2}, Format::rgb32f, extent, 1, false};
    a.airlight = {{3}, Format::rgb32f, extent, 1, true};
    a.transmittance = {{4}, Format::r32f, extent, 1, true};
    a.optical_depth = {{5}, Format::r32f, extent, 1, true};
    distances.assign(a.distance.floats(), 1e30F);
    scattered.assign(a.scattered.floats(), 0.0F);
  }

  void add(const glm::dvec3& at, double support, double peak, const glm::vec3& sent) {
    const auto number = static_cast<float>(splats.size() / splat_fields);
    for (int axis = 0; axis < 3; ++axis) splats.push_back(static_cast<float>(at[axis]));
    splats.insert(splats.end(), {static_cast<float>(1 / support), static_cast<float>(peak), number, 0, 0});
    for (int c = 0; c < 3; ++c) sources.push_back(sent[c]);
    sources.push_back(0);
  }

  void render() {
    a.particle_count = static_cast<int>(splats.size() / splat_fields);
    if (lines.empty()) lines.assign(line_fields, 0);
    Case c;
    const auto buffer = [&](std::uint32_t id, const auto& values) {
      const auto bytes = std::as_bytes(std::span(values));
      c.buffers.emplace_back(Buffer{{id}, bytes.size()}, std::vector<std::byte>(bytes.begin(), bytes.end()));
      return c.buffers.back().first;
    };
    a.splats = buffer(6, splats), a.bins = buffer(7, splat_bins(a.view, splats));
    a.particle_sources = buffer(8, sources), a.lines = buffer(9, lines);
    c.images = {{a.distance, distances}, {a.scattered, scattered}};
    c.steps = {{a, ""}};
    CpuBackend backend{CpuOptions{.threads = 2}};
    upload(backend, c);
    Stats stats;
    NoProgress progress;
    backend.run(c.steps, stats, progress);
    airlight = download(backend, a.airlight), transmittance = download(backend, a.transmittance);
    if (a.optical_depth) depth = download(backend, a.optical_depth);
  }

  glm::dvec3 ray(int i, int j) const {
    const double w = a.view.extent.width, h = a.view.extent.height, t = static_cast<double>(a.view.tan_half_fov);
    return glm::normalize((2 * (i + 0.5) / w - 1) * t * w / h * glm::dvec3(a.view.right) +
                          (1 - 2 * (j + 0.5) / h) * t * glm::dvec3(a.view.up) + glm::dvec3(a.view.forward));
  }
};

double before(double s) {
  s = std::clamp(s, -1.0, 1.0);
  return 0.5 + 0.75 * s - 0.25 * s * s * s;
}

// What a particle sends along a unit direction: interpolated between those of the lines, both ways of each.
glm::dvec3 sent(const Drawn& drawn, std::size_t particle, const glm::dvec3& to) {
  const auto source = [&](std::size_t row) {
    const float* s = drawn.sources.data() + 4 * (row * static_cast<std::size_t>(drawn.a.particle_count) + particle);
    return glm::dvec3(s[0], s[1], s[2]);
  };
  if (drawn.a.phase.kind == PhaseKind::isotropic) return source(0);
  const double reach = 1 / static_cast<double>(drawn.a.inverse_reach());
  glm::dvec3 sum(0);
  double weights = 0;
  for (int d = 0; d < drawn.a.directions(); ++d) {
    const std::int32_t* l = drawn.lines.data() + line_fields * static_cast<std::size_t>(d / 2);
    const double chord = glm::length(glm::normalize(glm::dvec3(l[0], l[1], l[2])) * (d % 2 == 0 ? 1.0 : -1.0) - to);
    const double w = chord < reach ? std::pow((reach - chord) / (reach * std::max(chord, 1e-3)), 2) : 0;
    sum += w * source(static_cast<std::size_t>(d)), weights += w;
  }
  return sum / weights;
}

// The largest difference of a pixel from every splat blended in turn, beside the largest airlight.
double apart(const Drawn& drawn) {
  const ParticleSplats& a = drawn.a;
  const auto extinction = static_cast<double>(a.extinction);
  double worst = 0, largest = 0;
  for (int j = 0; j < a.view.extent.height; ++j) {
    for (int i = 0; i < a.view.extent.width; ++i) {
      const auto at = static_cast<std::size_t>(j * a.view.extent.width + i);
      const double length = std::min(static_cast<double>(drawn.distances[at]), static_cast<double>(a.sky_distance));
      const glm::dvec3 d = drawn.ray(i, j);
      glm::dvec3 sum(drawn.scattered[3 * at], drawn.scattered[3 * at + 1], drawn.scattered[3 * at + 2]);
      double left = 1, depth = extinction * length;
      for (std::size_t k = 0; k < drawn.splats.size() / splat_fields; ++k) {
        const glm::dvec3 c = center(drawn.splats, k);
        const double foot = glm::dot(c, d), inverse = field(drawn.splats, k, splat_inverse_support);
        const double h = glm::length(c - foot * d) * inverse;
        if (h >= 1) continue;
        const double share = std::max(before((length - foot) * inverse) - before(-foot * inverse), 0.0);
        const double tau = field(drawn.splats, k, splat_peak) * std::pow(1 - h * h, 2) * share;
        const double hidden = -left * std::expm1(-tau);
        const glm::dvec3 radiance = sent(drawn, k, glm::normalize(-c)) + glm::dvec3(a.ambient);
        sum += hidden * std::exp(-extinction * std::clamp(foot, 0.0, length)) * radiance;
        left -= hidden, depth += tau;
      }
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::fabs(static_cast<double>(drawn.airlight[3 * at + static_cast<std::size_t>(c)]) - sum[c]));
        largest = std::max(largest, sum[c]);
      }
      const double through = left * std::exp(-extinction * length);
      worst = std::max(worst, largest * std::fabs(static_cast<double>(drawn.transmittance[at]) - through));
      if (a.optical_depth)
        worst = std::max(worst, largest * std::fabs(static_cast<double>(drawn.depth[at]) - depth) / std::max(depth, 1.0));
    }
  }
  return worst / largest;
}

Drawn random_splats(Extent extent, std::uint32_t stream, double nearest) {
  Drawn drawn(extent);
  std::uint32_t next = 0;
  const auto number = [&](double from, double to) { return from + (to - from) * uniform(stream, next++); };
  std::vector<glm::dvec3> places;
  for (int k = 0; k < 150; ++k) places.emplace_back(number(-2, 2), number(-2, 2), -number(nearest, 6));
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return glm::length(a) < glm::length(b); });
  for (const glm::dvec3& at : places)
    drawn.add(at, number(0.1, 0.9), number(0.01, 1.5), glm::vec3(number(0, 1), number(0, 1), number(0, 1)));
  for (float& value : drawn.distances) value = number(0, 1) < 0.5 ? 1e30F : static_cast<float>(number(0.5, 6));
  for (float& value : drawn.scattered) value = static_cast<float>(number(0, 0.1));
  drawn.a.sky_distance = 50, drawn.a.ambient = {0.1F, 0.2F, 0};
  return drawn;
}

TEST(ParticleSplats, AreBlendedFromTheNearestOn) {
  Drawn drawn = random_splats({33, 26}, 960, 1);
  drawn.render();
  const double before_camera = apart(drawn);
  Drawn around = random_splats({33, 26}, 961, -1);
  around.a.extinction = 0.1F;
  around.render();
  const double in_fog = apart(around);
  Drawn forward = random_splats({33, 26}, 962, 1);
  forward.a.phase = {PhaseKind::henyey_greenstein, 0.5}, forward.a.line_count = 20;
  for (std::uint32_t k = 0; k < 20 * line_fields; ++k)
    forward.lines.push_back(static_cast<std::int32_t>(8000 * (uniform(963, k) - 0.5)));
  for (std::uint32_t k = 0; k < 39 * 600; ++k) forward.sources.push_back(static_cast<float>(uniform(964, k)));
  forward.render();
  const double by_direction = apart(forward);
  std::printf("apart by %g, around the camera in fog by %g, with directions by %g\n", before_camera, in_fog, by_direction);
  EXPECT_FALSE(!(std::max({before_camera, in_fog, by_direction}) <= tolerance("splats_blended")));
  // What nobody asks for is not looked at, which changes nothing else.
  Drawn less = random_splats({33, 26}, 960, 1);
  less.a.optical_depth = {};
  less.render();
  EXPECT_EQ(less.airlight, drawn.airlight);
  EXPECT_EQ(less.transmittance, drawn.transmittance);
}

TEST(ParticleSplats, AtTheEnds) {
  const Extent extent{8, 6};
  const glm::dvec3 forward = test_view(extent).forward;
  constexpr std::size_t at = 3 * 8 + 4;
  const auto red = [&](const Drawn& drawn) { return static_cast<double>(drawn.airlight[3 * at]); };
  // A splat 3 m ahead, of a support of 2 m, as the pixel's ray passes it: share of its peak, and where.
  const glm::dvec3 d = Drawn(extent).ray(4, 3);
  const double foot = 3 * glm::dot(d, forward), u = 1 - (9 - foot * foot) / 4;
  {
    Drawn none(extent);
    none.add(3.0 * forward, 1, 0, {1, 1, 1});
    none.render();
    EXPECT_EQ(none.airlight, std::vector<float>(none.airlight.size(), 0.0F));
    EXPECT_EQ(none.transmittance, std::vector<float>(none.transmittance.size(), 1.0F));
  }
  {
    Drawn opaque(extent);
    opaque.add(3.0 * forward, 5, 1e30, {2, 2, 2});
    opaque.add(4.0 * forward, 5, 1e30, {7, 7, 7});
    opaque.render();
    EXPECT_EQ(red(opaque), 2);
    EXPECT_EQ(opaque.transmittance[0], 0);
    EXPECT_GE(opaque.depth[0], 1e29F);
    EXPECT_LE(opaque.depth[0], 1e30F);
  }
  {
    Drawn behind(extent);
    behind.add(3.0 * forward, 1, 9, {1, 1, 1});
    behind.distances.assign(behind.distances.size(), 1.5F);
    behind.render();
    EXPECT_EQ(behind.airlight, std::vector<float>(behind.airlight.size(), 0.0F));
  }
  {
    // A surface in the middle of a splat, and the camera: half of it.
    Drawn half(extent), on(extent);
    half.add(3.0 * forward, 2, 0.5, {1, 1, 1});
    half.distances[at] = static_cast<float>(foot);
    half.render();
    on.add(-1e-6 * forward, 10, 0.5, {1, 1, 1});
    on.render();
    EXPECT_NEAR(static_cast<double>(half.depth[at]), 0.25 * u * u, 1e-6);
    EXPECT_NEAR(static_cast<double>(on.depth[at]), 0.25, 1e-6);
    EXPECT_NEAR(red(on), -std::expm1(-0.25), 1e-6);
  }
  {
    Drawn many(extent);
    for (int k = 0; k < 50; ++k) many.add(3.0 * forward, 2, 0.02, glm::vec3(k == 0 ? 1 : 0));
    many.render();
    EXPECT_NEAR(static_cast<double>(many.transmittance[at]), std::exp(-u * u), 1e-6);
    EXPECT_NEAR(red(many), -std::expm1(-0.02 * u * u), 1e-7) << "the first is before the others";
  }
}

RenderSettings settings_of(std::vector<std::pair<std::string, std::string>> knobs) {
  RenderSettings settings;
  settings.technique = "illumination-network";
  settings.resolution = Extent{24, 18};
  settings.knobs = {{"particles", "200"}, {"directions", "20"}, {"resolution", "8"}, {"steps", "8"}, {"image", "splats"}};
  settings.knobs.insert(settings.knobs.end(), knobs.begin(), knobs.end());
  return settings;
}

TEST(ParticleSplats, OnlyWhatChangedIsMadeAgain) {
  Scene scene = two_gaussians(0.8);
  scene.lights = network_lights();
  Renderer warm({.backend = "cpu"});
  const auto ran = [&] {
    const Frame frame = warm.render(scene, settings_of({}));
    Renderer cold({.backend = "cpu"});
    EXPECT_EQ(frame.image("beauty").values, cold.render(scene, settings_of({})).image("beauty").values);
    std::string names;
    for (const StepStats& step : frame.stats.steps) {
      if (!step.reused && step.name != "surface_visibility" && step.name != "surface_shading" && step.name != "compose")
        names += step.name + " ";
    }
    return names;
  };
  EXPECT_EQ(ran(), "visibility_network particle_light network_iteration particle_splats ");
  scene.camera.position.z += 0.5;
  EXPECT_EQ(ran(), "particle_splats ");
  scene.lights[0].power *= 2;
  EXPECT_EQ(ran(), "particle_light network_iteration particle_splats ");
  scene.medium.gaussians[1].extinction *= 2;
  EXPECT_EQ(ran(), "visibility_network particle_light network_iteration particle_splats ");
}

TEST(ParticleSplats, SayWhatIsLeftOut) {
  Scene scene = two_gaussians(0.8);
  scene.lights = network_lights();
  scene.sky_distance = 30;
  const std::string plain = explain(scene, settings_of({}));
  EXPECT_NE(plain.find("source_function"), std::string::npos) << plain;
  EXPECT_NE(plain.find("image = splats"), std::string::npos) << plain;
  EXPECT_NE(plain.find("no homogeneous part"), std::string::npos) << plain;
  scene.medium.extinction = 0.01;
  const std::string foggy = explain(scene, settings_of({}));
  EXPECT_NE(foggy.find("light scattered once by the homogeneous part"), std::string::npos) << foggy;
  EXPECT_EQ(foggy.find("no homogeneous part"), std::string::npos) << foggy;
  // Fog so thin that it is as good as none changes nothing that can be seen.
  Renderer renderer({.backend = "cpu"});
  scene.medium.extinction = 1e-9;
  const HostImage in_fog = renderer.render(scene, settings_of({})).image("beauty");
  scene.medium.extinction = 0;
  const HostImage without = renderer.render(scene, settings_of({})).image("beauty");
  float largest = 0;
  for (const float value : without.values) largest = std::max(largest, value);
  ASSERT_GT(largest, 0);
  for (std::size_t i = 0; i < without.values.size(); ++i) EXPECT_NEAR(in_fog.values[i], without.values[i], 1e-5F * largest);
}

TEST(ParticleSplats, RefuseWhatTheyHaveNot) {
  Scene scene = two_gaussians(0.8);
  scene.lights = network_lights();
  scene.lights[0].name = "lamp";
  const auto refused = [&](const RenderSettings& settings) -> std::string {
    Renderer renderer({.backend = "cpu"});
    try {
      renderer.render(scene, settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_EQ(refused(settings_of({{"airlight_resolution", "half"}})),
            "setting image: splats render every pixel; expected airlight_resolution=full, or image=source");
  RenderSettings one = settings_of({});
  one.images = {"airlight.lamp"};
  EXPECT_EQ(refused(one),
            "setting image: splats do not tell lights apart; expected no image of one light's airlight, or image=source");
  EXPECT_NE(refused(settings_of({{"splat_radius", "0"}})).find("splat_radius"), std::string::npos);
  EXPECT_EQ(refused(settings_of({})), "nothing");
}

}  // namespace

}  // namespace airlight
