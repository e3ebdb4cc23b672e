#include "common/plan/gaussian_shadows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace airlight {

namespace {

constexpr double faint_depth = 0.03;

double squared(double x) { return x * x; }

}  // namespace

double smooth_radius(const GaussianDensity& g) {
  return static_cast<double>(g.radius) + faint_depth / static_cast<double>(g.extinction);
}

LightWays::LightWays(const Light& light, const Sphere& s)
    : vector_(light.vector), radius_(s.radius), directional_(light.directional) {
  if (directional_) {
    toward_ = -vector_;
    vector_ = s.center;
    return;
  }
  toward_ = s.center - vector_;
  length_ = glm::length(toward_);
  within_ = length_ <= radius_ * 1.001;
  if (within_) {
    vector_ = s.center;
    return;
  }
  toward_ /= length_;
  sine_ = radius_ / length_;
  cosine_ = std::sqrt(1 - sine_ * sine_);
}

bool LightWays::meet(const GaussianDensity& g) const {
  const glm::dvec3 e = glm::dvec3(g.center) - vector_;
  const double reach = static_cast<double>(g.reach) * (1 + 1e-6), all = glm::dot(e, e);
  if (within_) return all < squared(reach + radius_);
  const double along = glm::dot(e, toward_);
  if (directional_) return along > -(reach + radius_) && all - along * along < squared(reach + radius_);
  if (along <= -reach || along >= length_ + radius_ + reach) return false;
  return std::max(0.0, all - along * along) * squared(cosine_) < squared(std::max(0.0, along) * sine_ + reach);
}

bool LightWays::behind(const GaussianDensity& g) const {
  if (directional_) return false;
  if (within_) return true;
  const glm::dvec3 e = glm::dvec3(g.center) - vector_;
  const double all = glm::dot(e, e), along = glm::dot(e, toward_);
  if (all < squared(static_cast<double>(g.reach)) || along <= 0) return true;
  return squared(along * cosine_) <= std::max(0.0, all - along * along) * squared(sine_);
}

double LightWays::smooth(const GaussianDensity& g, const Light& light) const {
  double grown = 1;
  if (!directional_ && length_ > radius_) {
    const double distance = glm::length(glm::dvec3(g.center - light.vector));
    grown = std::max(1.0, (length_ - radius_) / std::max(distance, static_cast<double>(g.radius)));
  }
  return smooth_radius(g) * grown;
}

GaussianReach::GaussianReach(const std::vector<GaussianDensity>& gaussians) {
  for (const GaussianDensity& g : gaussians) {
    const glm::dvec3 center(g.center), reach(static_cast<double>(g.reach));
    least_ = glm::min(least_, center - reach);
    most_ = glm::max(most_, center + reach);
    smooth_ = std::min(smooth_, smooth_radius(g));
  }
}

// Else no place of the way to the sphere's centre is within the sphere's radius of the box.
bool GaussianReach::shades(const Light& light, const Sphere& s) const {
  const glm::dvec3 way = light.directional ? -glm::dvec3(light.vector) : glm::dvec3(light.vector) - s.center;
  double from = 0, to = light.directional ? 1e300 : 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = least_[axis] - s.radius - s.center[axis], high = most_[axis] + s.radius - s.center[axis];
    if (way[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / way[axis], b = high / way[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to;
}

double GaussianReach::smooth(const Light& light, const Sphere& s) const {
  if (light.directional) return smooth_;
  const glm::dvec3 position(light.vector);
  const double nearest = glm::length(s.center - position) - s.radius;
  return smooth_ * std::max(1.0, nearest / glm::length(glm::max(position - least_, most_ - position)));
}

}  // namespace airlight
