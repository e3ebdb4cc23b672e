#include "common/plan/network.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <span>

#include "common/formulas/float.h"
#include "common/plan/geometry.h"
#include "common/plan/hash.h"
#include "common/plan/upload.h"
#include "common/plan/voxels.h"

namespace airlight {

namespace {

// [W/m^2/sr] of what glows with hardly any extinction, so that sums over links stay floats.
constexpr double most_glow = 1e20;

double fraction(double x) { return x - std::floor(x); }

// The n-th of a sequence of points in the unit cube.
glm::dvec3 low_discrepancy(std::size_t n) {
  constexpr double root = 1.2207440846057596;
  const auto k = static_cast<double>(n);
  return {fraction(0.5 + k / root), fraction(0.5 + k / (root * root)), fraction(0.5 + k / (root * root * root))};
}

// x with (1 + erf x) / 2 = share, by bisection: no C library's result reaches a table.
double inverse_gaussian(double share) {
  double low = -3.9, high = 3.9;
  for (int i = 0; i < 26; ++i) {
    const double middle = 0.5 * (low + high);
    const f32::Float erf = f32::erf_(middle);
    (0.5 * (1 + static_cast<double>(erf.v)) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// What is at a place, in m and beside the middle.
struct Mixture {
  double extinction = 0;
  glm::dvec3 scattering{0, 0, 0}, emission{0, 0, 0};
};

class ParticleSampler {
 public:
  ParticleSampler(const Scene& scene, const NetworkFrame& frame) : frame_(frame) {
    gaussians_ = gaussians_of(scene, frame.middle);
    for (const GaussianDensity& g : gaussians_) add_component(mass_of(g));
    if (scene.medium.grid) {
      const GridMedium& grid = *scene.medium.grid;
      to_world_ = grid.transform;
      size_ = grid.voxels->size;
      grid_ = grid_density(grid, frame.middle);
      voxels_ = voxel_table(grid);
      const double cell = std::fabs(glm::determinant(glm::dmat3(to_world_))) * grid.scale;
      for (const float value : grid.voxels->values) add_component(cell * static_cast<double>(value));
    }
  }

  double total() const { return masses_.empty() ? 0 : masses_.back(); }

  // The k-th of n, on the lattice.
  glm::ivec3 sampled_place(std::size_t k, std::size_t n) {
    const double target = (static_cast<double>(k) + 0.5) / static_cast<double>(n) * total();
    while (next_ + 1 < masses_.size() && masses_[next_] < target) ++next_;
    const glm::dvec3 u = low_discrepancy(k);
    glm::dvec3 p;
    if (next_ < gaussians_.size()) {
      const GaussianDensity& g = gaussians_[next_];
      p = {inverse_gaussian(u.x), inverse_gaussian(u.y), inverse_gaussian(u.z)};
      const double reach = static_cast<double>(g.reach) / static_cast<double>(g.radius), length = glm::length(p);
      if (length > 0.99 * reach) p *= 0.99 * reach / length;
      p = glm::dvec3(g.center) + static_cast<double>(g.radius) * p;
    } else {
      const auto cell = static_cast<int>(next_ - gaussians_.size());
      const glm::dvec3 at(cell % size_.x, cell / size_.x % size_.y, cell / size_.x / size_.y);
      p = glm::dvec3(to_world_ * glm::dvec4(at + u, 1)) - frame_.middle;
    }
    return on_lattice(p);
  }

  // Of the k-th Gaussian.
  glm::ivec3 gaussian_place(std::size_t k) const { return on_lattice(glm::dvec3(gaussians_[k].center)); }
  double gaussian_mass(std::size_t k) const { return mass_of(gaussians_[k]); }

  Mixture mixture(const glm::ivec3& lattice) const {
    Mixture m;
    const glm::vec3 p = glm::dvec3(lattice) * frame_.unit;
    for (const GaussianDensity& g : gaussians_) {
      const glm::vec3 e = g.center - p;
      const float squared = e.x * e.x + e.y * e.y + e.z * e.z;
      if (squared >= g.reach * g.reach) continue;
      const auto falloff = static_cast<double>(f32::gaussian_falloff(1 / g.radius, squared).v);
      const double extinction = falloff * static_cast<double>(g.extinction);
      m.extinction += extinction;
      m.scattering += extinction * glm::dvec3(g.albedo);
      m.emission += falloff * glm::dvec3(g.emission);
    }
    if (grid_) {
      float c[3];
      for (int axis = 0; axis < 3; ++axis) {
        const glm::vec4& row = grid_.cells[axis];
        c[axis] = row.x * p.x + row.y * p.y + row.z * p.z + row.w;
      }
      const auto extinction = static_cast<double>(f32::grid_extinction(voxels_.data(), 0, c[0], c[1], c[2]).v);
      m.extinction += extinction;
      m.scattering += extinction * glm::dvec3(grid_.albedo);
    }
    return m;
  }

 private:
  static double mass_of(const GaussianDensity& g) {
    constexpr double pi_to_three_halves = 5.568327996831707;
    const auto r = static_cast<double>(g.radius);
    return static_cast<double>(g.extinction) * r * r * r * pi_to_three_halves;
  }
  glm::ivec3 on_lattice(const glm::dvec3& p) const {
    glm::ivec3 lattice;
    for (int axis = 0; axis < 3; ++axis) {
      const double on_axis = std::floor(p[axis] / frame_.unit + 0.5);
      lattice[axis] = static_cast<int>(std::clamp<double>(on_axis, -lattice_side, lattice_side));
    }
    return lattice;
  }
  void add_component(double mass) { masses_.push_back(total() + mass); }

  const NetworkFrame& frame_;
  std::vector<GaussianDensity> gaussians_;
  glm::dmat4 to_world_{1.0};
  glm::ivec3 size_{1, 1, 1};
  GridDensity grid_;
  std::vector<float> voxels_;
  std::vector<double> masses_;  // [m^2] extinction integrated over Gaussians, then cells, summed up
  std::size_t next_ = 0;
};

// Number of a place along Morton's curve, which keeps neighbours together.
std::uint64_t along_curve(const glm::ivec3& place) {
  std::uint64_t number = 0;
  for (unsigned bit = 0; bit < 14; ++bit) {
    for (int axis = 0; axis < 3; ++axis) {
      const int on_axis = place[axis] + lattice_side;
      number |= (static_cast<std::uint64_t>(on_axis) >> bit & 1U) << (3 * bit + static_cast<unsigned>(axis));
    }
  }
  return number;
}

}  // namespace

NetworkFrame network_frame(const MediumBox& box) {
  const glm::dvec3 size = box.size();
  // No sum of three products may pass 2^27, nor any place the lattice.
  return {box.corner + 0.5 * size, 0.5 * glm::length(size) / (lattice_side - 1)};
}

double network_mass(const Scene& scene, const NetworkFrame& frame) { return ParticleSampler(scene, frame).total(); }

int gaussian_particles(const Scene& scene) {
  return static_cast<int>(std::count_if(scene.medium.gaussians.begin(), scene.medium.gaussians.end(),
                                        [](const Gaussian& g) { return g.extinction > 0; }));
}

std::vector<float> network_particles(const Scene& scene, const NetworkFrame& frame, int count, ParticleSet set) {
  const auto n = static_cast<std::size_t>(count);
  ParticleSampler sampler(scene, frame);
  const bool sampled = set == ParticleSet::sampled;
  struct Particle {
    glm::ivec3 place;
    std::size_t number;
  };
  std::vector<Particle> all(n);
  for (std::size_t k = 0; k < n; ++k) all[k] = {sampled ? sampler.sampled_place(k, n) : sampler.gaussian_place(k), k};
  std::sort(all.begin(), all.end(), [](const Particle& a, const Particle& b) {
    const std::uint64_t x = along_curve(a.place), y = along_curve(b.place);
    return x != y ? x < y : a.number < b.number;
  });
  std::vector<float> planes(particle_planes * n);
  for (std::size_t k = 0; k < n; ++k) {
    const auto& [place, number] = all[k];
    const Mixture m = sampler.mixture(place);
    const double scale = m.extinction > 0 ? 1 / m.extinction : 0;
    planes[particle_extinction * n + k] = static_cast<float>(m.extinction);
    planes[particle_mass * n + k] =
        sampled || !(sampler.total() > 0) ? 1 : static_cast<float>(sampler.gaussian_mass(number) / sampler.total() * count);
    for (int c = 0; c < 3; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      planes[(particle_place + channel) * n + k] = static_cast<float>(place[c]);
      planes[(particle_albedo + channel) * n + k] = static_cast<float>(std::min(m.scattering[c] * scale, 1.0));
      planes[(particle_glow + channel) * n + k] = static_cast<float>(std::min(m.emission[c] * scale, most_glow));
    }
  }
  return planes;
}

std::vector<Plan::Upload> network_uploads(const Scene& scene, const MediumBox& box, int particles, int lines, int window,
                                          std::uint32_t first_id, DirectionSet set, ParticleSet particle_set) {
  const NetworkFrame frame = network_frame(box);
  Hash key;
  key.add(std::string_view("network"));
  key.add(gaussians_of(scene, frame.middle));
  for (int axis = 0; axis < 3; ++axis) key.add(frame.middle[axis]);
  key.add(frame.unit);
  if (scene.medium.grid) {
    key.add(voxels_of(*scene.medium.grid, first_id).key);
    const GridDensity grid = grid_density(*scene.medium.grid, frame.middle);
    key.add(grid);
  }
  key.add(particles);
  key.add(static_cast<int>(particle_set));
  // Lines are made from particles, which are made once for both.
  struct Made {
    std::vector<float> particles;
  };
  const auto made = std::make_shared<Made>();
  const auto sampled = [made, scene, frame, particles, particle_set]() -> const std::vector<float>& {
    if (made->particles.empty()) made->particles = network_particles(scene, frame, particles, particle_set);
    return made->particles;
  };
  const auto bytes_of = [](const auto& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };
  std::vector<Plan::Upload> uploads;
  uploads.push_back({Buffer{{first_id}, sizeof(float) * particle_planes * static_cast<std::size_t>(particles)}, key.value(),
                     [sampled, bytes_of] { return bytes_of(sampled()); }});
  key.add(lines);
  key.add(window);
  key.add(static_cast<int>(set));
  const NetworkShape shape{static_cast<std::size_t>(particles), static_cast<std::size_t>(lines),
                           static_cast<std::size_t>(window) * static_cast<std::size_t>(window)};
  uploads.push_back({Buffer{{first_id + 1}, sizeof(std::int32_t) * shape.line_integers()}, key.value(),
                     [sampled, bytes_of, lines, window, set] { return bytes_of(network_lines(sampled(), lines, window, set)); }});
  return uploads;
}

}  // namespace airlight
