#include "common/scene/environment_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/sha256.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30U;  // four times the pixels of the largest image

std::string first_line(const std::string& text) { return text.substr(0, text.find_first_of("\r\n")); }

// Which of the file's channels are red, green and blue.
std::array<int, 3> channels_of(const std::string& path, const OIIO::ImageSpec& spec) {
  std::array<int, 3> found{};
  for (std::size_t c = 0; c < 3; ++c) {
    found[c] = spec.channelindex(std::string_view("RGB").substr(c, 1));
    if (found[c] < 0) throw InputError(fmt::format("{}: no channel {}, expected R, G and B", path, "RGB"[c]));
  }
  return found;
}

void check_shape(const std::string& path, const OIIO::ImageSpec& spec) {
  if (spec.depth > 1 || spec.width != 2 * spec.height || spec.width < 4) {
    throw InputError(
        fmt::format("{}: {} x {} pixels, expected twice as many columns as rows, at least 4 x 2", path, spec.width, spec.height));
  }
  if (spec.width > widest_environment) {
    throw InputError(
        fmt::format("{}: {} x {} pixels, expected at most {} columns", path, spec.width, spec.height, widest_environment));
  }
}

void check_values(const std::string& path, const HostImage& image) {
  for (int y = 0; y < image.extent.height; ++y) {
    for (int x = 0; x < image.extent.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float v = image.at(x, y, c);
        if (!std::isfinite(v) || v < 0) {
          throw InputError(
              fmt::format("{}: {} in channel {} of the pixel in column {}, row {}, expected a finite number of at least 0", path,
                          v, "RGB"[c], x, y));
        }
      }
    }
  }
}

}  // namespace

EnvironmentFile read_environment_file(const std::string& path) {
  EnvironmentFile file;
  Sha256 hash;
  hash.add(read_file(path, most_bytes));
  file.content_hash = hash.hex();
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".exr" && extension != ".hdr") throw InputError(path + ": expected an EXR or HDR file");
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
  if (!input) throw InputError(fmt::format("{}: not a readable image: {}", path, first_line(OIIO::geterror())));
  const OIIO::ImageSpec spec = input->spec();
  check_shape(path, spec);
  const std::array<int, 3> channels = channels_of(path, spec);
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  auto image = std::make_shared<HostImage>(Extent{spec.width, spec.height}, 3);
  std::vector<float> plane(pixels);
  for (std::size_t c = 0; c < 3; ++c) {
    if (!input->read_image(0, 0, channels[c], channels[c] + 1, OIIO::TypeDesc::FLOAT, plane.data())) {
      throw InputError(fmt::format("{}: reading failed: {}", path, first_line(input->geterror())));
    }
    for (std::size_t k = 0; k < pixels; ++k) image->values[3 * k + c] = plane[k];
  }
  check_values(path, *image);
  file.image = std::move(image);
  return file;
}

}  // namespace airlight
