// Parts of frames, for many machines: which rows a tile has, and the commands that render and merge all of them.
#pragma once

#include <optional>
#include <string>

#include "app/command.h"

namespace airlight {

// "2/8". Throws InputError.
TileNumber tile_of(const std::string& text);

// The tile's rows of an image of that height; all rows without a tile. Throws InputError where there are fewer rows than tiles.
Rows rows_of(const std::optional<TileNumber>&, int height);

// A tile's file beside the output that it is a part of: fog.####.png, 2/8: fog.####.tile-2-of-8.exr.
std::string tile_name(const std::string& output, TileNumber);

// `text` as one word of a shell: 'as it is'.
std::string shell_word(const std::string& text);

}  // namespace airlight
