#include <algorithm>
#include <cmath>

#include "common/design/random_vectors.h"
#include "common/design/tools.h"

namespace airlight {

std::vector<Gaussian> emitted(const EmitEdit& e, double later, const Medium& medium) {
  const double now = e.time + later;
  check_count(e.rate * std::min(e.lifetime, now), "the emitter");
  const double oldest = std::max(0.0, std::ceil((now - e.lifetime) * e.rate));
  std::vector<Gaussian> made;
  for (double number = oldest; number <= now * e.rate; ++number) {
    const double age = now - number / e.rate, left = 1 - age / e.lifetime;
    if (!(left > 0)) continue;
    Random random = random_of(Stream::emitter, e.seed, static_cast<std::uint64_t>(number));
    const glm::dvec3 velocity = e.velocity + e.spread * in_ball(random);
    Puff puff = e.puff;
    puff.radius = std::max(puff.radius * left, 1e-6), puff.extinction *= left;
    made.push_back(gaussian_of(puff, e.position + age * velocity + (0.5 * age * age) * e.acceleration, medium));
  }
  return made;
}

}  // namespace airlight
