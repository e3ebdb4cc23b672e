// What the medium adds to a ray and takes from it, by quadrature in double. Independent of common/formulas/airlight.h and
// its tables: nothing here knows the boundary functions.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/reference/grid.h"
#include "common/reference/optical_depth.h"
#include "common/reference/quadrature.h"
#include "common/reference/visibility.h"
#include "common/scene/scene.h"

namespace airlight {

// A medium relative to the camera, and what is made of its grid once.
struct RelativeMedium : Medium {
  std::optional<GridField> field;  // there where the grid is

  RelativeMedium(const Medium&, const glm::dvec3& camera);
};

// A ray through the medium: a view ray from the camera, or one that arrives at a surface.
class RayInMedium {
 public:
  // `medium` must outlive this; unit direction; length [m], may be infinite.
  RayInMedium(const RelativeMedium& medium, const glm::dvec3& origin, const glm::dvec3& direction, double length);

  double depth(double t) const;  // optical depth from the origin to t [1]; infinite where it is
  double depth() const { return depth(length_); }
  double reach() const { return reach_; }  // [m] no farther than the length: beyond it nothing scatters toward the origin

  // Single scattering of one light where it is not in `shadow` (common/reference/visibility.h) [W/m^2/sr].
  Integral scattered(const RelativeLight&, const std::vector<Interval>& shadow, double tolerance) const;

  // Emission of the homogeneous part and the Gaussians [W/m^2/sr].
  Integral emitted(double tolerance) const;

 private:
  struct OnRay {
    GaussianOnLine line;
    const Gaussian* gaussian;
  };
  glm::dvec3 scattering(double t) const;  // sigma_s [1/m]
  std::vector<double> breaks() const;
  void add_light_breaks(const RelativeLight&, double foot, std::vector<double>&) const;
  void add_grid_breaks(const RelativeLight&, std::vector<double>&) const;

  const RelativeMedium& medium_;
  glm::dvec3 origin_, direction_;
  double length_ = 0, reach_ = 0;
  std::vector<OnRay> on_ray_;       // those that are not negligible
  std::optional<GridOnLine> grid_;  // where the ray meets it
};

// Optical depth from a point to the light: Gaussians and the grid always, the homogeneous part for point lights only, over
// `length` [m].
double depth_to_light(const RelativeMedium&, const glm::dvec3& point, const RelativeLight&, double length);

}  // namespace airlight
