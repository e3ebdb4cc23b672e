// What writing and reading of image files have in common: formats by extension, names of channels and files.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/scene/image_file.h"

namespace airlight {

// Rows that are written or read at once: a multiple of what EXR packs together.
constexpr int rows_at_once = 64;

// Without what would break a line.
std::string one_line(std::string text);

std::string lower_extension(const std::string& path);

// Formats that hold 32-bit floats, and those of 8 bits that get a tone map. Others would need a decision of their own.
bool holds_floats(const std::string& extension);
bool holds_bytes(const std::string& extension);

// Of an image; its name is empty where the file does not tell it.
std::vector<std::string> channel_names(const std::string& image, int channels);

// Of an image that is not the first, in formats of one image a file.
std::string file_of_image(const std::string& path, const std::string& image);

// All that tells what the pixels come from, by name; of tone-mapped ones more than of floats.
std::vector<std::pair<std::string, std::string>> metadata_of(const std::string& extension, const ImageFileOptions&);

}  // namespace airlight
