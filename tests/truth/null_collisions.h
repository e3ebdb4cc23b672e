// Walks of light that share nothing with the reference's paths: collisions that count and such that do not (Woodcock et al. 1965)
// where those invert exact optical depths, ratio tracking toward the lights (Novak et al. 2014), every triangle tried.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "tests/parity/inputs.h"
#include "tests/truth/plain_sums.h"

namespace airlight {

// Of a scene whose surfaces all cast shadows, with a phase function of Henyey and Greenstein or none; its green channel.
class NullCollisions : public BruteForce {
 public:
  NullCollisions(const Scene& s, int max_bounces) : BruteForce(s), max_bounces_(max_bounces), g_(s.medium.phase.g) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    const auto hold = [&](const glm::dvec3& a) { low = glm::min(low, a), high = glm::max(high, a); };
    for (const Gaussian& one : s.medium.gaussians) {
      hold(one.center - 6.5 * one.radius), hold(one.center + 6.5 * one.radius);  // exp(-6.5^2) is below 1e-18
      most_ += one.extinction;
    }
    if (s.medium.grid) {
      const GridMedium& grid = *s.medium.grid;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
        hold(grid.transform * glm::dvec4(at * (glm::dvec3(grid.voxels->size) + 1.0) - 0.5, 1));
      }
      most_ += grid.scale * static_cast<double>(*std::max_element(grid.voxels->values.begin(), grid.voxels->values.end()));
      to_cells_ = glm::inverse(grid.transform);
    }
    middle_ = 0.5 * (low + high), reach_ = 0.5 * glm::length(high - low);
  }

  // Light scattered 2..max_bounces times that arrives at the camera against `way`: one sample [W/m^2/sr].
  double sample(glm::dvec3 way, std::uint32_t stream) {
    stream_ = stream, next_ = 0;
    glm::dvec3 p = scene.camera.position;
    double weight = 1, sum = 0;
    for (int order = 1; order <= max_bounces_; ++order) {
      const glm::dvec3 from = p;
      double wall = std::numeric_limits<double>::infinity(), t = 0;
      for (const Corners& triangle : triangles) {
        const double at = meets(from, way, triangle);
        if (at > 0) wall = std::min(wall, at);
      }
      const double fog = scene.medium.extinction, most = most_ + fog;
      double extinction = 0, scattered = 0;
      do {
        t -= std::log(1 - draw()) / most;
        p = from + t * way;
        if (t > wall || (fog == 0 && left(p, way))) return sum;
        medium_at(p, extinction, scattered);
        extinction += fog, scattered += fog * scene.medium.albedo.y;
      } while (draw() * most >= extinction);
      weight *= scattered / extinction;
      if (order > 1) sum += weight * of_lights(from, way, t, p);
      if (weight < 0.2) {
        if (draw() < 0.5) return sum;
        weight *= 2;
      }
      way = turned(way);
    }
    return sum;
  }

 private:
  double draw() { return uniform(stream_, next_++); }
  bool left(const glm::dvec3& p, const glm::dvec3& way) const {
    return glm::length(p - middle_) > reach_ && glm::dot(p - middle_, way) > 0;
  }
  double phase(double mu) const { return (1 - g_ * g_) / (4 * std::numbers::pi * std::pow(1 + g_ * g_ - 2 * g_ * mu, 1.5)); }

  // Gaussians and grid [1/m].
  void medium_at(const glm::dvec3& p, double& extinction, double& scattered) const {
    extinction = scattered = 0;
    for (const Gaussian& one : scene.medium.gaussians) {
      const double here = one.extinction * density(one, p);
      extinction += here, scattered += here * one.albedo.y;
    }
    if (!scene.medium.grid) return;
    const GridMedium& grid = *scene.medium.grid;
    const glm::dvec3 at = glm::dvec3(to_cells_ * glm::dvec4(p, 1)) - 0.5, low = glm::floor(at), w = at - low;
    const glm::ivec3 size = grid.voxels->size;
    double here = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2), cell = glm::ivec3(low) + step;
      if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x >= size.x || cell.y >= size.y || cell.z >= size.z) continue;
      const glm::dvec3 share = glm::mix(1.0 - w, w, glm::dvec3(step));
      here += share.x * share.y * share.z *
              static_cast<double>(grid.voxels->values[static_cast<std::size_t>(cell.x + size.x * (cell.y + size.y * cell.z))]);
    }
    extinction += grid.scale * here, scattered += grid.scale * here * grid.albedo.y;
  }

  // Of Gaussians and grid from p along a unit direction; its mean is the transmittance.
  double ratio(const glm::dvec3& p, const glm::dvec3& toward, double length) {
    double product = 1, t = 0, extinction = 0, scattered = 0;
    if (!(most_ > 0)) return 1;
    for (;;) {
      t -= std::log(1 - draw()) / most_;
      const glm::dvec3 at = p + t * toward;
      if (t > length || left(at, toward)) return product;
      medium_at(at, extinction, scattered);
      product *= 1 - extinction / most_;
    }
  }

  // What p, at t from `from` along `way`, scatters of the lights against it.
  double of_lights(const glm::dvec3& from, const glm::dvec3& way, double t, const glm::dvec3& p) {
    double sum = 0;
    for (const LightSource& one : scene.lights) {
      if (one.type == LightType::directional) {
        if (!sees(p, p - 1000.0 * one.direction)) continue;
        sum += one.power.y * ratio(p, -one.direction, 1000) * phase(-glm::dot(one.direction, way));
        continue;
      }
      if (!sees(p, one.position)) continue;
      const double foot = glm::dot(one.position - from, way);
      const double h = std::max(glm::length(glm::cross(one.position - from, way)), one.radius), r = std::hypot(h, t - foot);
      sum += one.power.y / (r * r) * std::exp(-scene.medium.extinction * r) * phase((foot - t) / r) *
             ratio(p, glm::normalize(one.position - p), glm::distance(one.position, p));
    }
    return sum;
  }

  glm::dvec3 turned(const glm::dvec3& way) {
    double mu = 2 * draw() - 1;
    if (g_ != 0) {
      const double q = (1 - g_ * g_) / (1 + g_ * mu);
      mu = (1 + g_ * g_ - q * q) / (2 * g_);
    }
    const double angle = 2 * std::numbers::pi * draw(), s = std::sqrt(std::max(1 - mu * mu, 0.0));
    const glm::dvec3 beside = std::fabs(way.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 a = glm::normalize(glm::cross(beside, way)), b = glm::cross(way, a);
    return glm::normalize(mu * way + s * std::cos(angle) * a + s * std::sin(angle) * b);
  }

  int max_bounces_;
  double g_, most_ = 0, reach_ = 0;  // [1/m] Gaussians and grid are nowhere denser; [m] nor are they farther from the middle
  glm::dvec3 middle_{0};
  glm::dmat4 to_cells_{1};
  std::uint32_t stream_ = 0, next_ = 0;
};

}  // namespace airlight
