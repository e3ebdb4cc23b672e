// Light of an environment in double: what of it is seen in a direction, and what surfaces reflect, direction by direction.
// Independent of common/formulas/environment.h and of spherical harmonics.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "common/reference/quadrature.h"
#include "common/reference/visibility.h"
#include "common/scene/scene.h"

namespace airlight {

class EnvironmentLighting {
 public:
  explicit EnvironmentLighting(const Environment&);

  // Along a unit direction [W/m^2/sr].
  glm::dvec3 radiance(const glm::dvec3& direction) const;

  // Radiance that a surface sends to the viewer, by its material or, where it has one, its tabulated reflectance: from all
  // directions above the horizon of its normal, each attenuated by transmittance(direction) (0..1). Unit
  // vectors; the mirror direction of the view ray. The error is the difference to half as many directions a degree; images finer
  // than two pixels a degree are finer than those of narrow lobes.
  Integral reflected(const glm::dvec3& normal, const glm::dvec3& mirror, const Surface&,
                     const std::function<double(const glm::dvec3&)>& transmittance) const;

  // The sum over patches of the sphere of scattered(a directional light from there), which is what a ray scatters of such a light
  // [W/m^2/sr]; the error is the difference to half as many patches a degree, and what the parts claim.
  Integral scattered(const std::function<Integral(const RelativeLight&)>& scattered) const;

  // A patch of the sphere: a direction in it, and its radiance times its solid angle.
  struct Patch {
    glm::dvec3 direction, power;
  };
  // All of it in patches as wide as 22 degrees at most, and twice that.
  const std::vector<Patch>& sky() const { return coarse_far_; }
  const std::vector<Patch>& coarse_sky() const { return coarse_sky_; }

 private:
  std::vector<Patch> patches(int columns) const;
  glm::dvec3 pixel(int column, int row) const;
  glm::dvec3 at(double column, double row) const;  // 0 at the first centres
  glm::dvec3 direction(double turns, double polar) const;

  Environment environment_;
  int width_ = 4, height_ = 2;
  std::vector<Patch> coarse_, fine_, coarse_far_, fine_far_, coarse_sky_;  // the latter for rays
};

}  // namespace airlight
