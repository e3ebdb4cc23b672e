// Which pixels lie so close to an edge that a rasteriser with rounded vertices may see its other side.

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/reference/pixel.h"

namespace airlight {

// `apart`: angle between the two rays [rad].
bool Reference::jumps(const Seen& here, const Seen& there, double apart) const {
  if (here.surface != there.surface) return true;
  if (!here.hit) return false;
  if (settings_.shadows) {
    for (const RelativeLight& light : lights_) {
      if (lit(here, light) != lit(there, light)) return true;
    }
  }
  if (here.triangle == there.triangle) return false;
  // Interpolated normals turn far less than a degree in 1/100 pixel; across a crease they jump.
  constexpr double cosine_of_a_degree = 0.99984769515639124;
  if (!(glm::dot(here.normal, there.normal) > cosine_of_a_degree)) return true;
  // Neighbours across an edge lie in each other's planes at the edge, so depths differ by what both slopes make of the angle;
  // more than twice that is a jump.
  const auto slope = [apart](const Seen& s) { return s.distance * apart / std::fabs(glm::dot(s.face, s.direction)); };
  return std::fabs(there.distance - here.distance) > 2 * (slope(here) + slope(there));
}

bool Reference::edge(glm::dvec2 at, Extent extent) const {
  // Eight points see every straight edge that comes nearer than the circle's radius times cos(pi/8): that is 1/100 pixel.
  const double radius = 0.01 / std::cos(std::numbers::pi / 8);
  const Seen here = look(direction(at, extent));
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    const glm::dvec2 offset(radius * std::cos(angle), radius * std::sin(angle));
    const glm::dvec3 d = direction(at + offset, extent);
    if (jumps(here, look(d), glm::length(d - here.direction))) return true;
  }
  return false;
}

}  // namespace airlight
