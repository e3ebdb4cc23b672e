// The scene as a value: what a scene file says, checked, with meshes loaded. Units: metres, W, sr; right-handed, +Y up; linear
// Rec.709. It holds no file handle, no backend object, and nothing changes it after loading; copies share their meshes.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/algorithms/view.h"

namespace airlight {

struct Camera {
  glm::dvec3 position{0, 0, 0};
  glm::dvec3 look_at{0, 0, -1};
  glm::dvec3 up{0, 1, 0};
  double vertical_fov = 45;  // [degree] 0.01..179
  Extent resolution{800, 600};
};

// extinction * exp(-|x - center|^2 / radius^2)
struct Gaussian {
  glm::dvec3 center{0, 0, 0};
  double radius = 1;      // [m] > 0
  double extinction = 1;  // [1/m] >= 0
  glm::dvec3 albedo{1, 1, 1};
  glm::dvec3 emission{0, 0, 0};  // [W/m^3/sr]
};

// Values on a box of cells: value (x, y, z) stands at x + size.x (y + size.y z) and is sampled at the centre of its cell
// (common/formulas/grid.h). Values are finite and not negative.
struct VoxelGrid {
  glm::ivec3 size{1, 1, 1};  // cells an axis, each > 0
  std::vector<float> values;
};

// Extinction given by a voxel grid; it falls to 0 half a cell outside the box.
struct GridMedium {
  std::shared_ptr<const VoxelGrid> voxels;
  glm::dmat4 transform{1.0};  // cells to world, affine, invertible: the box is 0..size before it, value (0, 0, 0) stands at 1/2
  double scale = 1;           // [1/m] extinction where the value is 1
  glm::dvec3 albedo{1, 1, 1};
};

// Bends view rays where they cross Gaussians (Zhou et al. 2007, section 5.5): a look, no physics.
struct Noise {
  double amplitude = 0;        // 0..1: by how much of a Gaussian's radius; 0: none
  double scale = 1;            // [m] > 0 of a cell
  glm::dvec3 offset{0, 0, 0};  // [cells], to animate it; it repeats after 256
};

struct Medium {
  Phase phase;
  glm::dvec3 albedo{1, 1, 1};    // each 0..1
  glm::dvec3 ambient{0, 0, 0};   // [W/m^2/sr] constant source radiance L_a
  glm::dvec3 emission{0, 0, 0};  // [W/m^3/sr] of the homogeneous part
  double extinction = 0;         // [1/m] of the homogeneous part
  std::vector<Gaussian> gaussians;
  std::optional<GridMedium> grid;
  Noise noise;

  bool empty() const { return extinction == 0 && gaussians.empty() && !grid; }
};

enum class LightType { point, directional };

struct LightSource {
  LightType type = LightType::point;
  std::string name;                // unique when given; else empty
  glm::dvec3 position{0, 0, 0};    // [m], point
  glm::dvec3 direction{0, -1, 0};  // unit, the way that light travels; directional
  glm::dvec3 power{1, 1, 1};       // radiant intensity [W/sr] of a point light, irradiance [W/m^2] of a directional one
  double radius = 1e-3;            // [m] > 0: 1/r^2 is held below it
};

// Light from everywhere, as far away as nothing else: of an image of latitude and longitude (top row +Y, centre -Z, columns
// toward +X, linear between the centres of pixels), or the same from all directions. As it arrives through the homogeneous part
// of the medium.
struct Environment {
  std::shared_ptr<const HostImage> image;  // three channels, twice as wide as high, at least 4 x 2; finite, not negative
  glm::dvec3 radiance{1, 1, 1};            // [W/m^2/sr] without an image; else what multiplies it
  double rotation = 0;                     // [degree] about +Y
};

// Vertices in the mesh's own frame. Normals are unit length, one a vertex (loading generates what a file lacks).
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> triangles;
  std::string file = {};  // that it was read from; empty: made in code
};

// A tabulated isotropic reflectance over the angles of the half vector, as common/formulas/brdf.h takes it: cells of theta_half
// (of its square root), theta_difference and phi_difference (0..pi), which is fastest; red, green, blue [1/sr], finite, not
// negative.
struct Brdf {
  glm::ivec3 size{2, 2, 2};   // cells of theta_half, theta_difference, phi_difference, each 2 or more
  std::vector<float> values;  // 3 size.x size.y size.z
};

struct Surface {
  std::shared_ptr<const Mesh> mesh;
  glm::dmat4 transform{1.0};  // mesh to world, affine, invertible
  bool casts_shadow = true;
  Material material;
  // How it reflects lights and the environment, in place of the material, which is then what is asked of ambient light and of
  // light that scatters on its way: brdf_material() of common/scene/brdf.h.
  std::shared_ptr<const Brdf> brdf = nullptr;
};

struct Scene {
  Camera camera;
  double sky_distance = std::numeric_limits<double>::infinity();  // [m] length of view rays that hit nothing
  Medium medium;
  std::vector<LightSource> lights;
  std::vector<Surface> surfaces;
  glm::dvec3 background{0, 0, 0};  // [W/m^2/sr]
  std::optional<Environment> environment;

  // What the file asks for; the command line wins.
  std::string technique;                                      // empty: not said
  std::vector<std::pair<std::string, std::string>> settings;  // knob, value

  // SHA-256 (hex) of the canonical content and of the bytes of every named file; no paths, no formatting. Empty for a scene built
  // in code.
  std::string hash;
};

}  // namespace airlight
