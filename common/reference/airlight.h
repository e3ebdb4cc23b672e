// What the medium adds to a ray and takes from it, by quadrature in double. Independent of common/formulas/airlight.h and
// its tables: nothing here knows the boundary functions.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/reference/line.h"
#include "common/reference/quadrature.h"
#include "common/reference/visibility.h"
#include "common/scene/scene.h"

namespace airlight {

// A ray through the medium: a view ray from the camera, or one that arrives at a surface.
class RayInMedium : public LineInMedium {
 public:
  using LineInMedium::LineInMedium;

  // Single scattering of one light where it is not in `shadow` (common/reference/visibility.h) [W/m^2/sr].
  Integral scattered(const RelativeLight&, const std::vector<Interval>& shadow, double tolerance) const;

  // Emission of the homogeneous part and the Gaussians [W/m^2/sr].
  Integral emitted(double tolerance) const;

 private:
  std::vector<double> breaks() const;
  void add_light_breaks(const RelativeLight&, double foot, std::vector<double>&) const;
  void add_grid_breaks(const RelativeLight&, std::vector<double>&) const;
};

}  // namespace airlight
