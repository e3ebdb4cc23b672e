#include "common/scene/image_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace airlight {

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

bool holds_floats(const std::string& extension) {
  static const std::set<std::string> known{"exr", "pfm", "tif", "tiff", "hdr"};
  return known.contains(extension);
}

bool holds_bytes(const std::string& extension) {
  static const std::set<std::string> known{"png", "jpg", "jpeg", "bmp", "tga", "ppm"};
  return known.contains(extension);
}

std::vector<std::string> channel_names(const std::string& image, int channels) {
  const std::string before = image.empty() ? "" : image + ".";
  if (channels == 1) return {before + "Y"};
  return {before + "R", before + "G", before + "B"};
}

std::string file_of_image(const std::string& path, const std::string& image) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() / whole.stem()).string() + "." + image + whole.extension().string();
}

std::vector<std::pair<std::string, std::string>> metadata_of(const std::string& extension, const ImageFileOptions& options) {
  auto all = options.metadata;
  if (!holds_floats(extension)) {
    all.emplace_back("airlight:exposure", fmt::format("{}", options.exposure));
    all.emplace_back("airlight:tonemap", options.tonemap);
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace airlight
