// Inputs of the parity cases, made in code: meshes, and the G-buffer of a sphere on a plane by exact intersection.
#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/scene.h"
#include "tests/parity/case.h"

namespace airlight {

// Deterministic values in [0, 1): the i-th of a stream.
double uniform(std::uint32_t stream, std::uint32_t i);

// A camera at the origin that looks along -Z and a little down.
View test_view(Extent);

// What that camera sees of a sphere (material 1) on a plane (material 0); beyond the horizon nothing.
struct TestSurfaces {
  Image distance, normal, material;
  std::vector<float> distances, normals, materials;
};
TestSurfaces sphere_on_plane(const View&, std::uint32_t first_id);
void add_to(Case&, const TestSurfaces&);

// Two points and a directional light; coloured.
std::vector<Light> test_lights();
std::vector<Material> test_materials();

// A wavy torus of about `triangles` triangles, smooth normals.
std::shared_ptr<const Mesh> wavy_torus(std::size_t triangles);
std::shared_ptr<const Mesh> square(double half);  // in the plane y = 0

// The torus over a plane in fog under those lights, seen from 4 m.
Scene test_scene(std::size_t triangles);

// `n` slats across x, each with a gap of its own width.
std::shared_ptr<const Mesh> slats(unsigned n);
// One caster under these lights, seen by the camera of test_view().
Scene lit_scene(std::shared_ptr<const Mesh>, const glm::dvec3& at, double size, const std::vector<Light>& = test_lights());
// Shadow volumes of a torus and of slats under these lights; they become buffer `id` of the case.
Buffer add_test_volumes(Case&, std::uint32_t id, const std::vector<Light>&);

}  // namespace airlight
