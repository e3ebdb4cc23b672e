#include "common/scene/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/pfm.h"
#include "common/scene/temporary_file.h"
#include "common/scene/tonemap.h"

namespace airlight {

namespace {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

std::string lower_extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return e.empty() ? e : e.substr(1);
}

// Formats that hold 32-bit floats, and those of 8 bits that get a tone map. Others would need a decision of their own.
bool holds_floats(const std::string& extension) {
  static const std::set<std::string> known{"exr", "pfm", "tif", "tiff", "hdr"};
  return known.contains(extension);
}
bool holds_bytes(const std::string& extension) {
  static const std::set<std::string> known{"png", "jpg", "jpeg", "bmp", "tga", "ppm"};
  return known.contains(extension);
}

OIIO::ImageSpec spec_for(const HostImage& image, const std::string& extension, const ImageFileOptions& options) {
  const bool floats = holds_floats(extension);
  OIIO::ImageSpec spec(image.extent.width, image.extent.height, image.channels,
                       floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  if (image.channels == 1) spec.channelnames = {"Y"};
  spec.attribute("oiio:ColorSpace", floats ? "Linear" : "sRGB");
  // OpenImageIO stores the time of day (DateTime, EXR's capDate) unless there is one; Software would tell its version.
  spec.attribute("DateTime", "2000:01:01 00:00:00");
  spec.attribute("Software", "airlight");
  if (extension == "exr") spec.attribute("compression", "zip");
  if (extension == "png") spec.attribute("png:compressionLevel", 6);
  if (extension == "jpg" || extension == "jpeg") spec.attribute("Compression", "jpeg:95");
  for (const auto& [name, value] : options.metadata) spec.attribute(name, value);
  return spec;
}

void check(const std::string& path, const HostImage& image, const ImageFileOptions& options) {
  if (image.extent.width < 1 || image.extent.height < 1 || image.extent.width > 65535 || image.extent.height > 65535) {
    throw InputError(fmt::format("{}: an image of {} x {} pixels, expected 1..65535 a side", path, image.extent.width,
                                 image.extent.height));
  }
  if (image.channels != 1 && image.channels != 3)
    throw InputError(fmt::format("{}: {} channels, expected 1 or 3", path, image.channels));
  if (image.values.size() != image.index(0, image.extent.height))
    throw InputError(path + ": the image has not as many values as its size says");
  const std::string extension = lower_extension(path);
  if (!holds_floats(extension) && !holds_bytes(extension)) {
    throw InputError(fmt::format(
        "{}: unknown image format \"{}\", expected exr, pfm, tif, hdr, png, jpg, bmp, tga or ppm", path, extension));
  }
  if (options.tonemap != "clip" && options.tonemap != "reinhard") {
    throw InputError(fmt::format("unknown tone map \"{}\", expected clip or reinhard", options.tonemap));
  }
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(path + ": is a directory, expected a file name");
}

// The whole file in memory: written by ourselves, so that what a full disk answers is known.
std::vector<unsigned char> encoded(const std::string& path, const HostImage& image, const ImageFileOptions& options) {
  const std::string extension = lower_extension(path);
  if (extension == "pfm") return encoded_pfm(image);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("image." + extension);
  if (!output || !output->supports("ioproxy")) {
    throw MachineError(fmt::format("{}: the OpenImageIO of this machine cannot write {} files", path, extension));
  }
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  output->set_ioproxy(&memory);
  bool good = output->open("image." + extension, spec_for(image, extension, options));
  if (holds_floats(extension)) {
    good = good && output->write_image(OIIO::TypeDesc::FLOAT, image.values.data());
  } else {
    good = good && output->write_image(OIIO::TypeDesc::UINT8,
                                       tone_mapped(image, options.exposure, options.tonemap == "reinhard").data());
  }
  good = output->close() && good;
  if (!good) throw MachineError(fmt::format("{}: encoding failed: {}", path, one_line(output->geterror())));
  return bytes;
}

}  // namespace

void write_image(const std::string& path, const HostImage& image, const ImageFileOptions& options) {
  check(path, image, options);
  TemporaryFile file(path);  // first: a folder that cannot be written should not cost the encoding
  const std::vector<unsigned char> bytes = encoded(path, image, options);
  file.write(bytes.data(), bytes.size());
  file.rename_to_target();
}

HostImage read_image(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(path + ": no such file");
  if (status.type() == std::filesystem::file_type::directory)
    throw InputError(path + ": is a directory, expected an image file");
  if (lower_extension(path) == "pfm") return decoded_pfm(path, read_file(path, std::uint64_t{1} << 36U));
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
  if (!input) throw InputError(fmt::format("{}: not a readable image: {}", path, one_line(OIIO::geterror())));
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.width > 65535 || spec.height > 65535 ||
      spec.nchannels < 1 || spec.nchannels > 64) {
    throw InputError(fmt::format("{}: {} x {} pixels, {} channels; expected 1..65535 a side, 1..64 channels", path,
                                 spec.width, spec.height, spec.nchannels));
  }
  HostImage image({spec.width, spec.height}, spec.nchannels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.values.data())) {
    throw InputError(fmt::format("{}: reading failed: {}", path, one_line(input->geterror())));
  }
  return image;
}

}  // namespace airlight
