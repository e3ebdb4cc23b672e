// PFM, the plain float map: a three-line header and rows from the bottom to the top. OpenImageIO reads it but writes
// none.
#pragma once

#include <string>
#include <string_view>

#include "common/image.h"

namespace airlight {

class TemporaryFile;

// Writes rows of an image of that extent, from `first` on, at their place in its file: 1 or 3 channels, little-endian. The header
// comes with row 0.
void write_pfm_rows(TemporaryFile&, const HostImage& rows, int first, Extent);

// Either byte order. Throws InputError "path: ..." with the byte where the file ends too early.
HostImage decoded_pfm(const std::string& path, std::string_view bytes);

}  // namespace airlight
