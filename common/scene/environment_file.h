// Environments out of image files.
#pragma once

#include <memory>
#include <string>

#include "common/image.h"

namespace airlight {

struct EnvironmentFile {
  std::shared_ptr<const HostImage> image;  // as Environment::image wants it
  std::string content_hash;                // SHA-256 of the file's bytes
};

inline constexpr int widest_environment = 8192;  // [pixel]

// An EXR or HDR file of latitude and longitude with channels R, G and B, others are left out. Throws InputError "path: ..." for
// what is no such file or a damaged one; for an image that is not twice as wide as high, 4 to widest_environment pixels; for a
// value that is negative or not finite, saying where.
EnvironmentFile read_environment_file(const std::string& path);

}  // namespace airlight
