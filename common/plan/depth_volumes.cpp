#include "common/plan/depth_volumes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "common/formulas/double.h"
#include "common/plan/geometry.h"

namespace airlight {

namespace {

// A frustum wider than this is a cube about the light instead, most of whose rays miss the box and cost nothing.
constexpr double widest = 2.5;

glm::dvec3 corner_of(const MediumBox& box, int n) {
  const glm::dvec3 size = box.size();
  return box.corner + glm::dvec3(n & 1 ? size.x : 0, n & 2 ? size.y : 0, n & 4 ? size.z : 0);
}

// Rows that turn the world to the axes x, y, z about a place.
void set_rows(DepthVolume& v, const glm::dmat3& axes, const glm::dvec3& place, const glm::dvec3& origin) {
  for (int i = 0; i < 3; ++i) v.rows[i] = glm::dvec4(axes[i], glm::dot(axes[i], origin - place));
}

void set_nodes(DepthVolume& v, const glm::dvec3& least, const glm::dvec3& most, const glm::dvec3& nodes) {
  for (int i = 0; i < 3; ++i) {
    v.nodes[i] = static_cast<float>(std::max(std::ceil(nodes[i]), 1.0) + 1);
    const double size = std::max(most[i] - least[i], 1e-12);
    v.first[i] = static_cast<float>(least[i]);
    v.scale[i] = static_cast<float>(static_cast<double>(v.nodes[i] - 1) / size);
  }
}

// Perpendicular to z and to each other.
glm::dmat3 axes_about(const glm::dvec3& z) {
  const glm::dvec3 beside = std::fabs(z.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(beside, z));
  return {x, glm::cross(z, x), z};
}

struct Extents {
  glm::dvec3 least{1e300}, most{-1e300};
  void add(const glm::dvec3& p) { least = glm::min(least, p), most = glm::max(most, p); }
};

DepthVolume parallel_volume(const MediumBox& box, const glm::dvec3& direction, const glm::dvec3& origin) {
  const glm::dmat3 axes = axes_about(glm::normalize(direction));
  Extents e;
  for (int n = 0; n < 8; ++n) e.add((corner_of(box, n) - box.corner) * axes);
  DepthVolume v;
  v.kind = DepthVolume::Kind::parallel;
  const glm::dvec3 front = box.corner + axes[2] * e.least.z;  // z = 0 where the box begins
  set_rows(v, axes, front, origin);
  e.most.z -= e.least.z, e.least.z = 0;
  set_nodes(v, e.least, e.most, (e.most - e.least) / box.cell);
  return v;
}

}  // namespace

MediumBox medium_box(const Scene& scene, int resolution) { return medium_box(scene, resolution, least_lost_depth); }

MediumBox medium_box(const Scene& scene, int resolution, double lost_depth) {
  Extents e;
  for (const Gaussian& g : scene.medium.gaussians) {
    if (!(g.extinction > 0)) continue;
    const glm::dvec3 reach(static_cast<double>(gaussian_reach(g, lost_depth)));
    e.add(g.center - reach), e.add(g.center + reach);
  }
  if (scene.medium.grid) {
    const glm::dvec3 cells(scene.medium.grid->voxels->size);
    for (int n = 0; n < 8; ++n) {
      // Half a cell of slope lies around the box.
      const glm::dvec3 at(n & 1 ? cells.x + 0.5 : -0.5, n & 2 ? cells.y + 0.5 : -0.5, n & 4 ? cells.z + 0.5 : -0.5);
      e.add(glm::dvec3(scene.medium.grid->transform * glm::dvec4(at, 1)));
    }
  }
  MediumBox box;
  if (!(e.least.x <= e.most.x)) return box;
  const glm::dvec3 size = e.most - e.least;
  box.cell = std::max({size.x, size.y, size.z}) / resolution;
  for (int axis = 0; axis < 3; ++axis) {
    box.cells[axis] = std::max(static_cast<int>(std::ceil(size[axis] / box.cell - 1e-9)), 2);
    box.corner[axis] = e.least[axis] - 0.5 * (box.cells[axis] * box.cell - size[axis]);
  }
  return box;
}

DepthVolume depth_volume(const MediumBox& box, const LightSource& light, const glm::dvec3& origin) {
  if (light.type == LightType::directional) return parallel_volume(box, light.direction, origin);
  const glm::dvec3 to_middle = box.corner + 0.5 * box.size() - light.position;
  DepthVolume v;
  if (const double distance = glm::length(to_middle); distance > 0) {
    const glm::dmat3 axes = axes_about(to_middle / distance);
    Extents e;
    bool fits = true;
    for (int n = 0; n < 8 && fits; ++n) {
      const glm::dvec3 p = (corner_of(box, n) - light.position) * axes;
      fits = p.z > 0 && std::max(std::fabs(p.x), std::fabs(p.y)) < widest * p.z;
      if (fits) e.add({p.x / p.z, p.y / p.z, p.z});
    }
    if (fits) {
      v.kind = DepthVolume::Kind::frustum;
      set_rows(v, axes, light.position, origin);
      glm::dvec3 nodes = (e.most - e.least) / box.cell;
      nodes.x *= e.most.z, nodes.y *= e.most.z;
      set_nodes(v, e.least, e.most, nodes);
      return v;
    }
  }
  double farthest = 0;
  for (int n = 0; n < 8; ++n) {
    const glm::dvec3 p = glm::abs(corner_of(box, n) - light.position);
    farthest = std::max({farthest, p.x, p.y, p.z});
  }
  v.kind = DepthVolume::Kind::cube;
  set_rows(v, glm::dmat3(1), light.position, origin);
  const double across = std::max({box.cells.x, box.cells.y, box.cells.z});
  const double planes = std::ceil(f64::cube_plane_number(farthest / box.cell));
  set_nodes(v, {-1, -1, 0}, {1, 1, farthest}, {across, across, planes});
  v.scale.z = static_cast<float>(1 / box.cell);
  return v;
}

DepthVolume cell_volume(const MediumBox& box, const glm::dvec3& origin) {
  DepthVolume v;
  const glm::dvec3 at = (origin - box.corner) / box.cell - 0.5;
  for (int i = 0; i < 3; ++i) {
    v.rows[i] = glm::vec4(0);
    v.rows[i][i] = static_cast<float>(1 / box.cell);
    v.rows[i].w = static_cast<float>(at[i]);
  }
  v.nodes = box.cells;
  return v;
}

GridDensity box_density(const MediumBox& box, const glm::vec3& albedo, const glm::dvec3& origin) {
  const DepthVolume cells = cell_volume(box, origin);
  GridDensity density;
  std::copy(std::begin(cells.rows), std::end(cells.rows), density.cells);
  density.size = box.cells;
  density.albedo = albedo;
  return density;
}

}  // namespace airlight
