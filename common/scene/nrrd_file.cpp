#include "common/scene/nrrd_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "common/error.h"
#include "common/scene/limits.h"
#include "common/scene/raw_number.h"
#include "common/scene/vdb_layout.h"

namespace airlight {

namespace {

struct TypeName {
  RawType type;
  std::array<std::string_view, 4> names;
};
constexpr std::array<TypeName, 10> type_names{{{RawType::int8, {"signed char", "int8", "int8_t", ""}},
                                               {RawType::uint8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
                                               {RawType::int16, {"short", "signed short", "int16", "int16_t"}},
                                               {RawType::uint16, {"ushort", "unsigned short", "uint16", "uint16_t"}},
                                               {RawType::int32, {"int", "signed int", "int32", "int32_t"}},
                                               {RawType::uint32, {"uint", "unsigned int", "uint32", "uint32_t"}},
                                               {RawType::int64, {"longlong", "long long", "int64", "int64_t"}},
                                               {RawType::uint64, {"ulonglong", "unsigned long long", "uint64", "uint64_t"}},
                                               {RawType::single, {"float", "", "", ""}},
                                               {RawType::twice, {"double", "", "", ""}}}};

std::optional<RawType> type_named(std::string_view name) {
  for (const TypeName& t : type_names) {
    if (!name.empty() && std::find(t.names.begin(), t.names.end(), name) != t.names.end()) return t.type;
  }
  return std::nullopt;
}

// The text without blanks at its ends.
std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  return begin == text.npos ? std::string_view() : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

class NrrdReader {
 public:
  NrrdReader(const std::string& path, std::string_view bytes, Progress& progress)
      : path_(path), bytes_(bytes), progress_(progress) {}

  SparseGrid read() {
    header();
    check();
    SparseGridBuilder builder(path_);
    text_ ? text_values(builder) : raw_values(builder);
    SparseGrid grid;
    if (!builder.finish(grid)) throw InputError(path_ + ": no value above 0, expected at least one");
    for (int k = 0; k < 3; ++k) grid.transform[k] = glm::dvec4(axes_[static_cast<std::size_t>(k)], 0);
    grid.transform[3] = glm::dvec4(origin_, 1);
    return grid;
  }

 private:
  [[noreturn]] void fail(std::string_view what) const { throw InputError(fmt::format("{}:{}: {}", path_, line_, what)); }

  std::optional<std::string_view> next_line() {
    if (at_ >= bytes_.size()) return std::nullopt;
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    ++line_;
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  double number(std::string_view text) const {
    double v = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    if (error != std::errc() || end != text.data() + text.size() || !(std::abs(v) <= limits::farthest))
      fail(fmt::format("\"{}\", expected a number up to {}", printable(text), limits::farthest));
    return v;
  }
  // As many numbers as asked for, with these characters between them.
  template <std::size_t n>
  std::array<double, n> numbers(std::string_view text, std::string_view between) const {
    std::array<double, n> all{};
    std::size_t count = 0;
    for (std::size_t at = text.find_first_not_of(between); at < text.size(); at = text.find_first_not_of(between, at)) {
      const std::size_t end = std::min(text.find_first_of(between, at), text.size());
      if (count == n) fail(fmt::format("more than {} numbers", n));
      all[count++] = number(text.substr(at, end - at));
      at = end;
    }
    if (count < n) fail(fmt::format("{} numbers, expected {}", count, n));
    return all;
  }

  void header() {
    next_line();
    for (;;) {
      const auto text = next_line();
      if (!text) fail("the file ends within the header, expected an empty line after it");
      if (trimmed(*text).empty()) return;
      if (text->front() == '#' || text->find(":=") != text->npos) continue;
      const std::size_t colon = text->find(':');
      if (colon == text->npos) fail("expected \"field: value\"");
      field(trimmed(text->substr(0, colon)), trimmed(text->substr(colon + 1)));
    }
  }

  void field(std::string_view name, std::string_view value) {
    if (name == "type") {
      type_ = type_named(value);
      if (!type_) fail(fmt::format("type \"{}\", expected one such as float, double, uint8", printable(value)));
    } else if (name == "dimension") {
      if (value != "3") fail(fmt::format("dimension \"{}\", expected 3", printable(value)));
    } else if (name == "sizes") {
      const auto n = numbers<3>(value, " \t");
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(n[k] >= 1) || n[k] != std::floor(n[k])) fail(fmt::format("a size of {}, expected whole numbers above 0", n[k]));
      }
      if (n[0] * n[1] * n[2] > static_cast<double>(most_cells))
        fail(fmt::format("{} x {} x {} cells, expected at most {} in all", n[0], n[1], n[2], most_cells));
      size_ = glm::ivec3(static_cast<int>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]));
    } else if (name == "encoding") {
      text_ = value == "ascii" || value == "text" || value == "txt";
      if (!text_ && value != "raw") fail(fmt::format("encoding \"{}\", expected raw or ascii", printable(value)));
      encoded_ = true;
    } else if (name == "endian") {
      if (value != "little" && value != "big") fail(fmt::format("endian \"{}\", expected little or big", printable(value)));
      little_ = value == "little";
    } else if (name == "space directions") {
      const auto n = numbers<9>(value, " \t(),");
      for (std::size_t k = 0; k < 3; ++k) axes_[k] = {n[3 * k], n[3 * k + 1], n[3 * k + 2]};
    } else if (name == "spacings") {
      const auto n = numbers<3>(value, " \t");
      axes_ = {glm::dvec3(n[0], 0, 0), glm::dvec3(0, n[1], 0), glm::dvec3(0, 0, n[2])};
    } else if (name == "space origin") {
      const auto n = numbers<3>(value, " \t(),");
      origin_ = {n[0], n[1], n[2]};
    } else if (name == "data file" || name == "datafile") {
      fail("values in another file, expected them after the header");
    } else if ((name == "byte skip" || name == "byteskip" || name == "line skip" || name == "lineskip") && value != "0") {
      fail(fmt::format("{} \"{}\", expected 0", name, printable(value)));
    }
  }

  void check() const {
    if (!type_) fail("the header ends without a type");
    if (size_.x == 0) fail("the header ends without sizes");
    if (!encoded_) fail("the header ends without an encoding");
    if (!text_ && bytes_of(*type_) > 1 && !little_) fail("the header ends without endian");
  }

  // The next value, where nothing is wrong with it.
  void put(SparseGridBuilder& builder, double v) {
    if (const auto value = static_cast<float>(v); value > 0) builder.set(cell_, cell_, value);
    if (++cell_.x < size_.x) return;
    cell_.x = 0;
    progress_.check();
    if (++cell_.y < size_.y) return;
    cell_.y = 0;
    ++cell_.z;
  }
  static bool good(double v) { return v >= 0 && v <= static_cast<double>(std::numeric_limits<float>::max()); }
  std::size_t cells() const {
    return static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z);
  }

  void raw_values(SparseGridBuilder& builder) {
    const std::size_t each = bytes_of(*type_), all = cells() * each;
    if (bytes_.size() - at_ < all) {
      throw InputError(
          fmt::format("{}: ends at byte {}, expected {} values to end at byte {}", path_, bytes_.size(), cells(), at_ + all));
    }
    const bool swap = each > 1 && *little_ != (std::endian::native == std::endian::little);
    for (const std::size_t end = at_ + all; at_ < end; at_ += each) {
      const double v = raw_number(bytes_.data() + at_, *type_, swap);
      if (!good(v)) throw InputError(fmt::format("{}: byte {}: the value is {}, expected a finite number >= 0", path_, at_, v));
      put(builder, v);
    }
  }

  void text_values(SparseGridBuilder& builder) {
    std::size_t count = 0;
    while (count < cells()) {
      const auto text = next_line();
      if (!text) fail(fmt::format("the file ends after {} values, expected {}", count, cells()));
      constexpr std::string_view blank = " \t,";
      for (std::size_t at = text->find_first_not_of(blank); at < text->size() && count < cells();
           at = text->find_first_not_of(blank, at)) {
        const std::size_t end = std::min(text->find_first_of(blank, at), text->size());
        double v = 0;
        const auto [stop, error] = std::from_chars(text->data() + at, text->data() + end, v);
        if (error != std::errc() || stop != text->data() + end || !good(v)) {
          throw InputError(fmt::format("{}:{}:{}: \"{}\", expected a finite number >= 0", path_, line_, at + 1,
                                       printable(text->substr(at, end - at))));
        }
        put(builder, v);
        ++count;
        at = end;
      }
    }
  }

  const std::string& path_;
  std::string_view bytes_;
  Progress& progress_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 0;
  std::optional<RawType> type_;
  std::optional<bool> little_;
  bool text_ = false, encoded_ = false;
  glm::ivec3 size_{0}, cell_{0};
  std::array<glm::dvec3, 3> axes_{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
  glm::dvec3 origin_{0};
};

}  // namespace

bool is_nrrd(std::string_view bytes) { return bytes.substr(0, 6) == "NRRD00"; }

SparseGrid read_nrrd(const std::string& path, std::string_view bytes, Progress& progress) {
  return NrrdReader(path, bytes, progress).read();
}

}  // namespace airlight
