#include "common/reference/line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace airlight {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double black = 746;  // exp(-746) is 0 in double

}  // namespace

RelativeMedium::RelativeMedium(const Medium& medium, const glm::dvec3& camera) : Medium(medium) {
  for (Gaussian& g : gaussians) g.center -= camera;
  if (!grid) return;
  grid->transform = glm::translate(glm::dmat4(1), -camera) * grid->transform;
  field.emplace(*grid);
}

double depth_to_light(const RelativeMedium& medium, const glm::dvec3& point, const RelativeLight& light, double length) {
  double sum = 0;
  if (light.directional) {
    sum = optical_depth(medium.gaussians, point, -light.vector, infinity);
    if (medium.field) sum += medium.field->depth(point, -light.vector, infinity);
    return sum;
  }
  sum = medium.extinction * length + optical_depth(medium.gaussians, point, light.vector);
  if (medium.field) {
    const glm::dvec3 way = light.vector - point;
    const double far = glm::length(way);
    if (far > 0) sum += medium.field->depth(point, way / far, far);
  }
  return sum;
}

LineInMedium::LineInMedium(const RelativeMedium& medium, const glm::dvec3& origin, const glm::dvec3& direction, double length)
    : medium_(medium), origin_(origin), direction_(direction), length_(length) {
  double most = 0, end = 0;
  for (const Gaussian& g : medium.gaussians) {
    const OnLine on_line{GaussianOnLine(g, origin, direction), &g};
    const double depth = on_line.line.depth(0, length);
    if (!(depth > 0)) continue;
    on_line_.push_back(on_line);
    most = std::max(most, depth);
    end = std::max(end, on_line.line.foot + 27.5 * g.radius);  // exp(-27.5^2) is 0 in double
  }
  // A Gaussian this much thinner than another is below rounding, even one next to the light (1/r^2 up to 1e12 in metres).
  std::erase_if(on_line_, [&](const OnLine& o) { return o.line.depth(0, length) < 1e-30 * most; });
  if (medium.field) grid_.emplace(*medium.field, origin, direction, length);
  if (grid_ && grid_->empty()) grid_.reset();
  if (grid_) end = std::max(end, grid_->end());
  reach_ = std::min(length, medium.extinction > 0 ? black / medium.extinction : end);
}

double LineInMedium::depth(double t) const {
  double sum = medium_.extinction > 0 ? medium_.extinction * t : 0;
  for (const OnLine& o : on_line_) sum += o.line.depth(0, t);
  if (grid_) sum += grid_->depth(t);
  return sum;
}

glm::dvec3 LineInMedium::scattering(double t) const {
  glm::dvec3 sum = medium_.extinction * medium_.albedo;
  for (const OnLine& o : on_line_) sum += o.line.density(t) * o.gaussian->albedo;
  if (grid_) sum += grid_->extinction(t) * grid_->albedo();
  return sum;
}

glm::dvec3 LineInMedium::glow(double t) const {
  glm::dvec3 sum(0);
  for (const OnLine& o : on_line_) sum += o.line.density(t) / o.line.c * o.gaussian->emission;
  return sum;
}

double LineInMedium::extinction(double t) const {
  double sum = medium_.extinction;
  for (const OnLine& o : on_line_) sum += o.line.density(t);
  if (grid_) sum += grid_->extinction(t);
  return sum;
}

// Newton's iteration between bounds that are halved where it would leave them, or where it is slower than that.
double LineInMedium::place(double depth) const {
  if (on_line_.empty() && !grid_) return medium_.extinction > 0 ? std::min(depth / medium_.extinction, reach_) : reach_;
  double low = 0, high = reach_;
  // From the middle of a lone Gaussian the iteration goes to its end from one side.
  double t = on_line_.empty() ? grid_->begin() : on_line_.front().line.foot;
  if (!(t > low && t < high)) t = 0.5 * high;
  double last = high;
  for (int i = 0; i < 200; ++i) {
    const double missing = depth - this->depth(t);
    (missing > 0 ? low : high) = t;
    double next = t + missing / extinction(t);
    if (!(next > low && next < high) || std::fabs(next - t) > 0.5 * last) next = low + 0.5 * (high - low);
    last = std::fabs(next - t);
    if (!(last > 1e-14 * high)) return next;
    t = next;
  }
  return t;
}

}  // namespace airlight
