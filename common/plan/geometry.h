// What a scene's surfaces, lights and camera become for the algorithms: single precision, relative to the camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/algorithms/view.h"
#include "common/plan/plan.h"
#include "common/scene/scene.h"

namespace airlight {

View view_of(const Scene&, const FrameRequest&);

// For steps that only ask where lights are: they need not run again where one dims.
std::vector<Light> of_unit_power(std::vector<Light>);
// Whether nothing that this lamp sends through the homogeneous part of the medium arrives at the camera: by whatever way, it is
// no shorter than the straight one, and what is left of it is less than the least float.
bool out_of_reach(const Scene&, const LightSource&);
// Lights of non-zero power that are not out of reach; where `index` is given: position in the scene of each light returned.
std::vector<Light> lights_of(const Scene&, std::vector<std::size_t>* index = nullptr);
std::vector<Material> materials_of(const Scene&);
// Gaussians of non-zero extinction, each with its reach: a way that stays beyond it, or a part of one that does, loses less than
// `lost_depth` of optical depth there, and less than that share of the Gaussian's own (Zhou et al. 2007, eq. 30). Where a lamp
// stands little is bright: about such a place `least_lost_depth` holds.
constexpr double least_lost_depth = 1e-5;
std::vector<GaussianDensity> gaussians_of(const Scene&);
// [m] Of one, whatever stands there.
float gaussian_reach(const Gaussian&, double lost_depth);
// Seen from a place of one's own, not from the camera.
std::vector<GaussianDensity> gaussians_of(const Scene&, const glm::dvec3& origin, double lost_depth = least_lost_depth);
Light light_of(const LightSource&, const glm::dvec3& origin);

// The surfaces as one list of triangles, laid out as SurfaceVisibility wants it. The three uploads are made on demand.
struct Geometry {
  std::size_t vertices = 0, triangles = 0;
  Plan::Upload positions, normals, indices;
};
// `first_id`: handle of the positions; normals and indices get the next two. Throws InputError beyond 2^31 indices in all.
Geometry geometry_of(const Scene&, std::uint32_t first_id);

}  // namespace airlight
