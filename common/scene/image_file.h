// Image files in and out, through OpenImageIO.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/image.h"
#include "common/rows.h"

namespace airlight {

struct ImageFileOptions {
  double exposure = 0;                                        // [stops], for formats of 8 or 16 bits
  std::string tonemap = "clip";                               // clip | reinhard, for those formats
  std::vector<std::pair<std::string, std::string>> metadata;  // name, value; nothing that changes from run to run
};

// Writes one image (1 or 3 channels): the extension says the format (EXR, PFM ... float linear; PNG, JPEG ... exposure, tone map,
// sRGB curve, round half up). The file appears under its name only when complete (temporary name in the same folder, then
// renamed), its bytes depend on nothing but the arguments. Throws InputError for an unknown format or a folder that cannot be
// written, MachineError when the disk is full.
void write_image(const std::string& path, const HostImage&, const ImageFileOptions&);

// Writes several images of one extent, as write_image() does. EXR: one file, the first image in the channels R G B (or Y), each
// other in NAME.R ... Other formats: one file an image, the first as `path`, each other with its name before the extension
// (fog.depth.png); none appears before all are complete. Returns the names of the files.
std::vector<std::string> write_images(const std::string& path, std::span<const NamedImage>, const ImageFileOptions&);

// What write_images() would refuse of a path and options, before the work of making an image. Throws InputError.
void check_image_path(const std::string& path, const ImageFileOptions&);

// Why the files of `path` are not what ImageWriter (common/scene/image_writer.h) would make of these rows of images of these
// names and this size; empty where they are, as far as is told by: all files are there and readable to the last pixel, their size
// and rows, their images' names (EXR), and their metadata where the format has kept it (EXR, PNG).
std::string difference_from_written(const std::string& path, std::span<const std::string> images, Extent, Rows,
                                    const ImageFileOptions&);

// Reads every channel as 32-bit float. Throws InputError.
HostImage read_image(const std::string& path);

// Reads the images of a file apart: channels "NAME.R" belong to NAME, those without a dot to "". R G B X Y Z come in this order.
std::vector<NamedImage> read_images(const std::string& path);

// Removes what an interrupted write_image may have left behind; async-signal-safe not required.
void remove_temporaries() noexcept;

}  // namespace airlight
