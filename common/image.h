// Handles to what a backend holds: screen images and buffers. A handle is a name with a shape, never a pointer or a GL name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace airlight {

// Identity of an image or buffer inside one plan; 0 is "absent" (an optional input or output that is not wanted).
struct Handle {
  std::uint32_t id = 0;
  explicit operator bool() const { return id != 0; }
  friend auto operator<=>(const Handle&, const Handle&) = default;
};

struct Extent {
  int width = 0, height = 0;  // pixels
  friend bool operator==(const Extent&, const Extent&) = default;
};

enum class Format : std::uint8_t { r32f = 1, rgb32f = 3 };  // the value is the number of 32-bit float channels

constexpr int channels(Format f) { return static_cast<int>(f); }

// A screen image. On the host side (upload, download) the layout is layer by layer, rows from the top, pixels from the left,
// channels interleaved, 32-bit floats. `keep` means that it can be downloaded; otherwise it lives only as long as the steps
// that read it, and a backend may hold it a tile at a time.
struct Image : Handle {
  Format format = Format::r32f;
  Extent extent;
  int layers = 1;  // one per light where a step produces something per light
  bool keep = false;

  std::size_t floats() const {
    return static_cast<std::size_t>(extent.width) * static_cast<std::size_t>(extent.height) * static_cast<std::size_t>(layers) *
           static_cast<std::size_t>(channels(format));
  }
};

// An array of plain values: uploaded by the host, or made by a step and then kept, like an image with `keep`.
struct Buffer : Handle {
  std::size_t bytes = 0;
};

// An image that has come back to the host: rows from the top, channels interleaved, linear values.
struct HostImage {
  Extent extent;
  int channels = 0;
  std::vector<float> values;

  HostImage() = default;
  HostImage(Extent e, int c)
      : extent(e),
        channels(c),
        values(static_cast<std::size_t>(e.width) * static_cast<std::size_t>(e.height) * static_cast<std::size_t>(c)) {}
  std::size_t index(int x, int y, int c = 0) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(extent.width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels) +
           static_cast<std::size_t>(c);
  }
  float& at(int x, int y, int c = 0) { return values[index(x, y, c)]; }
  float at(int x, int y, int c = 0) const { return values[index(x, y, c)]; }
};

struct NamedImage {
  std::string name;
  HostImage image;
};

}  // namespace airlight
