// What of the medium is not homogeneous, relative to the camera like everything in view.h.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace airlight {

// extinction * exp(-|x - center|^2 / radius^2) for |x - center| < reach; the rest is left out.
struct GaussianDensity {
  glm::vec3 center{0, 0, 0};    // [m]
  float radius = 1;             // [m] > 0
  float extinction = 0;         // [1/m] > 0
  float reach = 0;              // [m]
  glm::vec3 albedo{1, 1, 1};    // 0..1
  glm::vec3 emission{0, 0, 0};  // [W/m^3/sr] at the centre
};

// Where a voxel grid stands. Its extinctions are a buffer (common/algorithms/voxel_table.h). Row i of `cells` takes a place (x,
// y, z, 1) to coordinate i in cells, 0 at the first centre; 0 cells: no grid.
struct GridDensity {
  glm::vec4 cells[3] = {};
  glm::vec3 size{0, 0, 0};    // cells an axis
  glm::vec3 albedo{1, 1, 1};  // 0..1
  float half_unit = 0;        // [1/m] in which they are kept in 16 bits, a power of 2; 0: they are floats

  explicit operator bool() const { return size.x > 0; }
};

// Noise by which view rays are bent where they cross Gaussians (common/formulas/noise.h). Amplitude 0: none.
struct RayNoise {
  float amplitude = 0;        // 0..1, of a Gaussian's radius
  float scale = 1;            // [m] of a cell of the noise
  glm::vec3 offset{0, 0, 0};  // [cells] where in it the camera stands
};

// Nodes of a lattice of mean depths: where the first stands, and where in a buffer of them it is, x fastest.
struct DepthLattice {
  glm::vec3 corner{0, 0, 0};  // [m]
  float spacing = 1;          // [m] > 0
  glm::ivec3 nodes{1, 1, 1};  // an axis, each > 1; or one in all, which counts everywhere
  int first = 0;
};
// Floats after all nodes that a lookup may read, without weight.
constexpr int depth_lattice_padding = 4;

// By which error function the optical depths of Gaussians are taken: erf_, or the polynomial that Zhou et al. 2007 print. The
// numbers are those of gaussian_erf() in common/formulas/gaussian.h.
enum class Erf : int { accurate = 0, fast = 1 };

// How the light's way through Gaussians and grid is attenuated: by marching it too; by the closed form of each Gaussian, marching
// the grid; by a lookup in the light's volume, which OpticalDepthPropagation makes.
enum class LightDepth : int { march, analytic, volume };

}  // namespace airlight
