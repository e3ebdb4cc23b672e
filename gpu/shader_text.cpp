#include "gpu/shader_text.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace airlight {

namespace {

struct Assembly {
  const ShaderFile& find;
  ShaderText result;
  std::vector<std::string> open;  // files being read, outermost first

  void add(const std::string& file, const std::string& place) {
    const std::optional<std::string_view> content = find(file);
    if (!content) throw std::logic_error(place + ": there is no shader file \"" + file + "\"");
    if (std::find(open.begin(), open.end(), file) != open.end())
      throw std::logic_error(place + ": \"" + file + "\" includes itself");
    open.push_back(file);
    const std::size_t number = result.files.size();
    result.files.push_back(file);
    begin_line(1, number);
    int line = 0;
    for (std::string_view rest = *content; !rest.empty();) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view text = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      ++line;
      constexpr std::string_view include = "#include \"";
      if (text.substr(0, include.size()) == include) {
        const std::string_view name = text.substr(include.size());
        add(std::string(name.substr(0, name.find('"'))), file + ":" + std::to_string(line));
        begin_line(line + 1, number);
      } else {
        result.text.append(text).push_back('\n');
      }
    }
    open.pop_back();
  }

  void begin_line(int line, std::size_t number) {
    result.text += "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
  }
};

// Reads digits at `at`; npos if there are none.
std::size_t number_at(std::string_view s, std::size_t& at) {
  std::size_t value = 0;
  const std::size_t start = at;
  while (at < s.size() && at - start < 6 && std::isdigit(static_cast<unsigned char>(s[at])) != 0) {
    value = value * 10 + static_cast<std::size_t>(s[at++] - '0');
  }
  return at == start ? std::string_view::npos : value;
}

}  // namespace

ShaderText shader_text(std::string_view file, const std::vector<std::string>& defines, const ShaderFile& find) {
  Assembly assembly{find, {}, {}};
  assembly.result.text = "#version 450 core\n";
  for (const std::string& define : defines) assembly.result.text += "#define " + define + "\n";
  assembly.add(std::string(file), std::string(file));
  return std::move(assembly.result);
}

std::string with_file_names(std::string_view log, const std::vector<std::string>& files) {
  std::string named;
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size());
    const std::string_view line = log.substr(0, end);
    log.remove_prefix(std::min(end + 1, log.size()));
    std::size_t at = 0;
    const std::size_t file = number_at(line, at);
    const bool opened = file < files.size() && at < line.size() && (line[at] == ':' || line[at] == '(');
    const std::size_t number = opened ? number_at(line, ++at) : std::string_view::npos;
    if (number == std::string_view::npos) {
      named.append(line);
    } else {
      if (at < line.size() && line[at] == ')') ++at;
      named += files[file] + ":" + std::to_string(number);
      named.append(line.substr(at));
    }
    named.push_back('\n');
  }
  return named;
}

}  // namespace airlight
