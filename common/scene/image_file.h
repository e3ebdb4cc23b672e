// Image files in and out, through OpenImageIO.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/image.h"

namespace airlight {

struct ImageFileOptions {
  double exposure = 0;             // [stops], for formats of 8 or 16 bits
  std::string tonemap = "clip";    // clip | reinhard, for those formats
  std::vector<std::pair<std::string, std::string>> metadata;  // name, value; nothing that changes from run to run
};

// Writes one image: the extension says the format (EXR, PFM ... float linear; PNG, JPEG ... exposure, tone map, sRGB curve, round half up).
// The file appears under its name only when complete (temporary name in the same folder, then renamed), its bytes depend on nothing but
// the arguments. Throws InputError for an unknown format or a folder that cannot be written, MachineError when the disk is full.
void write_image(const std::string& path, const HostImage&, const ImageFileOptions&);

// Reads every channel as 32-bit float. Throws InputError.
HostImage read_image(const std::string& path);

// Removes what an interrupted write_image may have left behind; async-signal-safe not required.
void remove_temporaries() noexcept;

}  // namespace airlight
