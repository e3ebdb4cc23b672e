#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "common/design/tools.h"
#include "common/error.h"

namespace airlight {

double distance_to_line(const glm::dvec3& p, const std::vector<glm::dvec3>& line) {
  double nearest = glm::distance(p, line.front());
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec3 along = line[i + 1] - line[i];
    const double squared = glm::dot(along, along);
    if (!(squared > 0)) continue;
    const double t = glm::clamp(glm::dot(p - line[i], along) / squared, 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(p, line[i] + t * along));
  }
  return nearest;
}

std::size_t erase(const EraseEdit& e, const Screen& screen, std::vector<Gaussian>& gaussians) {
  const bool through = !e.stroke.screen.empty() && !e.stroke.plane;  // along the view rays
  std::vector<glm::dvec3> line;
  if (through) {
    for (const glm::dvec2& p : e.stroke.screen) line.emplace_back(p.x, p.y, 0);
    if (!e.stroke.points.empty()) throw InputError("expected the stroke's points either in \"screen\" or in \"points\"");
  } else {
    line = world_points(e.stroke, screen);
  }
  const auto covered = [&](const glm::dvec3& center) {
    if (!through) return distance_to_line(center, line) < e.radius;
    const auto seen = screen.seen(center);
    return seen && distance_to_line({seen->at.x, seen->at.y, 0}, line) * (seen->depth * screen.half_height()) < e.radius;
  };
  std::size_t count = 0;
  for (Gaussian& g : gaussians) {
    if (!covered(g.center)) continue;
    ++count;
    g.extinction = std::max(0.0, g.extinction - e.amount);
  }
  if (count > 0) std::erase_if(gaussians, [](const Gaussian& g) { return g.extinction == 0; });
  return count;
}

bool covers(const ScreenRectangle& r, const Screen& screen, const glm::dvec3& center) {
  const auto seen = screen.seen(center);
  if (!seen) return false;
  const glm::dvec2 low = glm::min(r.from, r.to), high = glm::max(r.from, r.to);
  return seen->at.x >= low.x && seen->at.x <= high.x && seen->at.y >= low.y && seen->at.y <= high.y;
}

}  // namespace airlight
