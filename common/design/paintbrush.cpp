#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/design/random_vectors.h"
#include "common/design/tools.h"

namespace airlight {

namespace {

// Two unit vectors perpendicular to a unit vector and to each other (Duff et al. 2017, Building an orthonormal basis, revisited).
void perpendiculars(const glm::dvec3& n, glm::dvec3& u, glm::dvec3& v) {
  const double sign = n.z < 0 ? -1.0 : 1.0, a = -1 / (sign + n.z), b = n.x * n.y * a;
  u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  v = {b, sign + n.y * n.y * a, -n.y};
}

}  // namespace

std::vector<Gaussian> painted(const PaintEdit& e, const Screen& screen, const Medium& medium) {
  const std::vector<glm::dvec3> line = world_points(e.stroke, screen);
  const double spacing = e.spacing.value_or(0.75 * e.puff.radius);  // 0.75 / a
  const double scatter = e.scatter.value_or(e.puff.radius);         // 1 / a

  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += glm::distance(line[i], line[i + 1]);
  check_count(length / spacing, "the stroke");

  std::vector<Gaussian> made;
  const auto place = [&](const glm::dvec3& at, const glm::dvec3& along) {
    Random random = random_of(Stream::paint, e.seed, made.size());
    glm::dvec3 u, v;
    perpendiculars(along, u, v);
    const glm::dvec2 offset = scatter * in_disk(random);
    made.push_back(gaussian_of(e.puff, at + offset.x * u + offset.y * v, medium));
  };
  double next = 0, passed = 0;  // [m] along the stroke: of the next Gaussian, of the segment's begin
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double segment = glm::distance(line[i], line[i + 1]);
    if (!(segment > 0)) continue;
    const glm::dvec3 along = (line[i + 1] - line[i]) / segment;
    for (; next <= passed + segment; next = static_cast<double>(made.size()) * spacing)
      place(line[i] + (next - passed) * along, along);
    passed += segment;
  }
  // A dot has no direction: it is moved in the stroke's plane.
  if (made.empty()) {
    const glm::dvec3 normal = e.stroke.plane ? e.stroke.plane->normal : -screen.forward();
    place(line.front(), glm::normalize(normal));
  }
  return made;
}

}  // namespace airlight
