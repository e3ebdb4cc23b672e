#include "common/reference/airlight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "common/formulas/double.h"
#include "common/reference/shadow_plane.h"

namespace airlight {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Begin and end of each piece of 0..reach outside the shadows, cut at the breaks, as integrate() takes them.
std::vector<double> pieces_of(const std::vector<Interval>& shadows, std::vector<double> breaks, double reach) {
  std::sort(breaks.begin(), breaks.end());
  std::vector<double> pieces;
  const auto add_lit = [&](double begin, double end) {
    double at = begin;
    for (const double cut : breaks) {
      // Cuts closer than rounding matters would only make empty pieces.
      if (cut <= at * (1 + 1e-13) || cut <= at + 1e-300) continue;
      if (cut >= end * (1 - 1e-13)) break;
      pieces.insert(pieces.end(), {at, cut});
      at = cut;
    }
    if (at < end) pieces.insert(pieces.end(), {at, end});
  };
  double lit_from = 0;
  for (const Interval& s : shadows) {
    if (lit_from < std::min(s.first, reach)) add_lit(lit_from, std::min(s.first, reach));
    lit_from = std::max(lit_from, s.second);
  }
  if (lit_from < reach) add_lit(lit_from, reach);
  return pieces;
}

}  // namespace

// Where what the ray passes changes: along the fade of the homogeneous part, across each Gaussian, at the grid's cells.
std::vector<double> RayInMedium::breaks() const {
  std::vector<double> t;
  for (const double depth : {0.3, 1.0, 3.0, 10.0, 40.0, 150.0}) {
    if (medium_.extinction > 0) t.push_back(depth / medium_.extinction);
  }
  for (const OnLine& o : on_line_) {
    for (const double radii : {-8.0, -3.0, -1.0, 0.0, 1.0, 3.0, 8.0}) t.push_back(o.line.foot + radii / o.line.a);
  }
  if (grid_) grid_->add_breaks(t);
  return t;
}

// Where the way to the light changes: at its foot, along the fade from there, and where the ray passes behind a Gaussian or the
// grid.
void RayInMedium::add_light_breaks(const RelativeLight& light, double foot, std::vector<double>& t) const {
  if (!light.directional) {
    t.push_back(foot);
    for (const double depth : {1.0, 10.0}) {
      if (medium_.extinction > 0) t.insert(t.end(), {foot - depth / medium_.extinction, foot + depth / medium_.extinction});
    }
  }
  const glm::dvec3 to_light = light.way_from(origin_);
  const double along = glm::dot(direction_, to_light);
  const glm::dvec3 across = to_light - along * direction_;
  const double height = glm::length(across);
  if (!(height > 1e-12 * glm::length(to_light))) return;
  for (const Gaussian& g : medium_.gaussians) {
    const double y = glm::dot(g.center - origin_, across) / height;
    if (y <= 0 || (!light.directional && y >= height)) continue;
    for (const double radii : {-4.0, -1.5, 0.0, 1.5, 4.0}) {
      const double x = glm::dot(g.center - origin_, direction_) + radii * g.radius;
      t.push_back(light.directional ? x - y * along / height : along + (x - along) * (height / (height - y)));
    }
  }
  // Of many Gaussians the breaks lie closer than anything changes.
  if (medium_.gaussians.size() > 32 && !on_line_.empty()) {
    double thinnest = infinity;
    for (const OnLine& o : on_line_) thinnest = std::min(thinnest, 1 / o.line.a);
    std::sort(t.begin(), t.end());
    double last = -infinity;
    std::erase_if(t, [&](double at) {
      if (at < last + 0.7 * thinnest) return true;
      last = at;
      return false;
    });
  }
  if (medium_.field && (medium_.extinction > 0 || !on_line_.empty())) add_grid_breaks(light, t);
}

// The part of the ray that the grid's box darkens is cut so that a piece of it looks toward the light through about four cells:
// evenly in the angle at a point light, evenly along the ray for a directional one. A grid that scatters alone has its own
// breaks.
void RayInMedium::add_grid_breaks(const RelativeLight& light, std::vector<double>& t) const {
  const ShadowPlane plane(origin_, direction_, length_, light);
  if (plane.degenerate()) return;
  static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  const std::vector<glm::dvec3>& corner = medium_.field->corners();
  Interval all{infinity, -infinity};
  for (const auto& [a, b, c, d] : faces) {
    for (const Interval& s : {plane.shadow(corner[a], corner[b], corner[c]), plane.shadow(corner[a], corner[c], corner[d])}) {
      all = {std::min(all.first, s.first), std::max(all.second, s.second)};
    }
  }
  all = {std::max(all.first, 0.0), std::min(all.second, reach_)};
  if (!(all.first < all.second)) return;
  const glm::ivec3 pieces = medium_.field->pieces();
  const int count = (pieces.x + pieces.y + pieces.z) / 4 + 1;
  const double foot = plane.foot(), height = glm::length(light.vector - origin_ - foot * direction_);
  const double from = light.directional ? all.first : std::atan2(all.first - foot, height);
  const double to = light.directional ? all.second : std::atan2(all.second - foot, height);
  for (int i = 0; i <= count; ++i) {
    const double at = from + (to - from) * i / count;
    t.push_back(light.directional ? at : foot + height * std::tan(at));
  }
}

Integral RayInMedium::scattered(const RelativeLight& light, const std::vector<Interval>& shadow, double tolerance) const {
  if (light.power == glm::dvec3(0) || !(reach_ > 0)) return {};
  const int kind = static_cast<int>(medium_.phase.kind);
  const auto g = medium_.phase.g;
  Integral sum;
  if (light.directional) {
    std::vector<double> t = breaks();
    add_light_breaks(light, 0, t);
    const double phase = f64::phase_value(kind, g, -glm::dot(light.vector, direction_));
    sum = integrate(
        [&](double x) {
          const glm::dvec3 scattered = scattering(x);
          if (scattered == glm::dvec3(0)) return scattered;  // the way to the light is long to compute
          const double tau = depth(x) + depth_to_light(medium_, at(x), light, 0);
          return phase * std::exp(-tau) * scattered;
        },
        pieces_of(shadow, t, reach_), tolerance);
  } else {
    // t = foot + h sinh(s) takes the peak of 1/r^2 away: r = h cosh(s), dt/r^2 = ds / r; and no digits are lost far from it.
    const glm::dvec3 way = light.vector - origin_;
    const double foot = glm::dot(direction_, way);
    const double h = std::max(glm::length(way - foot * direction_), light.radius);
    std::vector<double> t = breaks();
    add_light_breaks(light, foot, t);
    std::vector<double> pieces = pieces_of(shadow, t, reach_);
    for (double& end : pieces) end = std::asinh((end - foot) / h);
    sum = integrate(
        [&](double s) {
          const double x = foot + h * std::sinh(s), r = h * std::cosh(s);
          const glm::dvec3 scattered = scattering(x);
          if (scattered == glm::dvec3(0)) return scattered;
          const double tau = depth(std::max(x, 0.0)) + depth_to_light(medium_, at(x), light, r);
          return f64::phase_value(kind, g, -std::tanh(s)) * std::exp(-tau) / r * scattered;
        },
        pieces, tolerance);
  }
  return {sum.value * light.power, sum.error * light.power};
}

Integral RayInMedium::emitted(double tolerance) const {
  bool any = medium_.emission != glm::dvec3(0);
  for (const OnLine& o : on_line_) any = any || o.gaussian->emission != glm::dvec3(0);
  if (!any) return {};
  Integral sum = integrate(
      [&](double t) {
        glm::dvec3 source = medium_.emission;
        for (const OnLine& o : on_line_) source += o.line.density(t) / o.line.c * o.gaussian->emission;
        return std::exp(-depth(t)) * source;
      },
      pieces_of({}, breaks(), reach_), tolerance);
  // Without extinction of its own the homogeneous part goes on glowing behind the last Gaussian or the grid; infinity is 1e30 as
  // elsewhere.
  if (!(medium_.extinction > 0)) sum.value += (std::min(length_, 1e30) - reach_) * std::exp(-depth()) * medium_.emission;
  return sum;
}

}  // namespace airlight
