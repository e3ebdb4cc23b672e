#include "common/plan/depths_to_centers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/formulas/float.h"
#include "common/plan/sweep.h"

namespace airlight {

namespace {

constexpr double infinite = 1e300;
// Boxes hold what they should although they are rounded: so much wider, beside a size and beside 1.
constexpr double wider = 1e-9, rounding = 1e-12;

double squared(double x) { return x * x; }

// Most ends of ways are far from most Gaussians.
f32::Float error_function(double x) {
  static const f32::Float end = f32::erf_end(), far = f32::erf_(end);
  return f32::Float(x) >= end ? far : f32::Float(x) <= -end ? -far : f32::erf_(x);
}

// A way of a length [m] that begins at a place, or does not end.
struct Way {
  glm::dvec3 from, direction;
  double length = infinite;
};

// Optical depth of a Gaussian on the way; 0 where its reach is not met.
double depth_on(const Way& way, const GaussianDensity& g) {
  const glm::dvec3 center = glm::dvec3(g.center) - way.from;
  const double foot = glm::dot(way.direction, center);
  const glm::dvec3 beside = center - foot * way.direction;
  const double h2 = glm::dot(beside, beside), nearest = std::clamp(foot, 0.0, way.length);
  if (!(h2 + squared(foot - nearest) < squared(static_cast<double>(g.reach)))) return 0;
  const float inverse = 1 / g.radius;
  const f32::Float lateral = f32::gaussian_lateral(inverse, std::sqrt(h2)), whole = f32::gaussian_whole(g.extinction, g.radius);
  const f32::Float share = f32::gaussian_between(lateral, error_function(-foot * static_cast<double>(inverse)),
                                                 error_function((way.length - foot) * static_cast<double>(inverse)));
  return static_cast<double>(share.v) * static_cast<double>(whole.v);
}

// The way to a centre; of no length where the origin is there.
Way way_to(const glm::dvec3& place) {
  const double length = glm::length(place);
  return {glm::dvec3(0), length > 0 ? place / length : glm::dvec3(1, 0, 0), length};
}

// A direction's place about +Y, in 0..4: it ascends with the angle.
double around(double x, double z) {
  const double sum = std::fabs(x) + std::fabs(z);
  if (!(sum > 0)) return 0;
  if (z >= 0) return x >= 0 ? z / sum : 1 - x / sum;
  return x < 0 ? 2 - z / sum : 3 + x / sum;
}

// Boxes in height and angle that hold all directions within a cone.
class Boxes {
 public:
  void add(const GaussianDensity& g, std::uint32_t owner) {
    const glm::dvec3 center(g.center);
    const double distance = glm::length(center);
    const double sine = static_cast<double>(g.reach) * (1 + wider) + rounding * distance;  // times the distance
    if (!(sine < distance)) {
      list.push_back({{-2, 2}, {-1, 5}, owner});
      return;
    }
    cone(center / distance, sine / distance, owner);
  }

  std::vector<SweptBox> list;

 private:
  void cone(const glm::dvec3& axis, double sine, std::uint32_t owner) {
    const double cosine = std::sqrt(1 - sine * sine), radius = std::sqrt(squared(axis.x) + squared(axis.z));
    SweptRange height{axis.y * cosine - radius * sine - rounding, axis.y * cosine + radius * sine + rounding};
    if (radius <= sine) {  // a pole is within
      (axis.y > 0 ? height.most : height.least) = axis.y > 0 ? 2 : -2;
      list.push_back({height, {-1, 5}, owner});
      return;
    }
    const double s = sine / radius, c = std::sqrt(std::max(0.0, 1 - s * s));
    const double least = around(c * axis.x + s * axis.z, c * axis.z - s * axis.x) - rounding;
    double most = around(c * axis.x - s * axis.z, c * axis.z + s * axis.x) + rounding;
    if (most < least) most += 4;
    for (const double turn : {-4.0, 0.0, 4.0}) {
      const SweptRange turned{least + turn, most + turn};
      if (turned.least <= 4 && turned.most >= 0) list.push_back({height, turned, owner});
    }
  }
};

// Sums over the pairs that the sweep finds; every Gaussian itself is added without being looked for.
template <class WayTo>
CenterDepths summed(std::span<const GaussianDensity> gaussians, std::span<const SweptPoint> points,
                    std::span<const SweptBox> boxes, WayTo&& way_to_center) {
  CenterDepths d;
  d.others.assign(gaussians.size(), 0);
  std::vector<Way> ways;
  for (const GaussianDensity& g : gaussians) {
    ways.push_back(way_to_center(g));
    d.own.push_back(depth_on(ways.back(), g));
  }
  Sweep(points, boxes).each([&](std::uint32_t i, std::uint32_t owner) {
    ++d.visited;
    if (owner != i) d.others[i] += depth_on(ways[i], gaussians[owner]);
  });
  return d;
}

}  // namespace

CenterDepths depths_to_centers(std::span<const GaussianDensity> gaussians) {
  std::vector<SweptPoint> points;
  Boxes boxes;
  for (const GaussianDensity& g : gaussians) {
    const Way way = way_to(g.center);
    points.push_back({way.direction.y, around(way.direction.x, way.direction.z)});
    boxes.add(g, static_cast<std::uint32_t>(points.size() - 1));
  }
  return summed(gaussians, points, boxes.list, [](const GaussianDensity& g) { return way_to(g.center); });
}

CenterDepths depths_to_centers(std::span<const GaussianDensity> gaussians, const glm::vec3& direction_of_travel) {
  const glm::dvec3 way = -glm::normalize(glm::dvec3(direction_of_travel));
  const glm::dvec3 u = glm::normalize(glm::cross(way, std::fabs(way.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 v = glm::cross(way, u);
  std::vector<SweptPoint> points;
  std::vector<SweptBox> boxes;
  for (const GaussianDensity& g : gaussians) {
    const glm::dvec3 center(g.center);
    const SweptPoint p{glm::dot(u, center), glm::dot(v, center)};
    const double half = static_cast<double>(g.reach) * (1 + wider) + rounding * glm::length(center);
    boxes.push_back(
        {{p.along - half, p.along + half}, {p.across - half, p.across + half}, static_cast<std::uint32_t>(points.size())});
    points.push_back(p);
  }
  return summed(gaussians, points, boxes, [&](const GaussianDensity& g) { return Way{g.center, way, infinite}; });
}

double depth_to(std::span<const GaussianDensity> gaussians, const glm::dvec3& place) {
  const Way way = way_to(place);
  double sum = 0;
  for (const GaussianDensity& g : gaussians) sum += depth_on(way, g);
  return sum;
}

double depth_toward(std::span<const GaussianDensity> gaussians, const glm::dvec3& way) {
  double sum = 0;
  for (const GaussianDensity& g : gaussians) sum += depth_on({glm::dvec3(0), way, infinite}, g);
  return sum;
}

}  // namespace airlight
