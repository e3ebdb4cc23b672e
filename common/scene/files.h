// Files as bytes, with their hashes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace airlight {

// Reads a whole file. Throws InputError "path: ..." when it is missing, a directory, unreadable, or larger than `most`
// bytes.
std::string read_file(const std::string& path, std::uint64_t most);

// `named` as it stands in a file of `directory`: absolute, or relative to it.
std::string resolved(const std::string& directory, const std::string& named);

// The folder of a path, "." for a bare name.
std::string folder_of(const std::string& path);

}  // namespace airlight
