#include "common/scene/cloud_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/error.h"
#include "common/scene/vdb_layout.h"

namespace airlight {

int CloudTable::find(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const CloudColumn& c) { return c.name == name; });
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

void CloudTable::fail(std::size_t row, int column, std::string_view what) const {
  const CloudColumn& c = columns[static_cast<std::size_t>(column)];
  if (binary) throw InputError(fmt::format("{}: byte {}: {}: {}", path, rows[row] + c.at, c.name, what));
  // The begin of its number in the line. In a PLY blanks part numbers, in a CSV commas.
  const bool ply = bytes.starts_with("ply");
  const auto line = 1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(rows[row]), '\n');
  std::size_t at = bytes.find_first_not_of(" \t", rows[row]);
  for (std::size_t k = 0; k < c.at; ++k) {
    at = bytes.find_first_of(ply ? " \t" : ",", at);
    at = bytes.find_first_not_of(" \t", ply ? at : at + 1);
  }
  throw InputError(fmt::format("{}:{}:{}: {}: {}", path, line, at - rows[row] + 1, c.name, what));
}

namespace {

class CsvReader {
 public:
  CsvReader(CloudTable& table, std::span<const std::string_view> wanted) : t_(table), wanted_(wanted) {}

  void read() {
    if (t_.bytes.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark, as spreadsheets write it
    std::string_view line;
    if (!next(line)) throw InputError(t_.path + ":1: an empty file, expected a line of names");
    names(line);
    while (next(line)) row(line);
  }

 private:
  [[noreturn]] void fail(std::size_t column, std::string_view what) const {
    throw InputError(fmt::format("{}:{}:{}: {}", t_.path, line_, column + 1, what));
  }

  // The next line with something on it.
  bool next(std::string_view& line) {
    while (at_ < t_.bytes.size()) {
      begin_ = at_;
      const std::size_t end = std::min(t_.bytes.find('\n', at_), t_.bytes.size());
      line = std::string_view(t_.bytes).substr(at_, end - at_);
      at_ = end + 1;
      ++line_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      const std::size_t first = line.find_first_not_of(" \t");
      if (first != line.npos && line[first] != '#') return true;
    }
    return false;
  }

  // Calls visit(cell without blanks, where it begins) for each.
  template <class Visit>
  static std::size_t cells(std::string_view line, Visit&& visit) {
    std::size_t count = 0;
    for (std::size_t at = 0; at <= line.size(); ++count) {
      const std::size_t end = std::min(line.find(',', at), line.size());
      const std::size_t first = std::min(line.find_first_not_of(" \t", at), end);
      const std::string_view cell = line.substr(first, end - first);
      visit(cell.substr(0, cell.find_last_not_of(" \t") + 1), first, count);
      at = end + 1;
    }
    return count;
  }

  void names(std::string_view line) {
    t_.header_line = line_;
    count_ = cells(line, [&](std::string_view name, std::size_t at, std::size_t index) {
      if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
      if (name.empty()) fail(at, "an empty name of a column");
      const bool wanted = std::find(wanted_.begin(), wanted_.end(), name) != wanted_.end();
      if (wanted && t_.find(name) >= 0) fail(at, fmt::format("column \"{}\" is there twice", name));
      if (!wanted) t_.others.push_back(printable(name));
      if (wanted) t_.columns.push_back({std::string(name), false, index});
    });
  }

  void row(std::string_view line) {
    if (t_.rows.size() == most_cloud_rows) fail(0, fmt::format("expected at most {} rows", most_cloud_rows));
    t_.rows.push_back(begin_);
    std::size_t next = 0;
    const std::size_t count = cells(line, [&](std::string_view cell, std::size_t at, std::size_t index) {
      if (next == t_.columns.size() || t_.columns[next].at != index) return;
      double v = 0;
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), v);
      if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(v))
        fail(at, fmt::format("{}: \"{}\", expected a finite number", t_.columns[next].name, printable(cell)));
      t_.values.push_back(v);
      ++next;
    });
    if (count != count_) fail(0, fmt::format("{} cells, expected {} as in line {}", count, count_, t_.header_line));
  }

  CloudTable& t_;
  std::span<const std::string_view> wanted_;
  std::size_t at_ = 0, begin_ = 0, count_ = 0;
  int line_ = 0;
};

}  // namespace

CloudTable read_csv_table(const std::string& path, std::string bytes, std::span<const std::string_view> wanted) {
  CloudTable table;
  table.path = path;
  table.bytes = std::move(bytes);
  CsvReader(table, wanted).read();
  return table;
}

}  // namespace airlight
