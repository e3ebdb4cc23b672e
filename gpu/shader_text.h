// Shader files, and the formula files that they include, are part of the program; a shader's text is put together from them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airlight {

struct ShaderText {
  std::string text;                // with #version, #define and #line
  std::vector<std::string> files;  // by the source number of #line
};

// A file by its name from the source root ("gpu/compose.glsl"), or nothing.
using ShaderFile = std::function<std::optional<std::string_view>(std::string_view name)>;
std::optional<std::string_view> embedded_shader_file(std::string_view name);

// `defines`: "NAME" or "NAME value". Lines #include "file" are replaced by that file. Throws std::logic_error for a file that is
// not there or includes itself, with the place of the #include.
ShaderText shader_text(std::string_view file, const std::vector<std::string>& defines = {},
                       const ShaderFile& find = embedded_shader_file);

// A compiler's log with its source numbers replaced by file names: "0:12(5): error" and "0(12) : error" become
// "gpu/compose.glsl:12".
std::string with_file_names(std::string_view log, const std::vector<std::string>& files);

}  // namespace airlight
