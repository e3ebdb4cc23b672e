// Rows of numbers with named columns, out of PLY and CSV files: clouds of Gaussians, particles, splats.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airlight {

struct CloudColumn {
  std::string name;
  bool byte = false;   // of a PLY: 8 bits without sign, of which 255 stands for 1 where it is a colour
  std::size_t at = 0;  // which number of a row; of a binary PLY, how many bytes from its begin
};

// The columns that were asked for and are there, and their values. Everything knows its place in the file.
class CloudTable {
 public:
  std::string path;
  std::string bytes;                 // the whole file
  bool binary = false;               // rows of bytes, not lines
  int header_line = 1;               // where its columns begin to be told
  std::vector<CloudColumn> columns;  // in the order of the file
  std::vector<std::string> others;   // names of columns that are there, too
  std::vector<std::size_t> rows;     // [byte] where each begins
  std::vector<double> values;        // finite, row by row

  // The index among `columns`, or -1.
  int find(std::string_view name) const;
  double at(std::size_t row, int column) const { return values[row * columns.size() + static_cast<std::size_t>(column)]; }

  // Throws InputError "path:line:column: name: what", of a binary file "path: byte N: name: what".
  [[noreturn]] void fail(std::size_t row, int column, std::string_view what) const;
};

inline constexpr std::size_t most_cloud_rows = 10'000'000;

// The element "vertex" of a PLY file (ascii, binary of either byte order); elements before it are passed over. Throws InputError
// with the place: of the header, of a number that is none or not finite, of the end of the file where it ends too early.
CloudTable read_ply_table(const std::string& path, std::string bytes, std::span<const std::string_view> wanted);

// Lines of numbers with commas between them, after a line of names; blank lines and those that begin with # are passed over.
CloudTable read_csv_table(const std::string& path, std::string bytes, std::span<const std::string_view> wanted);

}  // namespace airlight
