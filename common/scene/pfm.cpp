#include "common/scene/pfm.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "common/error.h"
#include "common/scene/temporary_file.h"

namespace airlight {

namespace {

std::uint32_t swapped(std::uint32_t v) { return v >> 24U | (v >> 8U & 0xFF00U) | (v << 8U & 0xFF0000U) | v << 24U; }

// The next word of the header; its end is followed by exactly one blank.
std::string_view next_word(std::string_view bytes, std::size_t& at) {
  const auto blank = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; };
  while (at < bytes.size() && blank(bytes[at])) ++at;
  const std::size_t begin = at;
  while (at < bytes.size() && !blank(bytes[at])) ++at;
  return bytes.substr(begin, at - begin);
}

template <class T>
T number(const std::string& path, std::string_view bytes, std::size_t& at, std::string_view what) {
  const std::string_view word = next_word(bytes, at);
  T v{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), v);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw InputError(fmt::format("{}: byte {}: expected the {} of a PFM header", path, at - word.size(), what));
  }
  return v;
}

}  // namespace

void write_pfm_rows(TemporaryFile& file, const HostImage& rows, int first, Extent extent) {
  static_assert(std::endian::native == std::endian::little);
  const std::string header = fmt::format("{}\n{} {}\n-1.0\n", rows.channels == 3 ? "PF" : "Pf", extent.width, extent.height);
  if (first == 0) file.write_at(0, header.data(), header.size());
  const std::size_t row = rows.index(0, 1) * sizeof(float);
  for (int y = 0; y < rows.extent.height; ++y) {
    const auto from_bottom = static_cast<std::size_t>(extent.height - 1 - first - y);
    file.write_at(header.size() + from_bottom * row, rows.values.data() + rows.index(0, y), row);
  }
}

HostImage decoded_pfm(const std::string& path, std::string_view bytes) {
  std::size_t at = 0;
  const std::string_view magic = next_word(bytes, at);
  if (magic != "PF" && magic != "Pf") throw InputError(path + ": byte 0: expected PF or Pf, the mark of a PFM file");
  const int width = number<int>(path, bytes, at, "width"), height = number<int>(path, bytes, at, "height");
  const auto scale = number<double>(path, bytes, at, "scale");
  if (width < 1 || height < 1 || width > 65535 || height > 65535) {
    throw InputError(fmt::format("{}: {} x {} pixels, expected 1..65535 a side", path, width, height));
  }
  ++at;  // the blank after the scale
  const int channels = magic == "PF" ? 3 : 1;
  const std::size_t row = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels) * sizeof(float);
  const std::size_t end = at + row * static_cast<std::size_t>(height);
  if (bytes.size() < end)
    throw InputError(
        fmt::format("{}: ends at byte {}, expected {} x {} pixels to end at byte {}", path, bytes.size(), width, height, end));
  HostImage image({width, height}, channels);
  for (int y = height; y-- > 0; at += row) std::memcpy(image.values.data() + image.index(0, y), bytes.data() + at, row);
  if (scale > 0) {  // the sign of the scale says the byte order
    for (float& v : image.values) v = std::bit_cast<float>(swapped(std::bit_cast<std::uint32_t>(v)));
  }
  return image;
}

}  // namespace airlight
