// What the numbers of a scene may be. The ends leave room for the squares and products that single precision makes of
// them.
#pragma once

#include "common/scene/reader.h"

namespace airlight::limits {

inline constexpr double farthest = 1e9;  // [m]

inline constexpr Range coordinate{-farthest, farthest, "m"};
inline constexpr Range component{-1e9, 1e9, ""};  // of a direction or a matrix
inline constexpr Range length{0, farthest, "m", true};
inline constexpr Range radius{1e-6, 1e6, "m"};
inline constexpr Range extinction{0, 1e6, "1/m"};
inline constexpr Range noise_scale{1e-6, 1e6, "m"};
inline constexpr Range noise_offset{-1e9, 1e9, "cells"};
inline constexpr Range fraction{0, 1, ""};
inline constexpr Range factor{0, 1e12, ""};
inline constexpr Range radiance{0, 1e12, "W/m^2/sr"};
inline constexpr Range emission{0, 1e12, "W/m^3/sr"};
inline constexpr Range intensity{0, 1e12, "W/sr"};
inline constexpr Range irradiance{0, 1e12, "W/m^2"};
inline constexpr Range field_of_view{0.01, 179, "degree"};
inline constexpr Range asymmetry{-0.99, 0.99, ""};
inline constexpr Range shininess{0, 1e4, ""};
inline constexpr Range degrees{-36000, 36000, "degree"};
// Koschmieder 1924: the distance at which a dark object keeps 2 % of contrast; ln(50) = 3.912.
inline constexpr double koschmieder = 3.912;

inline constexpr int most_pixels = 65535;  // a side

}  // namespace airlight::limits
