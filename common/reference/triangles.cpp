#include "common/reference/triangles.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include "common/error.h"

namespace airlight {

namespace {

// What Embree's callbacks build, in Embree's memory; copied out when it is complete.
struct Built {
  static constexpr unsigned most = 8;
  bool leaf = false;
  RTCBounds bounds[2];
  Built* child[2] = {nullptr, nullptr};
  unsigned count = 0;
  unsigned triangle[most];
};

void* make_node(RTCThreadLocalAllocator memory, unsigned, void*) {
  return new (rtcThreadLocalAlloc(memory, sizeof(Built), 16)) Built;
}

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Built*>(node)->child[i] = static_cast<Built*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Built*>(node)->bounds[i] = *bounds[i];
}

void* make_leaf(RTCThreadLocalAllocator memory, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* leaf = new (rtcThreadLocalAlloc(memory, sizeof(Built), 16)) Built;
  leaf->leaf = true;
  leaf->count = static_cast<unsigned>(count);
  for (unsigned i = 0; i < leaf->count; ++i) leaf->triangle[i] = primitives[i].primID;
  return leaf;
}

struct ReleaseDevice {
  void operator()(RTCDeviceTy* d) const { rtcReleaseDevice(d); }
};
struct ReleaseBvh {
  void operator()(RTCBVHTy* b) const { rtcReleaseBVH(b); }
};

}  // namespace

Triangles::Triangles(const Scene& scene) {
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    const auto first = static_cast<std::uint32_t>(positions_.size());
    for (const glm::vec3& p : surface.mesh->positions) {
      positions_.push_back(glm::dvec3(surface.transform * glm::dvec4(glm::dvec3(p), 1.0)) - scene.camera.position);
    }
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(surface.transform)));
    for (const glm::vec3& n : surface.mesh->normals) normals_.push_back(glm::normalize(turn * glm::dvec3(n)));
    for (const glm::uvec3& t : surface.mesh->triangles) {
      triangles_.push_back({{first + t.x, first + t.y, first + t.z}, static_cast<std::uint32_t>(s)});
    }
  }
  if (!triangles_.empty()) build();
}

void Triangles::build() {
  double scale = 0;
  for (const glm::dvec3& p : positions_) scale = std::max({scale, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  // Float rounding moves a box face by 6e-8 of the scale at most; what is left covers the rounding of the tests in double.
  const double margin = 4e-7 * scale + 1e-30;
  std::vector<RTCBuildPrimitive> primitives(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    glm::dvec3 low = position(triangles_[i], 0), high = low;
    for (int k = 1; k < 3; ++k) {
      low = glm::min(low, position(triangles_[i], k));
      high = glm::max(high, position(triangles_[i], k));
    }
    const glm::vec3 l(low - margin), h(high + margin);
    primitives[i] = {l.x, l.y, l.z, 0, h.x, h.y, h.z, static_cast<unsigned>(i)};
  }

  const std::unique_ptr<RTCDeviceTy, ReleaseDevice> device(rtcNewDevice(nullptr));
  if (!device) throw MachineError("Embree gives no device: error " + std::to_string(rtcGetDeviceError(nullptr)));
  const std::unique_ptr<RTCBVHTy, ReleaseBvh> bvh(rtcNewBVH(device.get()));
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxDepth = 64;
  arguments.maxLeafSize = Built::most;
  arguments.bvh = bvh.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = make_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = make_leaf;
  const auto* root = static_cast<const Built*>(rtcBuildBVH(&arguments));
  if (!root) throw MachineError("Embree cannot build a hierarchy: error " + std::to_string(rtcGetDeviceError(device.get())));

  // Copied into one array; the root gets a box that everything meets.
  const auto place = [this](const Built* built, const Box& box, Child& child) {
    child.box = box;
    child.empty = false;
    child.count = built->leaf ? built->count : 0;
    child.first = static_cast<std::uint32_t>(built->leaf ? leaves_.size() : nodes_.size());
    if (built->leaf) leaves_.insert(leaves_.end(), built->triangle, built->triangle + built->count);
  };
  nodes_.emplace_back();
  Box all;
  all.low.fill(-std::numeric_limits<float>::max());
  all.high.fill(std::numeric_limits<float>::max());
  place(root, all, nodes_[0].child[0]);
  std::vector<const Built*> inner;
  if (!root->leaf) inner.push_back(root), nodes_.emplace_back();
  for (std::size_t i = 0; i < inner.size(); ++i) {  // inner[i] is nodes_[i + 1]
    for (std::size_t side = 0; side < 2; ++side) {
      const Built* child = inner[i]->child[side];
      if (!child) continue;
      const RTCBounds& b = inner[i]->bounds[side];
      place(child, {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}}, nodes_[i + 1].child[side]);
      if (!child->leaf) inner.push_back(child), nodes_.emplace_back();
    }
  }
}

}  // namespace airlight
