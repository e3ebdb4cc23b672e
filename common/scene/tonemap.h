// Linear radiance to 8-bit display values.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image.h"

namespace airlight {

// v = value * 2^exposure, clipped to 0..1 or v / (1 + v) (Reinhard et al. 2002, eq. 3, a channel at a time), the sRGB
// curve (IEC 61966-2-1), times 255, rounded half up. NaN becomes 0.
std::vector<std::uint8_t> tone_mapped(const HostImage&, double exposure, bool reinhard);

}  // namespace airlight
