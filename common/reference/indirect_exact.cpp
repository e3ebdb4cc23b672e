#include "common/reference/indirect_exact.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "common/scene/brdf.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

// Shares of the tolerance: of the integral along each ray, over gamma (twice: beside its own value and beside the mean), over the
// azimuth.
constexpr double ray_share = 0.05, gamma_share = 0.2, azimuth_share = 0.5;

// Cuts of low..high, as integrate() takes them.
class Cuts {
 public:
  Cuts(double low, double high) : low_(low), high_(high) {}
  void add(double at) {
    if (at > low_ && at < high_) inner_.push_back(at);
  }
  // An angle and all that differ from it by whole turns.
  void add_angle(double at) {
    for (const double turn : {-2 * pi, 0.0, 2 * pi}) add(at + turn);
  }
  std::vector<double> pieces() {
    std::sort(inner_.begin(), inner_.end());
    std::vector<double> all{low_};
    for (const double at : inner_) {
      if (at > all.back()) all.insert(all.end(), {at, at});
    }
    all.push_back(high_);
    return all;
  }

 private:
  double low_, high_;
  std::vector<double> inner_;
};

// The rays that arrive at a point.
class Rays {
 public:
  Rays(const RelativeMedium& medium, const Visibility& visibility, const RelativeLight& light, const SurfacePoint& at,
       bool shadows, double tolerance)
      : medium_(medium), visibility_(visibility), light_(light), at_(at), shadows_(shadows), tolerance_(tolerance) {
    // As far as triangles that touch this one may seem to be by rounding.
    from_ = 1e-9 * glm::length(at.point);
    viewer_ = 2 * glm::dot(at.normal, at.mirror) * at.normal - at.mirror;
  }

  struct First {
    std::uint32_t triangle;
    double distance;
  };
  First first(const glm::dvec3& direction) const {
    const auto hit = visibility_.nearest(at_.point, direction, from_, at_.triangle);
    return hit ? First{hit->triangle, hit->distance} : First{Visibility::no_triangle, infinity};
  }

  // What is sent on to the camera of what arrives against `direction` [W/m^2/sr per sr].
  glm::dvec3 sent(const glm::dvec3& direction) const {
    const glm::dvec3 reflection = reflected(direction);
    if (reflection == glm::dvec3(0)) return reflection;
    const RayInMedium ray(medium_, at_.point, direction, first(direction).distance);
    const auto shadow = shadows_ ? visibility_.shadows(at_.point, direction, ray.reach(), light_) : std::vector<Interval>();
    return reflection * ray.scattered(light_, shadow, tolerance_).value;
  }

 private:
  glm::dvec3 reflected(const glm::dvec3& direction) const {
    if (at_.surface->brdf) return tabulated_reflection(*at_.surface->brdf, at_.normal, direction, viewer_);
    const Material& m = at_.surface->material;
    glm::dvec3 sum = std::max(0.0, glm::dot(at_.normal, direction)) / pi * glm::dvec3(m.diffuse);
    const double cosine = glm::dot(at_.mirror, direction);
    if (m.specular != glm::vec3(0) && cosine > 0) {
      const auto n = static_cast<double>(m.shininess);
      sum += (n + 1) / (2 * pi) * std::pow(cosine, n) * glm::dvec3(m.specular);
    }
    return sum;
  }

  const RelativeMedium& medium_;
  const Visibility& visibility_;
  const RelativeLight& light_;
  const SurfacePoint& at_;
  bool shadows_;
  double tolerance_, from_;
  glm::dvec3 viewer_;
};

// Half of a plane through the point and the light: directions cos(gamma) toward + sin(gamma) across.
struct HalfPlane {
  glm::dvec3 toward, across;

  glm::dvec3 direction(double gamma) const { return std::cos(gamma) * toward + std::sin(gamma) * across; }
  // Where a vector's projection points.
  double angle(const glm::dvec3& v) const { return std::atan2(glm::dot(v, across), glm::dot(v, toward)); }
};

// Angles at which the first surface jumps, halved out to 1e-12. What is thinner than the steps and a jump of less than a
// thousandth are left to the adaptive quadrature.
void add_jumps(const Rays& rays, const HalfPlane& plane, double low, double high, Cuts& cuts) {
  constexpr int steps = 160;
  const auto search = [&](auto&& self, double a, const Rays::First& at_a, double b, const Rays::First& at_b) -> void {
    if (at_a.triangle == at_b.triangle) return;
    const double near = std::min(at_a.distance, at_b.distance), far = std::max(at_a.distance, at_b.distance);
    if (far <= near * 1.001) return;
    const double middle = 0.5 * (a + b);
    if (b - a < 1e-12) return cuts.add(middle);
    const Rays::First at_middle = rays.first(plane.direction(middle));
    self(self, a, at_a, middle, at_middle);
    self(self, middle, at_middle, b, at_b);
  };
  double a = low;
  Rays::First at_a = rays.first(plane.direction(a));
  for (int i = 1; i <= steps; ++i) {
    const double b = low + (high - low) * i / steps;
    const Rays::First at_b = rays.first(plane.direction(b));
    search(search, a, at_a, b, at_b);
    a = b, at_a = at_b;
  }
}

// Where in 0..pi a half-plane is in front of the surface.
std::pair<double, double> in_front(double face_angle) {
  if (face_angle >= 0) return {std::max(0.0, face_angle - pi / 2), std::min(pi, face_angle + pi / 2)};
  if (face_angle > -pi / 2) return {0, face_angle + pi / 2};
  return {face_angle + 3 * pi / 2, pi};
}

}  // namespace

Integral exact_indirect(const RelativeMedium& medium, const Visibility& visibility, const RelativeLight& light,
                        const SurfacePoint& at, bool shadows, double tolerance) {
  const Material& material = at.surface->material;
  const bool tabulated = at.surface->brdf != nullptr, specular = tabulated || material.specular != glm::vec3(0);
  const glm::dvec3 way = light.way_from(at.point);
  const double length = glm::length(way);
  if (light.power == glm::dvec3(0) || medium.empty() || !(length > 0)) return {};
  if (!specular && material.diffuse == glm::vec3(0)) return {};
  const glm::dvec3 toward = way / length;
  const Rays rays(medium, visibility, light, at, shadows, ray_share * tolerance);

  // Azimuths count from the normal's.
  glm::dvec3 e1 = at.face - glm::dot(at.face, toward) * toward;
  if (!(glm::length(e1) > 1e-6)) e1 = glm::cross(toward, std::fabs(toward.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  e1 = glm::normalize(e1);
  const glm::dvec3 e2 = glm::cross(toward, e1);

  // A lobe is as good as gone 6 deviations of a Gaussian away from its middle; that of a table may be a tenth of a radian wide.
  const double deviation = tabulated ? 0.1 : specular ? 1 / std::sqrt(std::max(1.0, static_cast<double>(material.shininess))) : 0;
  const double held = light.directional ? 0 : std::asin(std::min(1.0, light.radius / length));

  glm::dvec3 sum_of_inner(0), excess(0);
  double count = 0;
  const auto over_gamma = [&](double azimuth) {
    const HalfPlane plane{toward, std::cos(azimuth) * e1 + std::sin(azimuth) * e2};
    const auto [low, high] = in_front(plane.angle(at.face));
    if (!(low < high)) return glm::dvec3(0);
    Cuts cuts(low, high);
    for (const double near : {held, 0.05, pi - 0.05}) cuts.add(near);
    if (at.normal != at.face) {
      for (const double side : {-pi / 2, pi / 2}) cuts.add_angle(plane.angle(at.normal) + side);
    }
    if (specular) {
      const double top = plane.angle(at.mirror);
      for (const double deviations : {-6.0, -2.0, 0.0, 2.0, 6.0}) {
        if (std::fabs(deviations * deviation) < pi / 2) cuts.add_angle(top + deviations * deviation);
      }
      for (const double side : {-pi / 2, pi / 2}) cuts.add_angle(top + side);
    }
    add_jumps(rays, plane, low, high, cuts);
    const glm::dvec3 mean = count > 0 ? sum_of_inner / count : glm::dvec3(0);
    const glm::dvec3 enough = gamma_share * tolerance * mean;
    const Integral part = integrate([&](double gamma) { return std::sin(gamma) * rays.sent(plane.direction(gamma)); },
                                    cuts.pieces(), gamma_share * tolerance, enough, 500);
    excess = glm::max(excess, part.error - glm::max(enough, gamma_share * tolerance * part.value));
    sum_of_inner += part.value;
    ++count;
    return part.value;
  };

  Cuts cuts(0, 2 * pi);
  for (const double quarter : {pi / 2, pi, 3 * pi / 2}) cuts.add(quarter);
  if (specular) {
    const glm::dvec3 across = at.mirror - glm::dot(at.mirror, toward) * toward;
    const double sine = glm::length(across), top = std::atan2(glm::dot(across, e2), glm::dot(across, e1));
    for (const double deviations : {-4.0, -1.5, 0.0, 1.5, 4.0}) {
      const double apart = deviations * deviation / std::max(sine, 1e-3);
      if (std::fabs(apart) < pi) cuts.add_angle(top + apart);
    }
  }
  Integral whole = integrate(over_gamma, cuts.pieces(), azimuth_share * tolerance, glm::dvec3(0), 100);
  whole.error += (ray_share + 2 * gamma_share) * tolerance * whole.value + 2 * pi * excess;
  return whole;
}

}  // namespace airlight
