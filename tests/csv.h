// Reads the tables in tests/data: lines of comma-separated fields, comments start with #, the first other line names the columns.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace airlight {

inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> fields;
  std::istringstream in(text);
  for (std::string field; std::getline(in, field, separator);) fields.push_back(field);
  return fields;
}

// Every row of tests/data/<name>, without the names. Throws when there is none.
inline std::vector<std::vector<std::string>> csv_rows(const std::string& name) {
  std::ifstream in(std::string(AIRLIGHT_TEST_DATA "/") + name);
  std::vector<std::vector<std::string>> rows;
  bool named = false;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (named) rows.push_back(split(line, ','));
    named = true;
  }
  if (rows.empty()) throw std::runtime_error("no rows in " + name);
  return rows;
}

}  // namespace airlight
