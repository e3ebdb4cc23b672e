// Which Gaussians may stand between a light and what a sphere holds, and how smooth their shadow is there. Only + - * / and
// square roots: the same on every machine.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

struct Sphere {
  glm::dvec3 center;
  double radius;  // [m]
};

// [m] over which a Gaussian is smooth: its radius, and more where it takes so little that it may be rough.
double smooth_radius(const GaussianDensity&);

// All ways from a light to the places of a sphere: a cone, a cylinder for a directional light.
class LightWays {
 public:
  LightWays(const Light&, const Sphere&);
  // Whether a Gaussian may shade some place of the sphere from the light.
  bool meet(const GaussianDensity&) const;
  // Whether a Gaussian may have something of such a way behind the light.
  bool behind(const GaussianDensity&) const;
  // [m] over which the Gaussian's shadow is smooth: it spreads behind it as the light's rays do.
  double smooth(const GaussianDensity&, const Light&) const;

 private:
  glm::dvec3 vector_, toward_;  // from the light to the sphere; from the sphere to a directional light
  double length_ = 0, radius_ = 0, sine_ = 0, cosine_ = 1;
  bool directional_, within_ = false;  // within: the light may stand in the sphere
};

// All that Gaussians reach, as one box.
class GaussianReach {
 public:
  explicit GaussianReach(const std::vector<GaussianDensity>&);
  // Whether some of it may stand between the light and a place of the sphere.
  bool shades(const Light&, const Sphere&) const;
  // [m] over which the shadow of any of them is smooth.
  double smooth(const Light&, const Sphere&) const;

 private:
  glm::dvec3 least_{1e300}, most_{-1e300};
  double smooth_ = 1e300;
};

}  // namespace airlight
