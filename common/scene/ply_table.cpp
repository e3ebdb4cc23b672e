#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "common/error.h"
#include "common/scene/cloud_table.h"
#include "common/scene/raw_number.h"
#include "common/scene/vdb_layout.h"

namespace airlight {

namespace {

struct TypeName {
  std::string_view name, sized;
  RawType type;
};
constexpr std::array<TypeName, 8> type_names{{{"char", "int8", RawType::int8},
                                              {"uchar", "uint8", RawType::uint8},
                                              {"short", "int16", RawType::int16},
                                              {"ushort", "uint16", RawType::uint16},
                                              {"int", "int32", RawType::int32},
                                              {"uint", "uint32", RawType::uint32},
                                              {"float", "float32", RawType::single},
                                              {"double", "float64", RawType::twice}}};

struct Property {
  std::string name;
  RawType type = RawType::single;
  bool list = false;
  RawType count = RawType::uint8;  // of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Word {
  std::string_view text;
  std::size_t column;  // from 1
};

class PlyReader {
 public:
  PlyReader(CloudTable& table, std::span<const std::string_view> wanted) : t_(table), wanted_(wanted) {}

  void read() {
    header();
    const auto vertex = std::find_if(elements_.begin(), elements_.end(), [](const Element& e) { return e.name == "vertex"; });
    if (vertex == elements_.end()) throw InputError(t_.path + ": no element \"vertex\", expected one");
    if (vertex->count > most_cloud_rows)
      throw InputError(fmt::format("{}: {} vertices, expected at most {}", t_.path, vertex->count, most_cloud_rows));
    choose(*vertex);
    for (auto e = elements_.begin(); e != vertex; ++e) pass_over(*e);
    take_room(*vertex);
    t_.binary ? binary_rows(*vertex) : text_rows(*vertex);
  }

 private:
  [[noreturn]] void fail(std::size_t column, std::string_view what) const {
    throw InputError(fmt::format("{}:{}:{}: {}", t_.path, line_, column, what));
  }
  [[noreturn]] void ends(std::string_view where) const {
    if (!t_.binary) fail(1, fmt::format("the file ends within {}", where));
    throw InputError(fmt::format("{}: ends at byte {}, within {}", t_.path, t_.bytes.size(), where));
  }

  bool next(std::string_view& line) {
    if (at_ >= t_.bytes.size()) return false;
    const std::size_t end = std::min(t_.bytes.find('\n', at_), t_.bytes.size());
    line = std::string_view(t_.bytes).substr(at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = std::min(end + 1, t_.bytes.size());
    ++line_;
    return true;
  }
  static std::vector<Word> words(std::string_view line) {
    std::vector<Word> found;
    for (std::size_t at = line.find_first_not_of(" \t"); at < line.size(); at = line.find_first_not_of(" \t", at)) {
      const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
      found.push_back({line.substr(at, end - at), at + 1});
      at = end;
    }
    return found;
  }

  RawType type(const Word& w) const {
    for (const TypeName& t : type_names) {
      if (w.text == t.name || w.text == t.sized) return t.type;
    }
    fail(w.column, fmt::format("type \"{}\", expected one such as float, double, uchar, int", printable(w.text)));
  }

  void header() {
    std::string_view line;
    if (!next(line) || line != "ply") throw InputError(t_.path + ":1:1: expected the word ply");
    bool format = false;
    for (;;) {
      if (!next(line)) fail(1, "the file ends within the header, expected end_header");
      const std::vector<Word> w = words(line);
      if (w.empty() || w[0].text == "comment" || w[0].text == "obj_info") continue;
      if (w[0].text == "end_header") break;
      if (w[0].text == "format" && w.size() >= 2) {
        t_.binary = w[1].text != "ascii";
        swap_ = w[1].text == (std::endian::native == std::endian::little ? "binary_big_endian" : "binary_little_endian");
        if (t_.binary && w[1].text != "binary_big_endian" && w[1].text != "binary_little_endian")
          fail(w[1].column,
               fmt::format("format \"{}\", expected ascii, binary_little_endian or binary_big_endian", printable(w[1].text)));
        format = true;
      } else if (w[0].text == "element" && w.size() == 3) {
        Element e{std::string(w[1].text), 0, {}};
        const auto [end, error] = std::from_chars(w[2].text.data(), w[2].text.data() + w[2].text.size(), e.count);
        if (error != std::errc() || end != w[2].text.data() + w[2].text.size()) fail(w[2].column, "expected a whole number");
        if (e.name == "vertex") t_.header_line = line_;
        elements_.push_back(std::move(e));
      } else if (w[0].text == "property" && w.size() == 3 && !elements_.empty()) {
        elements_.back().properties.push_back({std::string(w[2].text), type(w[1]), false, {}});
      } else if (w[0].text == "property" && w.size() == 5 && w[1].text == "list" && !elements_.empty()) {
        elements_.back().properties.push_back({std::string(w[4].text), type(w[3]), true, type(w[2])});
      } else {
        fail(w[0].column, fmt::format("\"{}\", expected a line of a PLY header", printable(line)));
      }
    }
    if (!format) fail(1, "the header ends without a format");
  }

  void choose(const Element& vertex) {
    std::size_t at = 0;
    for (const Property& p : vertex.properties) {
      if (p.list)
        throw InputError(fmt::format("{}:{}:1: property \"{}\" of vertex is a list, expected numbers", t_.path, t_.header_line,
                                     printable(p.name)));
      const bool wanted = std::find(wanted_.begin(), wanted_.end(), p.name) != wanted_.end();
      if (wanted && t_.find(p.name) >= 0)
        throw InputError(fmt::format("{}:{}:1: property \"{}\" is there twice", t_.path, t_.header_line, printable(p.name)));
      if (!wanted) t_.others.push_back(printable(p.name));
      if (wanted) {
        t_.columns.push_back({p.name, p.type == RawType::uint8, at});
        types_.push_back(p.type);
      }
      at += t_.binary ? bytes_of(p.type) : 1;
    }
    row_ = at;
  }

  void take_room(const Element& vertex) {
    // Held against the file before memory is taken: a row of text has a number and a blank for each.
    const std::uint64_t least =
        t_.binary ? vertex.count * row_ : vertex.count * (2 * std::max<std::size_t>(row_, 1)) - (vertex.count > 0 ? 1 : 0);
    if (least > t_.bytes.size() - at_) {
      throw InputError(fmt::format("{}: ends at byte {}, expected {} vertices to end at byte {} or later", t_.path,
                                   t_.bytes.size(), vertex.count, at_ + least));
    }
    t_.rows.reserve(static_cast<std::size_t>(vertex.count));
    t_.values.reserve(static_cast<std::size_t>(vertex.count) * t_.columns.size());
  }

  void pass_over(const Element& e) {
    std::string_view line;
    const std::string where = fmt::format("element \"{}\"", printable(e.name));
    for (std::uint64_t i = 0; i < e.count; ++i) {
      if (!t_.binary) {
        if (!next(line)) ends(where);
        continue;
      }
      const std::size_t before = at_;
      for (const Property& p : e.properties) {
        std::uint64_t count = 1;
        if (p.list) {
          if (t_.bytes.size() - at_ < bytes_of(p.count)) ends(where);
          const double n = raw_number(t_.bytes.data() + at_, p.count, swap_);
          if (!(n >= 0 && n <= 1e9)) throw InputError(fmt::format("{}: byte {}: a list of {}", t_.path, at_, n));
          count = static_cast<std::uint64_t>(n);
          at_ += bytes_of(p.count);
        }
        if (t_.bytes.size() - at_ < count * bytes_of(p.type)) ends(where);
        at_ += static_cast<std::size_t>(count) * bytes_of(p.type);
      }
      if (at_ == before) return;  // elements of nothing
    }
  }

  void binary_rows(const Element& vertex) {
    for (std::uint64_t i = 0; i < vertex.count; ++i, at_ += row_) {
      t_.rows.push_back(at_);
      for (std::size_t k = 0; k < t_.columns.size(); ++k) {
        const double v = raw_number(t_.bytes.data() + at_ + t_.columns[k].at, types_[k], swap_);
        t_.values.push_back(v);
        if (!std::isfinite(v)) t_.fail(t_.rows.size() - 1, static_cast<int>(k), fmt::format("{}, expected a finite number", v));
      }
    }
  }

  void text_rows(const Element& vertex) {
    std::string_view line;
    for (std::uint64_t i = 0; i < vertex.count; ++i) {
      t_.rows.push_back(at_);
      if (!next(line)) ends(fmt::format("{} vertices, of which {} are there", vertex.count, i));
      const std::vector<Word> w = words(line);
      if (w.size() != row_) fail(1, fmt::format("{} numbers, expected {}", w.size(), row_));
      for (const CloudColumn& c : t_.columns) {
        const std::string_view text = w[c.at].text;
        double v = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(v))
          fail(w[c.at].column, fmt::format("{}: \"{}\", expected a finite number", c.name, printable(text)));
        t_.values.push_back(v);
      }
    }
  }

  CloudTable& t_;
  std::span<const std::string_view> wanted_;
  std::vector<Element> elements_;
  std::vector<RawType> types_;  // of the columns
  std::size_t at_ = 0, row_ = 0;
  int line_ = 0;
  bool swap_ = false;
};

}  // namespace

CloudTable read_ply_table(const std::string& path, std::string bytes, std::span<const std::string_view> wanted) {
  CloudTable table;
  table.path = path;
  table.bytes = std::move(bytes);
  PlyReader(table, wanted).read();
  return table;
}

}  // namespace airlight
