// Tabulated reflectances out of files.
#pragma once

#include <memory>
#include <string>

#include "common/scene/scene.h"

namespace airlight {

struct BrdfFile {
  std::shared_ptr<const Brdf> brdf;
  Material material;         // brdf_material()
  std::string content_hash;  // SHA-256 of the file's bytes
};

inline constexpr int most_brdf_cells = 1024;                // an axis
inline constexpr int most_brdf_values = 4 * 90 * 90 * 180;  // of a colour: four times those of the MERL database

// A file as the MERL database has them: three little-endian integers of 32 bits, the numbers of cells of theta_half,
// theta_difference and phi_difference, then as many doubles for each of red, green and blue, phi_difference fastest; the
// reflectance [1/sr] is those times 1/1500, 1.15/1500 and 1.66/1500. A negative value was not measured: the nearest one of a
// smaller theta_difference stands for it, 0 where there is none. Throws InputError "path: ..." for another number of bytes than
// the header tells, for numbers of cells outside 2..most_brdf_cells or more than most_brdf_values in all, for values that are not
// finite or above 1e6 /sr, saying where.
BrdfFile read_brdf_file(const std::string& path);

}  // namespace airlight
