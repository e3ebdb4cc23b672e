#include "common/reference/phase_sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/formulas/double.h"

namespace airlight {

namespace {

// Henyey and Greenstein 1941: the inverse of its integral over mu, in a form that is 2 u - 1 at g = 0:
// mu = (1 + g^2 - ((1 - g^2) / (1 + g s))^2) / (2 g) with s = 2 u - 1.
double henyey_greenstein(double g, double u) {
  const double s = 2 * u - 1, d = 1 + g * s;
  return std::clamp((s + g * (1.5 + 0.5 * s * s) + g * g * s + 0.5 * g * g * g * (s * s - 1)) / (d * d), -1.0, 1.0);
}

// Half of the light evenly; of the other, ((1 + mu) / 2)^n has this inverse (Nishita et al. 1987).
double mie(double n, Random& random) {
  const double u = random.next();
  return random.next() < 0.5 ? 2 * u - 1 : 2 * std::pow(u, 1 / (n + 1)) - 1;
}

// 3/8 (1 + mu^2): three quarters evenly, a quarter with density 3/2 mu^2.
double rayleigh(Random& random) {
  const double s = 2 * random.next() - 1;
  return random.next() < 0.75 ? s : std::cbrt(s);
}

double cosine_of(const Phase& phase, Random& random) {
  switch (phase.kind) {
    case PhaseKind::isotropic:
      return 2 * random.next() - 1;
    case PhaseKind::rayleigh:
      return rayleigh(random);
    case PhaseKind::henyey_greenstein:
    case PhaseKind::cornette_shanks:
      return henyey_greenstein(phase.g, random.next());
    case PhaseKind::mie_hazy:
      return mie(8, random);
    case PhaseKind::mie_murky:
      return mie(32, random);
  }
  return 0;
}

}  // namespace

ScatteredDirection scattered_direction(const Phase& phase, const glm::dvec3& direction, Random& random) {
  const double mu = cosine_of(phase, random), sine = std::sqrt((1 - mu) * (1 + mu));
  const double angle = 2 * std::numbers::pi * random.next();
  const glm::dvec3 beside = std::fabs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 a = glm::normalize(glm::cross(beside, direction)), b = glm::cross(direction, a);
  ScatteredDirection to;
  to.direction = glm::normalize(mu * direction + sine * (std::cos(angle) * a + std::sin(angle) * b));
  if (phase.kind == PhaseKind::cornette_shanks)
    to.weight = f64::phase_cornette_shanks(phase.g, mu) / f64::phase_henyey_greenstein(phase.g, mu);
  return to;
}

}  // namespace airlight
