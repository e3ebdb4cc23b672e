#include "common/design/screen.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/error.h"

namespace airlight {

namespace {

constexpr double farthest_on_plane = 1e6;  // [m]

// tan(x), 0 < x < pi / 2, to a few units in the last place: the series of sine and cosine of x / 8, doubled three times.
double tangent(double x) {
  const double u = x / 8, v = -u * u;
  double sine = 0, cosine = 0;
  for (int k = 8; k > 0; --k) {  // u < 0.2: the next term is below 1e-20
    sine = (sine + 1) * v / ((2 * k) * (2 * k + 1));
    cosine = (cosine + 1) * v / ((2 * k - 1) * (2 * k));
  }
  sine = u * (sine + 1), cosine = cosine + 1;
  for (int k = 0; k < 3; ++k) {
    const double s = 2 * sine * cosine;
    cosine = (cosine - sine) * (cosine + sine), sine = s;
  }
  return sine / cosine;
}

}  // namespace

Screen::Screen(const Camera& c)
    : position_(c.position),
      forward_(glm::normalize(c.look_at - c.position)),
      right_(glm::normalize(glm::cross(forward_, c.up))),
      up_(glm::cross(right_, forward_)),
      half_height_(tangent(c.vertical_fov * (std::numbers::pi / 360))) {}

glm::dvec3 Screen::ray(const glm::dvec2& at) const {
  return glm::normalize((at.x * right_ + at.y * up_) * half_height_ + forward_);
}

std::optional<Screen::Seen> Screen::seen(const glm::dvec3& point) const {
  const glm::dvec3 p = point - position_;
  const double depth = glm::dot(p, forward_);
  if (!(depth > 0)) return {};
  const double scale = 1 / (depth * half_height_);
  return Seen{{glm::dot(p, right_) * scale, glm::dot(p, up_) * scale}, depth};
}

std::optional<glm::dvec3> Screen::on_plane(const glm::dvec2& at, const DesignPlane& plane) const {
  const glm::dvec3 direction = ray(at);
  const double t = glm::dot(plane.point - position_, plane.normal) / glm::dot(direction, plane.normal);
  if (!(t > 0) || !(t <= farthest_on_plane)) return {};
  return position_ + t * direction;
}

std::vector<glm::dvec3> world_points(const Stroke& stroke, const Screen& screen) {
  if (stroke.screen.empty() == stroke.points.empty()) {
    throw InputError("expected the stroke's points either in \"screen\" or in \"points\"");
  }
  if (!stroke.points.empty()) {
    if (stroke.plane) throw InputError("\"plane\" beside \"points\", expected it beside \"screen\" only");
    return stroke.points;
  }
  if (!stroke.plane) throw InputError("missing key, expected \"plane\" beside \"screen\"");
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < stroke.screen.size(); ++i) {
    const auto point = screen.on_plane(stroke.screen[i], *stroke.plane);
    if (!point)
      throw InputError(fmt::format("screen[{}]: its view ray does not meet the plane within {} m", i, farthest_on_plane));
    points.push_back(*point);
  }
  return points;
}

}  // namespace airlight
