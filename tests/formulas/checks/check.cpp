#include "tests/formulas/checks/check.h"

#include <cstdio>

namespace airlight {

std::vector<Check> all_checks() {
  std::vector<Check> checks;
  add_elementary_checks(checks);
  add_camera_checks(checks);
  add_triangle_checks(checks);
  add_phase_checks(checks);
  add_transmittance_checks(checks);
  add_reflection_checks(checks);
  add_grid_checks(checks);
  add_airlight_checks(checks);
  add_surface_airlight_checks(checks);
  add_gaussian_checks(checks);
  add_marching_checks(checks);
  add_depth_volume_checks(checks);
  add_network_checks(checks);
  add_splat_checks(checks);
  add_upsample_checks(checks);
  add_noise_checks(checks);
  add_spherical_harmonics_checks(checks);
  add_environment_checks(checks);
  add_brdf_checks(checks);
  return checks;
}

std::string place(std::initializer_list<std::pair<const char*, double>> values) {
  std::string text;
  for (const auto& [name, value] : values) {
    char one[80];
    std::snprintf(one, sizeof one, "%s%s %.9g", text.empty() ? "" : ", ", name, value);
    text += one;
  }
  return text;
}

}  // namespace airlight
