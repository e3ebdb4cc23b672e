// Single pixels of the truth, in double.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/image.h"
#include "common/progress.h"
#include "common/reference/airlight.h"
#include "common/reference/environment.h"
#include "common/reference/visibility.h"
#include "common/scene/scene.h"

namespace airlight {

// Light that scatters once on its way to surfaces: none; of the unbounded homogeneous medium without shadows, which is what
// techniques render; of the medium and the surfaces that there are (indirect_exact.h). Of an environment: only exact
// (environment_indirect.h).
enum class Indirect { off, unbounded, exact };

struct ReferenceSettings {
  double tolerance = 1e-7;  // relative, of each light's integral along a ray: 1e-12..1e-2
  bool shadows = true;      // off: V = 1 everywhere, on surfaces and in the medium, for the light of lamps
  Indirect indirect = Indirect::off;
  double indirect_tolerance = 1e-3;  // relative, of what is indirect and exact from each light: 1e-6..1e-1
  int max_bounces = 1;               // orders of scattering in the airlight; those above the first by random paths (paths.h)
  int paths = 256;                   // a pixel, >= 2
  bool single_by_paths = false;      // the first order by paths, too, instead of by quadrature
  std::uint32_t seed = 0;            // of the paths
  bool environment_shadows = true;   // off: V = 1 for an environment's light on surfaces; in the medium it always is

  bool any_paths() const { return max_bounces > 1 || single_by_paths; }
};

struct ReferencePixel {
  double depth = 1e30;       // [m] along the ray; 1e30 where nothing is hit
  glm::dvec3 normal{0};      // unit, turned to the viewer; 0 where nothing is hit
  int surface_index = -1;    // in Scene::surfaces; -1 where nothing is hit
  double optical_depth = 0;  // to the surface or over sky_distance; 1e30 where it is infinite
  double transmittance = 1;  // 0..1
  glm::dvec3 surface{0};     // [W/m^2/sr] as it reaches the camera: direct + indirect + ambient, or the background; environment
  glm::dvec3 surface_direct{0}, surface_indirect{0}, surface_ambient{0};
  glm::dvec3 surface_environment{0};  // reflected; seen where nothing is hit
  glm::dvec3 airlight{0};             // [W/m^2/sr] all lights, ambient and emission
  std::vector<glm::dvec3> airlight_of_light;
  glm::dvec3 standard_error{0};  // [W/m^2/sr] of the airlight, by the spread of its paths; 0 without any
  // Estimated relative error of the worst channel of surface + airlight, that of random paths aside. What is indirect counts
  // where it is exact; unbounded, it comes of a fixed rule, which leaves less than 1e-5 of it (tests/unit/surface_airlight.cpp)
  // and is not counted.
  double error = 0;

  glm::dvec3 beauty() const { return surface + airlight; }
};

// What a pixel needs beyond visibility.
struct ReferenceParts {
  bool surface = true, airlight = true;
};

// The truth about one scene; const calls may come from any thread. Definitions: light of point and directional lights scattered
// once (or up to max_bounces times) in the homogeneous medium, Gaussians and the grid, direct light on surfaces, r_l as the least
// distance to a point light. What surfaces send does not depend on max_bounces: light scattered more than once does not
// illuminate them, and what they reflect is not scattered (paths.h tells all that is in it). An
// environment's light is hidden by surfaces on its way to others, and by nothing on its way into the medium, which scatters it
// toward surfaces where what is indirect is exact. Emission of a Gaussian is its `emission` times exp(-|x-center|^2 / radius^2).
class Reference {
 public:
  // Throws InputError where a directional light or an environment and homogeneous fog of albedo 1 have no sum of so many orders.
  explicit Reference(const Scene&, const ReferenceSettings& = {});

  // (x, y) in pixels from the left and the top, centres at + 0.5. Throws Interrupted when `stop` asks for it.
  ReferencePixel pixel(glm::dvec2 at, Extent, const ReferenceParts& = {}, const Progress* stop = nullptr) const;

  // Whether depth, normal, material or a light's shadow on the surface jumps within 1/100 pixel of the point.
  bool edge(glm::dvec2 at, Extent) const;

  // The parts of a pixel's ray that light `light` does not reach.
  std::vector<Interval> shadows(glm::dvec2 at, Extent, std::size_t light) const;

 private:
  struct Seen;
  glm::dvec3 direction(glm::dvec2 at, Extent) const;
  Seen look(const glm::dvec3& direction) const;
  double irradiance(const Seen&, const RelativeLight&) const;
  bool lit(const Seen&, const RelativeLight&) const;
  bool jumps(const Seen& here, const Seen& there, double pixel_angle) const;
  void shade(const glm::dvec3& direction, const Seen&, ReferencePixel&, glm::dvec3& error) const;
  void add_airlight(const RayInMedium&, const glm::dvec2& at, ReferencePixel&, glm::dvec3& error, const Progress* stop) const;
  Integral indirect(const Seen&, const glm::dvec3& mirror, const RelativeLight&) const;
  Integral environment(const glm::dvec3& direction, const Seen&) const;

  Scene scene_;
  RelativeMedium medium_;
  ReferenceSettings settings_;
  std::vector<RelativeLight> lights_;
  Visibility visibility_;
  std::optional<EnvironmentLighting> environment_;
  glm::dvec3 right_, up_, forward_;
  double tan_half_fov_ = 0;
};

struct Reference::Seen {
  bool hit = false;
  double distance = 1e30;
  std::uint32_t triangle = 0;
  int surface = -1;
  glm::dvec3 direction{0}, point{0}, normal{0}, face{0};  // face: the triangle's own unit normal, either way
};

}  // namespace airlight
