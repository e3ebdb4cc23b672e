// What is told of a tabulated reflectance where the table itself is not asked.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/scene/brdf.h"
#include "common/scene/brdf_directions.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;

// Least squares of a share of the albedo that goes to Phong's lobe, by exponent and channel.
constexpr int exponents = 21;
constexpr double least_share = 1e-3;  // less is nothing: quadrature leaves some of a matt surface

struct Fit {
  double product = 0, square = 0;  // of the lobes' difference with what Lambert's alone leaves, and with itself
};

}  // namespace

glm::dvec3 brdf_albedo(const Brdf& brdf) {
  const Brdf even = both_sides(brdf);
  glm::dvec3 sum(0);
  each_view([&](double level, double weight) {
    each_direction(even, level, [&](const glm::dvec3&, double angle, const glm::dvec3& sent) { sum += weight * angle * sent; });
  });
  return sum;
}

Material brdf_material(const Brdf& brdf) {
  const Brdf even = both_sides(brdf);
  const glm::dvec3 albedo = glm::min(brdf_albedo(brdf), 1.0);
  std::array<std::array<Fit, 3>, exponents> fits{};
  each_view([&](double level, double view_weight) {
    const glm::dvec3 mirror(-std::sqrt((1 - level) * (1 + level)), 0, level);
    each_direction(even, level, [&](const glm::dvec3& light, double angle, const glm::dvec3& sent) {
      const double lambert = light.z / pi, weight = view_weight * angle, cosine = std::max(glm::dot(mirror, light), 0.0);
      std::array power{cosine, std::pow(cosine, std::numbers::sqrt2)};  // each squared for the exponent after next
      for (std::size_t k = 0; k < exponents; ++k) {
        const double n = std::exp2(static_cast<double>(k) / 2);
        const double difference = (n + 1) / (2 * pi) * power[k % 2] - lambert;
        power[k % 2] *= power[k % 2];
        for (int c = 0; c < 3; ++c) {
          Fit& fit = fits[k][static_cast<std::size_t>(c)];
          fit.product += weight * difference * (sent[c] - albedo[c] * lambert);
          fit.square += weight * difference * difference;
        }
      }
    });
  });
  Material best{.diffuse = albedo};
  double most = 0;  // of the squares that Lambert's lobe alone leaves, how many less
  for (std::size_t k = 0; k < exponents; ++k) {
    glm::dvec3 specular(0);
    double gained = 0;
    for (int c = 0; c < 3; ++c) {
      const Fit& fit = fits[k][static_cast<std::size_t>(c)];
      specular[c] = std::clamp(fit.product / fit.square, 0.0, albedo[c]);
      if (specular[c] < least_share * albedo[c]) specular[c] = 0;
      gained += specular[c] * (2 * fit.product - specular[c] * fit.square);
    }
    if (!(gained > most) || specular == glm::dvec3(0)) continue;
    most = gained;
    best = {.diffuse = albedo - specular,
            .specular = specular,
            .shininess = static_cast<float>(std::exp2(static_cast<double>(k) / 2))};
  }
  return best;
}

}  // namespace airlight
