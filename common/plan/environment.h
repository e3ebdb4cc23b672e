// The environment's light as the kernels take it (common/formulas/environment.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/algorithms/environment_light.h"
#include "common/plan/zonal.h"
#include "common/scene/scene.h"

namespace airlight {

// Coefficients of red, green and blue [W/m^2/sr], of order 6, about +Y as their axis, azimuths from -Z toward +X.
using EnvironmentHarmonics = std::array<std::array<double, 36>, 3>;

// The table of environment_value().
std::vector<float> environment_image(const Environment&);

// The projection of the radiance that environment_value() gives onto the harmonics.
EnvironmentHarmonics environment_harmonics(const Environment&);

// The table of EnvironmentLight, and how many floats it is.
std::size_t environment_table_floats(const Environment&, std::size_t shininess, std::size_t brdfs);
std::vector<float> environment_table(const Environment&, std::span<const float> shininess,
                                     std::span<const std::shared_ptr<const Brdf>> brdfs = {});

// The table of EnvironmentAirlight: the environment convolved with a function of the angle between ways before and after; 36
// floats a channel.
std::vector<float> environment_airlight_table(const Environment&, const Zonal&);

// The table of EnvironmentIndirect: the same convolved with each lobe, with the lobes' shares above a horizon.
std::vector<float> environment_indirect_table(const Environment&, std::span<const float> shininess, const Zonal&);

// Of everything that the table depends on.
std::uint64_t environment_key(const Environment&, std::span<const float> shininess);

}  // namespace airlight
