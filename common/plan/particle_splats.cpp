#include "common/plan/particle_splats.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <utility>

#include "common/error.h"
#include "common/plan/gaussian_bins.h"
#include "common/plan/hash.h"
#include "common/plan/upload.h"

namespace airlight {

namespace {

constexpr double least_support = 1e-9;  // [m], so that distances in supports stay floats
constexpr double most_peak = 1e30, least_peak = 1e-30;

// The cube root of a finite number, > 0. (The C library's bits depend on the machine.)
double cube_root(double x) {
  double scale = 1;
  while (x >= 8) x /= 8, scale *= 2;
  while (x < 1) x *= 8, scale /= 2;
  double root = 1.5;  // of 1..8: 1..2, where Newton's steps double the digits from the first on
  for (int i = 0; i < 6; ++i) root = (2 * root + x / (root * root)) / 3;
  return root * scale;
}

std::vector<float> floats_of(const std::vector<std::byte>& bytes) {
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

// Throws InputError where a setting or an image asks for what splats have not.
void refuse_settings(const FramePlan& frame) {
  const auto refuse = [](const char* what) {
    throw InputError("setting image: splats " + std::string(what) + ", or image=source");
  };
  if (frame.request.knobs.choice("airlight_resolution") != "full")
    refuse("render every pixel; expected airlight_resolution=full");
  if (frame.per_light) refuse("do not tell lights apart; expected no image of one light's airlight");
}

// What the homogeneous part scatters and emits on the view ray, seen through everything; absent where there is none.
Image add_homogeneous(FramePlan& frame, RayMarch march, std::uint32_t first_id) {
  if (!(frame.extinction > 0) && frame.scene.medium.emission == glm::dvec3(0)) {
    frame.plan.skips.push_back({Rule::no_fog, "ray_march", "no homogeneous part beside the particles"});
    return {};
  }
  for (GaussianDensity& g : march.gaussians) g.albedo = g.emission = glm::vec3(0);
  march.grid.albedo = glm::vec3(0);
  march.airlight = frame.handed_on(first_id, Format::rgb32f, 1);
  march.transmittance = frame.handed_on(first_id + 1, Format::r32f, 1);
  march.per_light = march.optical_depth = {};
  march.sources = {};
  frame.plan.steps.push_back({march, "light scattered once by the homogeneous part"});
  return march.airlight;
}

}  // namespace

Knob splat_radius_knob() {
  return number_knob("splat_radius", "0.8", 0.1, 10,
                     "of image=splats: root of the mean square radius of a splat, beside the distance between particles, of "
                     "1024; of others as the 6th root of their number");
}

std::vector<float> particle_splats(const std::vector<float>& particles, const NetworkFrame& frame, double mass, double radius,
                                   const glm::dvec3& camera) {
  constexpr double pi = 3.141592653589793;
  const std::size_t n = particles.size() / particle_planes;
  const double share = mass / static_cast<double>(n), most_support = frame.unit * lattice_side;
  const double width = 2 * radius * cube_root(std::sqrt(static_cast<double>(n) / 1024));
  struct Seen {
    glm::dvec3 center;
    double squared;
    std::size_t particle;
  };
  std::vector<Seen> seen;
  double least_extinction = 0;
  for (std::size_t k = 0; k < n; ++k) {
    glm::dvec3 place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = static_cast<double>(particles[(particle_place + static_cast<std::size_t>(axis)) * n + k]);
    const glm::dvec3 center = frame.middle + place * frame.unit - camera;
    least_extinction += static_cast<double>(particles[particle_extinction * n + k]) / (64 * static_cast<double>(n));
    seen.push_back({center, center.x * center.x + center.y * center.y + center.z * center.z, k});
  }
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.squared != b.squared ? a.squared < b.squared : a.particle < b.particle;
  });
  std::vector<float> splats(splat_fields * n, 0.0F);
  for (std::size_t k = 0; k < n; ++k) {
    const Seen& s = seen[k];
    const double extinction = std::max(static_cast<double>(particles[particle_extinction * n + s.particle]), least_extinction);
    const double mass_here = share * static_cast<double>(particles[particle_mass * n + s.particle]);
    const double volume = extinction > 0 ? mass_here / extinction : 0;
    double support = extinction > 0 ? least_support : most_support;
    if (volume > 0) support = std::clamp(width * cube_root(volume), least_support, std::max(most_support, least_support));
    const double peak = std::min(3 * mass_here / (pi * support * support), most_peak);
    float* one = splats.data() + splat_fields * k;
    for (int axis = 0; axis < 3; ++axis) one[splat_center + axis] = static_cast<float>(s.center[axis]);
    // One on the camera is taken to be a little before it: it sends into some direction.
    if (s.squared == 0) one[splat_center + 2] = static_cast<float>(-1e-6 * support);
    one[splat_inverse_support] = static_cast<float>(1 / support);
    one[splat_peak] = peak > least_peak ? static_cast<float>(peak) : 0.0F;
    one[splat_particle] = static_cast<float>(s.particle);
  }
  return splats;
}

namespace {

// What squares are told for.
std::vector<GaussianDensity> reaches_of(const std::vector<float>& splats) {
  std::vector<GaussianDensity> all(splats.size() / splat_fields);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const float* one = splats.data() + splat_fields * k;
    all[k].center = {one[splat_center], one[splat_center + 1], one[splat_center + 2]};
    all[k].reach = 1 / one[splat_inverse_support];
  }
  return all;
}

}  // namespace

std::vector<std::int32_t> splat_bins(const View& view, const std::vector<float>& splats) {
  return gaussian_bins(view, reaches_of(splats), "image", "splats");
}

void add_particle_splats(FramePlan& frame, const NetworkIteration& network, const Plan::Upload& particles,
                         const NetworkFrame& lattice, RayMarch march, std::uint32_t first_id) {
  refuse_settings(frame);
  const Scene& scene = frame.scene;
  const Image scattered = add_homogeneous(frame, std::move(march), first_id);
  const double radius = frame.request.knobs.number("splat_radius");
  // Splats are made from particles, lists from splats: each once.
  struct Made {
    std::vector<float> splats;
  };
  const auto splats = [made = std::make_shared<Made>(), sampled = particles.make, lattice, world = scene,
                       radius]() -> const std::vector<float>& {
    if (made->splats.empty()) {
      made->splats = particle_splats(floats_of(sampled()), lattice, network_mass(world, lattice), radius, world.camera.position);
    }
    return made->splats;
  };
  Hash key;
  key.add(std::string_view("splats"));
  key.add(particles.key);
  key.add(radius);
  for (int axis = 0; axis < 3; ++axis) key.add(scene.camera.position[axis]);
  const std::size_t floats = splat_fields * static_cast<std::size_t>(network.particle_count);
  frame.plan.uploads.push_back(table_upload({{first_id + 2}, sizeof(float) * floats}, key.value(), splats));
  const Buffer splat_buffer = frame.plan.uploads.back().buffer;
  key.add(frame.view);
  frame.plan.uploads.push_back(
      {{{first_id + 3}, 0},
       key.value(),
       [splats, view = frame.view] {
         const std::vector<std::int32_t> bins = splat_bins(view, splats());
         const auto bytes = std::as_bytes(std::span(bins));
         return std::vector<std::byte>(bytes.begin(), bytes.end());
       },
       [splats, view = frame.view] { return sizeof(std::int32_t) * count_gaussian_bins(view, reaches_of(splats())); }});
  frame.plan.steps.push_back({ParticleSplats{.distance = frame.distance,
                                             .scattered = scattered,
                                             .lines = network.lines,
                                             .particle_sources = network.sources,
                                             .splats = splat_buffer,
                                             .bins = frame.plan.uploads.back().buffer,
                                             .view = frame.view,
                                             .phase = network.phase,
                                             .particle_count = network.particle_count,
                                             .line_count = network.line_count,
                                             .random_directions = frame.request.knobs.choice("direction_set") == "random",
                                             .extinction = frame.extinction,
                                             .sky_distance = frame.sky_distance,
                                             .ambient = scattered ? glm::vec3(0) : frame.ambient,
                                             .airlight = frame.airlight,
                                             .transmittance = frame.transmittance,
                                             .optical_depth = frame.optical_depth},
                              "the particles, sorted and splatted, as published"});
}

}  // namespace airlight
