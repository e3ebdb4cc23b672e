// Handles of what a frame's plan uploads for all techniques.
#pragma once

#include <cstdint>

namespace airlight {

// Fixed, so that what is held under them stays where other images are wanted.
enum : std::uint32_t {
  geometry_id = 1,
  per_light_id = 4,
  indirect_tables_id = 5,
  airlight_tables_id = 6,
  environment_id = 7,
  environment_airlight_id = 8,
  hidden_environment_id = 9,
  brdf_id = 10,
  environment_indirect_id = 11,
  mean_depths_id = 12,
  first_image_id = 13
};

}  // namespace airlight
