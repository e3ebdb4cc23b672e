// What can be said of a mesh file's bytes before memory is taken for its content.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace airlight {

constexpr std::uint64_t most_triangles = 50'000'000;

// Holds the counts that the file declares against its size and the limits, and the lines of an OBJ against each other.
// Throws InputError with the line, or the byte where a binary file ends too early. `extension` in lower case, with its
// dot. Formats without a check pass.
void check_mesh_bytes(const std::string& path, std::string_view extension, std::string_view bytes);

// The lines of an OBJ: coordinates are numbers, faces have three or more vertices, which exist.
void check_obj(const std::string& path, std::string_view bytes);

// Throws InputError beyond most_triangles.
void check_triangle_count(const std::string& path, std::uint64_t triangles);

}  // namespace airlight
