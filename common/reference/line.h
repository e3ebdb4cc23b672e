// A straight line through the medium, in double: optical depth, what scatters on it, and where a given depth is reached.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/reference/grid.h"
#include "common/reference/optical_depth.h"
#include "common/reference/visibility.h"
#include "common/scene/scene.h"

namespace airlight {

// A medium relative to the camera, and what is made of its grid once.
struct RelativeMedium : Medium {
  std::optional<GridField> field;  // there where the grid is

  RelativeMedium(const Medium&, const glm::dvec3& camera);
};

class LineInMedium {
 public:
  // `medium` must outlive this; origin relative to the camera; unit direction; length [m], may be infinite.
  LineInMedium(const RelativeMedium& medium, const glm::dvec3& origin, const glm::dvec3& direction, double length);

  const glm::dvec3& direction() const { return direction_; }
  glm::dvec3 at(double t) const { return origin_ + t * direction_; }
  double depth(double t) const;  // T(origin, t) [1]; infinite where it is
  double depth() const { return depth(length_); }
  double reach() const { return reach_; }  // [m] no farther than the length: beyond it nothing scatters toward the origin
  double extinction(double t) const;       // [1/m]
  glm::dvec3 scattering(double t) const;   // sigma_s [1/m]
  glm::dvec3 glow(double t) const;         // emission of the Gaussians [W/m^3/sr]

  // Where the depth [1] is reached, to rounding: least t with depth(t) >= depth; reach() where there is none.
  double place(double depth) const;

 protected:
  struct OnLine {
    GaussianOnLine line;
    const Gaussian* gaussian;
  };

  const RelativeMedium& medium_;
  glm::dvec3 origin_, direction_;
  double length_ = 0, reach_ = 0;
  std::vector<OnLine> on_line_;     // those that are not negligible
  std::optional<GridOnLine> grid_;  // where the line meets it
};

// Optical depth from a point to the light: Gaussians and the grid always, the homogeneous part for point lights only, over
// `length` [m].
double depth_to_light(const RelativeMedium&, const glm::dvec3& point, const RelativeLight&, double length);

}  // namespace airlight
