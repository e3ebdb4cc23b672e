// Extinction and depths toward the lights of a scene's medium, in the volumes of opacity propagation.
#pragma once

#include <cstdint>

#include "common/plan/light_volumes.h"

namespace airlight {

// For a technique with the knobs `resolution scheme storage density`. Scene and plan must outlive this object.
class MediumVolumes {
 public:
  // Adds the upload of the scene's grid and the injection of the medium into the volume, as far as they are needed; else a skip
  // tells why not. Two handles from `first_id` on. Throws InputError for knobs that do not go together, or with the scene.
  MediumVolumes(FramePlan&, std::uint32_t first_id);

  // What rays are marched through, seen from the camera: the volume, or the scene's Gaussians and grid as they are.
  Density to_march() const;
  // Adds the steps of the depths toward the lights; none without a light or in a homogeneous medium, which a skip tells. A handle
  // a light from `first_id` on. Throws InputError as add_light_volumes().
  LightVolumes propagate(std::uint32_t first_id) const;

 private:
  Density as_given(const glm::dvec3& origin) const;
  Density injected(const glm::dvec3& origin) const;
  float half_unit() const;
  int samples(bool in_cells) const;

  FramePlan& frame_;
  MediumBox box_;          // about the volumes toward the lights
  MediumBox fine_;         // of the extinction's cells
  bool cells_ = false;     // the volumes are those of the same cells
  bool injected_ = false;  // rays are marched through the extinction's cells
  bool halves_ = false;    // and what they and the volumes hold is kept in 16 bits
  Buffer native_;          // the scene's grid
  Buffer extinction_;
};

}  // namespace airlight
