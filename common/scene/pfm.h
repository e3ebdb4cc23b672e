// PFM, the plain float map: a three-line header and rows from the bottom to the top. OpenImageIO reads it but writes
// none.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/image.h"

namespace airlight {

// 1 or 3 channels, little-endian.
std::vector<unsigned char> encoded_pfm(const HostImage&);

// Either byte order. Throws InputError "path: ..." with the byte where the file ends too early.
HostImage decoded_pfm(const std::string& path, std::string_view bytes);

}  // namespace airlight
