// What a scene's casters and lights become for ShadowPlanes: silhouettes relative to the camera, and what covers the camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/algorithms/shadow_planes.h"
#include "common/plan/plan.h"
#include "common/plan/silhouette.h"
#include "common/scene/scene.h"

namespace airlight {

// A light of the scene relative to the camera.
HomogeneousLight light_near_camera(const Scene&, std::size_t light);

// Whether a surface's shadow can be seen at all: no for one so far from a point light that its light is below any float there.
bool shadow_matters(const Scene&, const Surface&, const LightSource&);
// Whether the homogeneous part lets nothing of the surface through to the camera: then it is not shaded.
bool behind_fog(const Scene&, const Surface&);

struct ShadowVolumes {
  std::vector<ShadowLight> lights;
  std::vector<ShadowEdge> edges;
};
// `lights`: positions in Scene::lights, in the order of the algorithm's. Edges of one light lie as the meshes have them, or for
// the published order back to front.
ShadowVolumes shadow_volumes(const Scene&, const std::vector<std::size_t>& lights, ShadowOrder);
// [byte] of them. Silhouettes that are found for that are kept until they are wanted.
std::size_t shadow_volume_bytes(const Scene&, const std::vector<std::size_t>& lights);

// Sorts shadow planes as wholes, the last met by a ray from the camera first. Along any such ray the angle at a point light
// between the camera and the ray's point grows (for a directional light: the distance from the line through the camera toward
// it), so a plane, whose points have the angles of its edge, is sorted by that of the edge's middle. Equal ones keep their order.
void back_to_front(std::span<ShadowEdge>, const ShadowLight&);

// The same as an upload. `geometry_key` names positions and triangles relative to the camera (Geometry).
Plan::Upload shadow_volumes_upload(const Scene&, const std::vector<std::size_t>& lights, ShadowOrder, std::uint64_t geometry_key,
                                   std::uint32_t id);

}  // namespace airlight
