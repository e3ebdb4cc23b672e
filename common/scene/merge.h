// Tiles of a picture (`airlight render --tile`), put together.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/progress.h"
#include "common/scene/image_file.h"

namespace airlight {

// Metadata of a tile, "2/8" for the second of eight bands of rows; all else that its file tells is what the picture's would.
constexpr std::string_view tile_key = "airlight:tile";

// Writes the picture that the tiles are of, which has the bytes that ImageWriter gives a picture rendered at once. No more than a
// few rows of it are in memory. Tone map and exposure are taken from the options, metadata from the tiles. Throws InputError, and
// writes nothing, where files are not tiles of one picture: of another scene, version, technique, setting or size, rows that are
// in none of them or in two, a file that is damaged or ends too early. Returns the names of the files.
std::vector<std::string> merge_tiles(std::span<const std::string> tiles, const std::string& output, const ImageFileOptions&,
                                     Progress&);

}  // namespace airlight
