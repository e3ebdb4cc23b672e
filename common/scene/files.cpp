#include "common/scene/files.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "common/error.h"

namespace airlight {

std::string read_file(const std::string& path, std::uint64_t most) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(path + ": no such file");
  if (status.type() == std::filesystem::file_type::directory) throw InputError(path + ": is a directory, expected a file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) throw InputError(fmt::format("{}: cannot be read: {}", path, std::generic_category().message(errno)));

  // A pipe has no size, so the end is where reading ends; a regular file's size is checked before memory is taken for
  // it.
  std::string bytes;
  if (status.type() == std::filesystem::file_type::regular) {
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > most) throw InputError(fmt::format("{}: {} bytes, expected at most {}", path, size, most));
    if (!error) bytes.reserve(static_cast<std::size_t>(size) + 1);
  }
  for (std::size_t got = 1; got > 0;) {
    const std::size_t before = bytes.size();
    const std::size_t room = std::max<std::size_t>(bytes.capacity() - before, 1U << 16U);
    bytes.resize(before + room);
    got = std::fread(bytes.data() + before, 1, room, file.get());
    bytes.resize(before + got);
    if (bytes.size() > most) throw InputError(fmt::format("{}: expected at most {} bytes", path, most));
  }
  if (std::ferror(file.get()) != 0) throw InputError(path + ": reading failed");
  return bytes;
}

std::string resolved(const std::string& directory, const std::string& named) {
  return (std::filesystem::path(directory) / named).lexically_normal().string();
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace airlight
