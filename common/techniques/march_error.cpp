#include "common/techniques/march_error.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "common/plan/geometry.h"

namespace airlight {

namespace {

constexpr double grid_scale = 6;  // cells over which the extinction of a grid is taken to change

// The farthest that a view ray goes [m]; infinite where one may hit nothing.
double longest_view(const Scene& scene) {
  double farthest = scene.sky_distance;
  if (std::isfinite(farthest)) {
    for (const Surface& s : scene.surfaces) {
      for (const glm::vec3& p : s.mesh->positions) {
        const glm::dvec3 place(s.transform * glm::dvec4(glm::dvec3(p), 1.0));
        farthest = std::max(farthest, glm::distance(place, scene.camera.position));
      }
    }
  }
  return farthest;
}

// [1/m] Of the whole medium; a grid's is that of the cell.
double extinction_at_camera(const Scene& scene) {
  double sum = scene.medium.extinction;
  for (const Gaussian& g : scene.medium.gaussians) {
    const double distance = glm::distance(g.center, scene.camera.position) / g.radius;
    sum += g.extinction * std::exp(-distance * distance);
  }
  if (const std::optional<GridMedium>& grid = scene.medium.grid) {
    const glm::dvec3 place(glm::inverse(grid->transform) * glm::dvec4(scene.camera.position, 1.0));
    const glm::dvec3 size(grid->voxels->size);
    if (glm::all(glm::greaterThanEqual(place, glm::dvec3(0))) && glm::all(glm::lessThan(place, size))) {
      const glm::dvec3 cell = glm::floor(place);
      sum += grid->scale *
             static_cast<double>(grid->voxels->values[static_cast<std::size_t>(cell.x + size.x * (cell.y + size.y * cell.z))]);
    }
  }
  return sum;
}

double farthest_lamp(const Scene& scene) {
  double distance = 0;
  for (const LightSource& l : scene.lights) {
    if (l.type == LightType::point) distance = std::max(distance, glm::distance(l.position, scene.camera.position));
  }
  return distance;
}

}  // namespace

double UnevenPart::left_by(double n) const {
  const double y = length / (n * scale);
  return 0.02 * y * y * (1 + y * y / 5);
}

double UnevenPart::left_by_cells(double cell) const {
  const double y = length > 0 ? cell / scale : 0;
  return 0.33 * y * y * (1 + 2 * y * y);
}

UnevenPart gaussians_part(const Scene& scene) {
  double near_end = 1e300, far_end = 0, least = 1e300;
  for (const GaussianDensity& g : gaussians_of(scene)) {
    const double distance = static_cast<double>(glm::length(g.center)), reach = static_cast<double>(g.reach);
    near_end = std::min(near_end, std::max(distance - reach, 0.0));
    far_end = std::max(far_end, distance + reach);
    least = std::min(least, static_cast<double>(g.radius));
  }
  if (!(far_end > near_end)) return {};
  return {std::max(std::min(far_end, longest_view(scene)) - near_end, 0.0), least};
}

UnevenPart grid_part(const Scene& scene) {
  if (!scene.medium.grid) return {};
  const glm::dvec3 size(scene.medium.grid->voxels->size);
  const glm::dmat3 frame(scene.medium.grid->transform);
  const double cell = std::min({glm::length(frame[0]), glm::length(frame[1]), glm::length(frame[2])});
  return {glm::length(frame * size), grid_scale * cell};
}

double left_by_steps(const Scene& scene, double n) {
  const Medium& medium = scene.medium;
  const bool lamps =
      std::any_of(scene.lights.begin(), scene.lights.end(), [](const LightSource& l) { return l.type == LightType::point; });
  const bool isotropic = medium.phase.kind == PhaseKind::isotropic || medium.phase.kind == PhaseKind::rayleigh;
  double error = 3e-5;
  if (!isotropic && lamps && !medium.empty()) error += 0.4 / n;
  const UnevenPart gaussians = gaussians_part(scene), grid = grid_part(scene);
  if (const double extinction = extinction_at_camera(scene); extinction > 0) {
    double view = longest_view(scene);
    if (!(medium.extinction > 0)) view = std::min(view, std::max(gaussians.length, grid.length));
    const double tau = std::min(extinction * view, 80.0);
    const double x = (1 + extinction * std::min(farthest_lamp(scene), view)) * std::log1p(tau) / n;
    error += 0.25 * x * x;
  }
  return error + gaussians.left_by(n) + grid.left_by(n);
}

}  // namespace airlight
