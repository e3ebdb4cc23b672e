// The high-precision tables in tests/data/reference.
#pragma once

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/algorithms/view.h"
#include "tests/csv.h"

namespace airlight {

inline double number(const std::string& text) {
  double value = 0;
  const std::errc error = std::from_chars(text.data(), text.data() + text.size(), value).ec;
  if (error == std::errc::result_out_of_range && text.find("e-") != std::string::npos) return 0;  // below any double
  if (error != std::errc()) {
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
  for (const auto& c : csv_rows("reference/airlight_homogeneous.csv")) {
    const double l = number(c[2]), phi = number(c[3]), d = number(c[4]);
    rows.push_back({phase_named(c[0]), number(c[1]), l * std::cos(phi), l * std::sin(phi), d >= 1e9 ? 1e30 : d, number(c[5])});
  }
  return rows;
}

}  // namespace airlight
