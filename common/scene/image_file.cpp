#include "common/scene/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/image_format.h"
#include "common/scene/image_reader.h"
#include "common/scene/image_writer.h"

namespace airlight {

void check_image_path(const std::string& path, const ImageFileOptions& options) {
  const std::string extension = lower_extension(path);
  if (!holds_floats(extension) && !holds_bytes(extension)) {
    throw InputError(
        fmt::format("{}: unknown image format \"{}\", expected exr, pfm, tif, hdr, png, jpg, bmp, tga or ppm", path, extension));
  }
  if (options.tonemap != "clip" && options.tonemap != "reinhard") {
    throw InputError(fmt::format("unknown tone map \"{}\", expected clip or reinhard", options.tonemap));
  }
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(path + ": is a directory, expected a file name");
  if (!std::filesystem::is_directory(folder_of(path), error)) throw InputError(path + ": there is no folder " + folder_of(path));
}

void write_image(const std::string& path, const HostImage& image, const ImageFileOptions& options) {
  const NamedImage only{"", image};
  write_images(path, std::span(&only, 1), options);
}

std::vector<std::string> write_images(const std::string& path, std::span<const NamedImage> images,
                                      const ImageFileOptions& options) {
  std::vector<ImageWriter::Layer> layers;
  for (const NamedImage& i : images) {
    if (!(i.image.extent == images[0].image.extent)) throw InputError(path + ": images of different sizes");
    layers.push_back({i.name, i.image.channels});
  }
  ImageWriter writer(path, layers, images.empty() ? Extent{} : images[0].image.extent, {}, options);
  writer.write(images);
  return writer.finish();
}

HostImage read_image(const std::string& path) {
  const ImageReader file(path);
  return file.read(file.rows());
}

std::vector<NamedImage> read_images(const std::string& path) {
  const ImageReader file(path);
  return images_of(file.read(file.rows()), layers_of(file.channels()));
}

std::string difference_from_written(const std::string& path, std::span<const std::string> images, Extent extent, Rows wanted,
                                    const ImageFileOptions& options) {
  const std::string extension = lower_extension(path);
  const bool one_file = extension == "exr";
  const auto expected = metadata_of(extension, options);
  const Rows rows = within(wanted, extent.height);
  for (std::size_t k = 0; k < (one_file ? 1 : images.size()); ++k) {
    const std::string name = k == 0 ? path : file_of_image(path, images[k]);
    try {
      const ImageReader file(name);
      const std::vector<ImageLayer> there = layers_of(file.channels());
      const auto has = [&](const std::string& image) {
        return std::any_of(there.begin(), there.end(), [&](const ImageLayer& l) { return l.name == image; });
      };
      if (!(file.extent() == extent)) return name + ": of another size";
      if (!(file.rows() == rows)) return name + ": of other rows";
      if (one_file && (there.size() != images.size() || !std::all_of(images.begin() + 1, images.end(), has)))
        return name + ": of other images";
      for (const auto& [key, value] : expected) {
        const auto found = file.metadata().find(key);
        if (file.metadata().empty()) break;  // PFM has none
        if (found == file.metadata().end() || found->second != value)
          return fmt::format("{}: of another {}", name, key.substr(key.rfind(':') + 1));
      }
      for (int y = rows.first; y < rows.end; y += rows_at_once) (void)file.read({y, std::min(y + rows_at_once, rows.end)});
    } catch (const InputError& e) {
      return e.what();
    }
  }
  return "";
}

}  // namespace airlight
