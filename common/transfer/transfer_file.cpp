#include "common/transfer/transfer_file.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "common/scene/sha256.h"
#include "common/scene/temporary_file.h"

namespace airlight {

namespace {

// The file: this line, the content and a line's end; a number that tells the order of bytes; how long each list of
// SurfaceTransfer is; the lists; the checksum of all that.
constexpr std::string_view magic = "airlight transfer 1\n";
constexpr std::uint64_t order_of_bytes = 0x0102030405060708U;
constexpr std::size_t digits = 64;

template <class Transfer, class Visit>
void lists(Transfer& t, Visit&& visit) {
  visit(t.midpoints), visit(t.triangles), visit(t.record), visit(t.records);
}

template <class T>
std::string_view bytes_of(const T* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}

bool fits(const SurfaceTransfer& t, const Scene& scene) {
  std::size_t own = 0;
  for (const Surface& s : scene.surfaces) own += s.mesh->positions.size();
  const std::size_t records = t.records.size() / SurfaceTransfer::record_floats;
  if (t.record.size() != 2 * (own + t.midpoints.size()) || t.records.size() % SurfaceTransfer::record_floats != 0) return false;
  for (std::size_t i = 0; i < t.midpoints.size(); ++i) {
    if (std::max(t.midpoints[i].x, t.midpoints[i].y) >= own + i) return false;
  }
  const bool known = std::all_of(t.record.begin(), t.record.end(),
                                 [&](std::uint32_t r) { return r < records || r >= SurfaceTransfer::everything; });
  return known && std::all_of(t.triangles.begin(), t.triangles.end(), [&](const glm::uvec4& c) {
           return std::max({c.x, c.y, c.z}) < t.vertices() && c.w < scene.surfaces.size();
         });
}

}  // namespace

std::string transfer_content(const Scene& scene, int rays) {
  Sha256 content;
  const auto add = [&](const auto& values) { content.add(std::as_bytes(std::span(values))); };
  const auto number = [&](std::uint64_t n) { content.add(bytes_of(&n, 1)); };
  content.add(magic);
  number(static_cast<std::uint64_t>(rays));
  for (const Surface& s : scene.surfaces) {
    content.add(bytes_of(&s.transform[0][0], 16));
    number(s.casts_shadow ? 1 : 0);
    number(s.mesh->positions.size()), add(s.mesh->positions), add(s.mesh->normals);
    number(s.mesh->triangles.size()), add(s.mesh->triangles);
  }
  return content.hex();
}

std::string transfer_path(const std::string& content) {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  std::filesystem::path cache = variable("XDG_CACHE_HOME");
  if (!cache.is_absolute()) {
    const std::filesystem::path home = variable("HOME");
    if (!home.is_absolute()) return "";
    cache = home / ".cache";
  }
  return (cache / "airlight" / (content.substr(0, 16) + ".transfer")).string();
}

std::optional<SurfaceTransfer> read_transfer(const std::string& path, const std::string& content, const Scene& scene) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return std::nullopt;
  const auto size = static_cast<std::size_t>(std::max<std::streamoff>(file.tellg(), 0));
  constexpr std::size_t head = magic.size() + digits + 1 + 5 * sizeof(std::uint64_t);
  if (size < head + digits) return std::nullopt;
  std::vector<char> bytes(size);
  file.seekg(0);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) return std::nullopt;
  const std::string_view all(bytes.data(), size);
  if (!all.starts_with(std::string(magic) + content + "\n")) return std::nullopt;
  std::uint64_t numbers[5];
  std::memcpy(numbers, all.data() + head - sizeof numbers, sizeof numbers);
  if (numbers[0] != order_of_bytes) return std::nullopt;

  SurfaceTransfer transfer;
  std::size_t at = head, n = 1;
  bool whole = true;
  lists(transfer, [&](auto& list) {
    const std::size_t one = sizeof list[0], count = numbers[n++];
    whole = whole && count <= (size - digits - at) / one;
    if (!whole) return;
    list.resize(count);
    if (count > 0) std::memcpy(list.data(), all.data() + at, count * one);
    at += count * one;
  });
  if (!whole || at + digits != size) return std::nullopt;
  Sha256 checksum;
  checksum.add(all.substr(0, at));
  if (checksum.hex() != all.substr(at) || !fits(transfer, scene)) return std::nullopt;
  return transfer;
}

void write_transfer(const std::string& path, const std::string& content, const SurfaceTransfer& transfer) {
  std::error_code told_by_the_file;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), told_by_the_file);
  TemporaryFile file(path);
  Sha256 checksum;
  const auto write = [&](std::string_view part) {
    checksum.add(part);
    file.write(part.data(), part.size());
  };
  write(magic), write(content), write("\n");
  write(bytes_of(&order_of_bytes, 1));
  lists(transfer, [&](const auto& list) {
    const std::uint64_t count = list.size();
    write(bytes_of(&count, 1));
  });
  lists(transfer, [&](const auto& list) { write(bytes_of(list.data(), list.size())); });
  const std::string hex = checksum.hex();
  file.write(hex.data(), hex.size());
  file.rename_to_target();
}

}  // namespace airlight
