#include "tests/parity/brdfs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airlight {

namespace {
constexpr double pi = std::numbers::pi;
constexpr glm::dvec3 gold{1.0, 0.71, 0.29};
}  // namespace

glm::dvec3 microfacets(double roughness, double half, double difference, double light, double viewer) {
  const double a = roughness * roughness, spread = half * half * (a - 1) + 1;
  const double shadowing =
      0.5 / (light * std::sqrt(a + (1 - a) * viewer * viewer) + viewer * std::sqrt(a + (1 - a) * light * light));
  return a / (pi * spread * spread) * shadowing * (gold + (1.0 - gold) * std::pow(1 - difference, 5));
}

std::shared_ptr<const Brdf> microfacet_table(const glm::ivec3& size, double roughness, double squeeze) {
  auto brdf = std::make_shared<Brdf>();
  brdf->size = size;
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < size.x; ++i) {
      const double q = (i + 0.5) / size.x, theta = q * q * pi / 2;
      for (int j = 0; j < size.y; ++j) {
        const double difference = (j + 0.5) / size.y * pi / 2;
        for (int k = 0; k < size.z; ++k) {
          const double phi = (k + 0.5) / size.z * pi;
          const double level = std::cos(theta) * std::cos(difference),
                       apart = std::sin(theta) * std::sin(difference) * std::cos(phi);
          const glm::dvec3 value = microfacets(roughness, std::cos(theta), std::cos(difference), std::max(level - apart, 0.01),
                                               std::max(level + apart, 0.01));
          brdf->values.push_back(static_cast<float>(value[c] * (1 + squeeze * std::sin(theta) * std::sin(2 * phi + 1 + c))));
        }
      }
    }
  }
  return brdf;
}

std::shared_ptr<const Brdf> constant_table(const glm::vec3& reflectance) {
  auto brdf = std::make_shared<Brdf>();
  for (int c = 0; c < 3; ++c) brdf->values.insert(brdf->values.end(), 8, reflectance[c]);
  return brdf;
}

}  // namespace airlight
