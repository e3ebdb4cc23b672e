// The high-precision tables in tests/data/reference.
#pragma once

#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/algorithms/view.h"

namespace airlight {

// Cells of each row, without comments and the header.
inline std::vector<std::vector<std::string>> table_rows(const std::string& name) {
  std::ifstream file(std::string(AIRLIGHT_TEST_DATA) + "/reference/" + name);
  if (!file) throw std::runtime_error("cannot read " + name);
  std::vector<std::vector<std::string>> rows;
  bool header = true;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (std::exchange(header, false)) continue;
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else if (c != '\r') {
        cells.back() += c;
      }
    }
    rows.push_back(cells);
  }
  return rows;
}

inline double number(const std::string& text) {
  double value = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) {
    throw std::runtime_error("not a number: " + text);
  }
  return value;
}

inline Phase phase_named(const std::string& name) {
  if (name == "isotropic") return {PhaseKind::isotropic, 0};
  if (name == "rayleigh") return {PhaseKind::rayleigh, 0};
  if (name == "mie_hazy") return {PhaseKind::mie_hazy, 0};
  if (name == "mie_murky") return {PhaseKind::mie_murky, 0};
  const double g = number(name.substr(2));
  if (name.starts_with("hg")) return {PhaseKind::henyey_greenstein, g};
  if (name.starts_with("cs")) return {PhaseKind::cornette_shanks, g};
  throw std::runtime_error("no such phase function: " + name);
}

struct AirlightRow {
  Phase phase;
  double extinction, foot, h, length, value;  // length 1e30: infinite
};

inline std::vector<AirlightRow> airlight_rows() {
  std::vector<AirlightRow> rows;
  for (const auto& c : table_rows("airlight_homogeneous.csv")) {
    const double l = number(c[2]), phi = number(c[3]), d = number(c[4]);
    rows.push_back({phase_named(c[0]), number(c[1]), l * std::cos(phi), l * std::sin(phi), d >= 1e9 ? 1e30 : d, number(c[5])});
  }
  return rows;
}

}  // namespace airlight
