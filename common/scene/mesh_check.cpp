#include "common/scene/mesh_check.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <vector>

#include "common/error.h"

namespace airlight {

namespace {

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < 4; ++i) v |= std::uint32_t{static_cast<std::uint8_t>(bytes[at + i])} << (8 * i);
  return v;
}

[[noreturn]] void ends_early(const std::string& path, std::size_t size, std::string_view what, std::uint64_t needed) {
  throw InputError(fmt::format("{}: ends at byte {}, expected {} to end at byte {}", path, size, what, needed));
}

void check_stl(const std::string& path, std::string_view bytes) {
  if (bytes.substr(0, 5) == "solid" && bytes.find("facet") != bytes.npos) return;  // text
  if (bytes.size() < 84) ends_early(path, bytes.size(), "the STL header", 84);
  const std::uint64_t triangles = little_endian(bytes, 80);
  check_triangle_count(path, triangles);
  if (bytes.size() < 84 + 50 * triangles) {
    ends_early(path, bytes.size(), fmt::format("{} triangles", triangles), 84 + 50 * triangles);
  }
}

void check_glb(const std::string& path, std::string_view bytes) {
  if (bytes.size() < 12) ends_early(path, bytes.size(), "the glTF header", 12);
  if (bytes.substr(0, 4) != "glTF") throw InputError(path + ": byte 0: expected the letters glTF");
  if (little_endian(bytes, 4) != 2) {
    throw InputError(fmt::format("{}: byte 4: glTF version {}, expected 2", path, little_endian(bytes, 4)));
  }
  const std::uint64_t length = little_endian(bytes, 8);
  if (bytes.size() < length) ends_early(path, bytes.size(), "the content", length);
  for (std::size_t at = 12; at < length;) {
    if (at + 8 > length) ends_early(path, bytes.size(), "a chunk's header", at + 8);
    const std::uint64_t end = at + 8 + std::uint64_t{little_endian(bytes, at)};
    if (end > length)
      throw InputError(fmt::format("{}: byte {}: a chunk to byte {}, expected its end before byte {}", path, at, end, length));
    at = static_cast<std::size_t>(end);
  }
}

std::size_t ply_size(std::string_view type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "double" || type == "float64") return 8;
  return 4;
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t at = line.find_first_not_of(" \t\r"); at != line.npos; at = line.find_first_not_of(" \t\r", at)) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    found.push_back(line.substr(at, end - at));
    at = end;
  }
  return found;
}

// The least size that the header's counts need; a list needs at least its count, a triangle its three indices.
void check_ply(const std::string& path, std::string_view bytes) {
  if (bytes.substr(0, 3) != "ply") throw InputError(path + ":1: expected the word ply");
  bool text = false;
  std::uint64_t count = 0, body = 0, line_number = 0;
  bool faces = false;
  std::size_t at = 0;
  for (;;) {
    const std::size_t end = bytes.find('\n', at);
    ++line_number;
    if (end == bytes.npos)
      throw InputError(fmt::format("{}:{}: the header ends at byte {}, expected end_header", path, line_number, bytes.size()));
    const std::vector<std::string_view> w = words(bytes.substr(at, end - at));
    at = end + 1;
    if (w.empty()) continue;
    if (w[0] == "end_header") break;
    if (w[0] == "format" && w.size() > 1) text = w[1] == "ascii";
    if (w[0] == "element") {
      const auto number = w.size() > 2 ? std::from_chars(w[2].data(), w[2].data() + w[2].size(), count)
                                       : std::from_chars_result{nullptr, std::errc::invalid_argument};
      if (number.ec != std::errc() || number.ptr != w[2].data() + w[2].size() || count > std::uint64_t{1} << 40U) {
        throw InputError(fmt::format("{}:{}: expected \"element NAME COUNT\"", path, line_number));
      }
      faces = w[1] == "face";
      if (faces) check_triangle_count(path, count);
      if (!faces && 3 * count >= std::uint64_t{1} << 33U)
        throw InputError(fmt::format("{}:{}: {} elements, expected fewer than 2^31", path, line_number, count));
    }
    if (w[0] == "property" && w.size() > 2) {
      const bool list = w[1] == "list" && w.size() > 3;
      const std::size_t each = list ? ply_size(w[2]) + (faces ? 3 * ply_size(w[3]) : 0) : ply_size(w[1]);
      body += count * (text ? 2 : each);
    }
  }
  if (text ? at + body > bytes.size() + 1 : at + body > bytes.size()) {
    ends_early(path, bytes.size(), "the elements of the header, at the least,", at + body);
  }
}

}  // namespace

void check_triangle_count(const std::string& path, std::uint64_t triangles) {
  if (triangles > most_triangles) {
    throw InputError(fmt::format("{}: {} triangles, expected at most {}", path, triangles, most_triangles));
  }
}

void check_mesh_bytes(const std::string& path, std::string_view extension, std::string_view bytes) {
  if (extension == ".obj") check_obj(path, bytes);
  if (extension == ".ply") check_ply(path, bytes);
  if (extension == ".stl") check_stl(path, bytes);
  if (extension == ".glb") check_glb(path, bytes);
}

}  // namespace airlight
