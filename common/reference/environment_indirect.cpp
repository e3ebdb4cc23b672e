#include "common/reference/environment_indirect.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "common/formulas/double.h"
#include "common/scene/brdf.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int fine_rings = 8;  // of directions, with twice as many each

// A ray that arrives at a surface.
class ArrivingRay : public LineInMedium {
 public:
  using LineInMedium::LineInMedium;

  // What it brings of the light of these patches [W/m^2/sr].
  glm::dvec3 brought(const std::vector<EnvironmentLighting::Patch>& sky) const {
    std::vector<RelativeLight> lights;
    std::vector<double> phase;
    LightSource source;
    source.type = LightType::directional;
    for (const EnvironmentLighting::Patch& p : sky) {
      source.direction = -p.direction;
      lights.emplace_back(source, glm::dvec3(0));
      phase.push_back(f64::phase_value(static_cast<int>(medium_.phase.kind), medium_.phase.g, glm::dot(p.direction, direction_)));
    }
    const std::vector<double> ends = breaks();
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double middle = (ends[i] + ends[i + 1]) / 2, half = (ends[i + 1] - ends[i]) / 2;
      for (const KronrodNode& node : kronrod_nodes) {
        if (!(node.gauss > 0)) continue;
        for (const double side : {-1.0, 1.0}) {
          if (node.x == 0 && side > 0) continue;
          const double t = middle + side * node.x * half;
          glm::dvec3 met(0);
          for (std::size_t k = 0; k < sky.size(); ++k)
            met += phase[k] * std::exp(-depth_to_light(medium_, at(t), lights[k], 0)) * sky[k].power;
          sum += half * node.gauss * std::exp(-depth(t)) * scattering(t) * met;
        }
      }
    }
    return sum;
  }

 private:
  // Pieces in which seven nodes leave less than a thousandth.
  std::vector<double> breaks() const {
    std::vector<double> t{0, reach_};
    for (const double depth : {0.3, 1.0, 3.0, 7.0, 15.0, 40.0}) {
      if (medium_.extinction > 0) t.push_back(depth / medium_.extinction);
    }
    for (const OnLine& o : on_line_) {
      for (const double radii : {-3.5, -1.2, 1.2, 3.5}) t.push_back(o.line.foot + radii / o.line.a);
    }
    if (grid_) grid_->add_breaks(t);
    std::erase_if(t, [this](double at) { return at < 0 || at > reach_; });
    std::sort(t.begin(), t.end());
    return t;
  }
};

// visit(direction) for directions of equal weight under the normalised lobe cos^exponent about an axis.
template <class Visit>
void about(const glm::dvec3& axis, double exponent, int rings, Visit&& visit) {
  const glm::dvec3 side = glm::normalize(glm::cross(axis, std::fabs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 other = glm::cross(axis, side);
  for (int k = 0; k < rings; ++k) {
    const double cosine = std::pow((k + 0.5) / rings, 1 / (exponent + 1)), sine = std::sqrt((1 - cosine) * (1 + cosine));
    for (int i = 0; i < 2 * rings; ++i) {
      const double angle = pi * (i + 0.5) / rings;
      visit(cosine * axis + sine * (std::cos(angle) * side + std::sin(angle) * other));
    }
  }
}

}  // namespace

Integral exact_environment_indirect(const RelativeMedium& medium, const Visibility& visibility,
                                    const EnvironmentLighting& environment, const SurfacePoint& at) {
  if (medium.empty()) return {};
  const double from = 1e-9 * glm::length(at.point);
  const auto sum_of = [&](int rings, const std::vector<EnvironmentLighting::Patch>& sky) {
    glm::dvec3 sum(0);
    // The mean over directions that are as frequent as a lobe is wide of what comes from them times reflectance(direction).
    const auto lobe = [&](const glm::dvec3& axis, double exponent, const auto& reflectance) {
      about(axis, exponent, rings, [&](const glm::dvec3& u) {
        if (!(glm::dot(u, at.face) > 0)) return;
        const auto hit = visibility.nearest(at.point, u, from, at.triangle);
        sum += reflectance(u) * ArrivingRay(medium, at.point, u, hit ? hit->distance : infinity).brought(sky);
      });
    };
    const Material& material = at.surface->material;
    if (at.surface->brdf) {
      const glm::dvec3 viewer = 2 * glm::dot(at.normal, at.mirror) * at.normal - at.mirror;
      lobe(at.normal, 1, [&](const glm::dvec3& u) {
        const double frequency = std::max(glm::dot(at.normal, u), 1e-12) / pi;
        return tabulated_reflection(*at.surface->brdf, at.normal, u, viewer) / frequency;
      });
    } else {
      if (material.diffuse != glm::vec3(0)) lobe(at.normal, 1, [&](const glm::dvec3&) { return glm::dvec3(material.diffuse); });
      if (material.specular != glm::vec3(0)) {
        lobe(at.mirror, static_cast<double>(material.shininess),
             [&](const glm::dvec3&) { return glm::dvec3(material.specular); });
      }
    }
    return sum / (2.0 * rings * rings);
  };
  const glm::dvec3 fine = sum_of(fine_rings, environment.sky()), coarse = sum_of(fine_rings / 2, environment.coarse_sky());
  return {fine, glm::abs(fine - coarse)};
}

}  // namespace airlight
