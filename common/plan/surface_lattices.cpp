#include "common/plan/surface_lattices.h"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>

namespace airlight {

namespace {

struct Box {
  glm::dvec3 least{0}, most{0};
};

// Of the mesh's own box, turned with it.
Box box_of(const Surface& surface) {
  if (surface.mesh->positions.empty()) return {};
  glm::vec3 least = surface.mesh->positions[0], most = least;
  for (const glm::vec3& p : surface.mesh->positions) least = glm::min(least, p), most = glm::max(most, p);
  Box box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p((corner & 1) != 0 ? most.x : least.x, (corner & 2) != 0 ? most.y : least.y,
                       (corner & 4) != 0 ? most.z : least.z, 1);
    const glm::dvec3 there(surface.transform * p);
    box.least = glm::min(box.least, there), box.most = glm::max(box.most, there);
  }
  return box;
}

std::vector<Box> boxes_of(const Scene& scene) {
  std::vector<Box> boxes;
  for (const Surface& s : scene.surfaces) boxes.push_back(box_of(s));
  return boxes;
}

// In the middle of them all.
glm::dvec3 origin_of(const std::vector<Box>& boxes) {
  Box all = boxes.empty() ? Box{} : boxes[0];
  for (const Box& b : boxes) all.least = glm::min(all.least, b.least), all.most = glm::max(all.most, b.most);
  return 0.5 * (all.least + all.most);
}

}  // namespace

std::vector<DepthLattice> SurfaceLattices::from(const glm::dvec3& place) const {
  std::vector<DepthLattice> seen = lattices;
  for (DepthLattice& l : seen) l.corner = glm::vec3(glm::dvec3(l.corner) + origin - place);
  return seen;
}

SurfaceLattices surface_lattices(const Scene& scene, double spacing, double most) {
  const std::vector<Box> boxes = boxes_of(scene);
  SurfaceLattices all;
  all.origin = origin_of(boxes);
  for (const Box& b : boxes) {
    // A hair more, for float rounds places beyond the last node.
    const glm::dvec3 nodes = glm::max(glm::ceil((b.most - b.least) * (1.001 / spacing)), glm::dvec3(1)) + 1.0;
    const double first = all.nodes;
    all.nodes += nodes.x * nodes.y * nodes.z;
    if (all.nodes <= most) {
      all.lattices.push_back(
          {glm::vec3(b.least - all.origin), static_cast<float>(spacing), glm::ivec3(nodes), static_cast<int>(first)});
    }
  }
  if (all.nodes > most) all.lattices.clear();
  return all;
}

SurfaceLattices surface_middles(const Scene& scene) {
  const std::vector<Box> boxes = boxes_of(scene);
  SurfaceLattices all;
  all.origin = origin_of(boxes);
  for (const Box& b : boxes) {
    all.lattices.push_back({glm::vec3(0.5 * (b.least + b.most) - all.origin), 1, glm::ivec3(1), static_cast<int>(all.nodes)});
    all.nodes += 1;
  }
  return all;
}

}  // namespace airlight
