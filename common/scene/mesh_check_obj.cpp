#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "common/error.h"
#include "common/scene/mesh_check.h"

namespace airlight {

namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// The next word of a line; empty at its end.
std::string_view next_word(std::string_view& line) {
  while (!line.empty() && blank(line.front())) line.remove_prefix(1);
  std::size_t n = 0;
  while (n < line.size() && !blank(line[n])) ++n;
  const std::string_view word = line.substr(0, n);
  line.remove_prefix(n);
  return word;
}

class Check {
 public:
  explicit Check(const std::string& path) : path_(path) {}

  void vertex(std::string_view line, std::uint64_t number) {
    for (int i = 0; i < 3; ++i) {
      std::string_view word = next_word(line);
      if (!word.empty() && word.front() == '+') word.remove_prefix(1);
      float v = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), v);
      const bool tiny = error == std::errc::result_out_of_range && word.find("e-") != word.npos;
      if (tiny) continue;
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(v)) {
        throw InputError(fmt::format("{}:{}: vertex {}: {} for coordinate {}, expected three finite numbers", path_, number,
                                     vertices_ + 1, word.empty() ? "nothing" : std::string(word.substr(0, 40)), i + 1));
      }
    }
    ++vertices_;
  }

  void face(std::string_view line, std::uint64_t number) {
    std::uint64_t corners = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      if (word.front() == '#') break;
      std::int64_t index = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      const bool whole = error == std::errc() && (end == word.data() + word.size() || *end == '/');
      if (!whole || index == 0 || (index < 0 && static_cast<std::uint64_t>(-(index + 1)) >= vertices_)) {
        throw InputError(fmt::format("{}:{}: face vertex {}, expected an index from 1, or from -{}", path_, number,
                                     std::string(word.substr(0, 40)), vertices_));
      }
      if (index > highest_) highest_ = index, highest_line_ = number;
      ++corners;
    }
    if (corners < 3) throw InputError(fmt::format("{}:{}: a face of {} vertices, expected at least 3", path_, number, corners));
    triangles_ += corners - 2;
  }

  void end() const {
    if (highest_ > 0 && static_cast<std::uint64_t>(highest_) > vertices_) {
      throw InputError(fmt::format("{}:{}: face vertex {}, expected an index up to {}, the number of vertices", path_,
                                   highest_line_, highest_, vertices_));
    }
    if (triangles_ == 0) throw InputError(path_ + ": a mesh without faces, expected at least one triangle");
    check_triangle_count(path_, triangles_);
  }

 private:
  const std::string& path_;
  std::uint64_t vertices_ = 0, triangles_ = 0;
  std::int64_t highest_ = 0;  // of all indices: a face may stand before its vertices
  std::uint64_t highest_line_ = 0;
};

}  // namespace

void check_obj(const std::string& path, std::string_view bytes) {
  Check check(path);
  std::uint64_t number = 0;
  // A line that ends with a backslash goes on in the next: such files are left to the importer.
  if (bytes.find("\\\n") != bytes.npos || bytes.find("\\\r\n") != bytes.npos) return;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    std::string_view line = bytes.substr(at, end - at);
    at = end + 1;
    ++number;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const std::string_view keyword = next_word(line);
    if (keyword == "v") check.vertex(line, number);
    if (keyword == "f") check.face(line, number);
  }
  check.end();
}

}  // namespace airlight
