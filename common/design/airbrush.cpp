#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/design/random_vectors.h"
#include "common/design/tools.h"
#include "common/error.h"

namespace airlight {

namespace {

constexpr double longest_step = 1.0 / 30;  // [s]
constexpr double most_steps = 2e7;         // of all particles together: a minute or so

// A place on a line, `share` of its length from its begin.
glm::dvec3 on_line(const std::vector<glm::dvec3>& line, double share) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += glm::distance(line[i], line[i + 1]);
  double left = share * length;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double segment = glm::distance(line[i], line[i + 1]);
    if (left < segment) return line[i] + (left / segment) * (line[i + 1] - line[i]);
    left -= segment;
  }
  return line.back();
}

}  // namespace

std::vector<Gaussian> airbrushed(const AirbrushEdit& e, const Collisions& surfaces, const Medium& medium) {
  if (e.points.empty()) throw InputError("\"points\": expected one point at least");
  check_count(e.rate * e.seconds, "the airbrush");
  if (const double steps = e.rate * e.seconds * (1 + e.seconds / longest_step / 2); steps > most_steps) {
    throw InputError(
        fmt::format("the airbrush would take {:.3g} steps of its particles, expected at most {:.3g}", steps, most_steps));
  }
  std::vector<Gaussian> made;
  for (double number = 0; number < e.rate * e.seconds; ++number) {
    Random random = random_of(Stream::airbrush, e.seed, static_cast<std::uint64_t>(number));
    const double birth = number / e.rate, age = e.seconds - birth;
    glm::dvec3 position = on_line(e.points, birth / e.seconds), velocity = e.velocity + e.spread * in_ball(random);
    const double steps = std::ceil(age / longest_step), step = age / steps;
    const double walk = std::sqrt(6 * e.diffusion * step);  // uniform in -1..1 has a variance of 1/3
    for (double k = 0; k < steps; ++k) {
      velocity = (velocity + step * e.acceleration) / (1 + e.drag * step);
      surfaces.move(position, step * velocity + walk * in_cube(random), velocity, e.bounce);
    }
    made.push_back(gaussian_of(e.puff, position, medium));
  }
  return made;
}

}  // namespace airlight
