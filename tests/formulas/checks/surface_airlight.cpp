// Indirect single scattering on surfaces: the high-precision tables, closed forms for a directional light, extremes.
#include <map>
#include <numbers>

#include "common/plan/surface_airlight_tables.h"
#include "tests/formulas/checks/random.h"
#include "tests/formulas/rows.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;

// The tables of a phase function, one after the other: Lambert, then Phong; and one of them alone.
std::span<const float> table_of(const std::vector<float>& tables, std::size_t which) {
  return std::span(tables).subspan(which * surface_airlight_floats, surface_airlight_floats);
}

struct Row {
  double lambda, phi, value;
};

void measure_rows(const Run& run, std::span<const float> table, double shininess, const std::vector<Row>& rows, Measured& m) {
  Columns in;
  for (const Row& row : rows) add_call(in, row.lambda, std::sin(row.phi / 2));
  const Columns found = run({Formula::surface_airlight, in, {}, table});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    m.add(relative_error(found[0][i], rows[i].value), [&] {
      return place({{"shininess", shininess}, {"lambda", rows[i].lambda}, {"phi", rows[i].phi}, {"truth", rows[i].value}});
    });
  }
}

Measured measure_lambert(const Run& run) {
  std::vector<Row> rows;
  for (const auto& row : csv_rows("reference/surface_airlight_lambert.csv")) {
    rows.push_back({number(row[0]), number(row[1]), number(row[2])});
  }
  Measured m;
  measure_rows(run, table_of(surface_airlight_tables({}, {}), 0), 0, rows, m);
  return m;
}

// The file's lobes are not normalised.
Measured measure_phong(const Run& run) {
  std::map<double, std::vector<Row>> by_shininess;
  for (const auto& row : csv_rows("reference/surface_airlight_phong.csv")) {
    const double n = number(row[2]);
    by_shininess[n].push_back({number(row[0]), number(row[1]), number(row[3]) * (n + 1) / (2 * pi)});
  }
  Measured m;
  for (const auto& [n, rows] : by_shininess) {
    const std::vector<float> tables = surface_airlight_tables({}, {static_cast<float>(n)});
    measure_rows(run, table_of(tables, 1), n, rows, m);
  }
  return m;
}

// Rayleigh's 3 / (16 pi) (1 + mu^2) over the cosine of a hemisphere is 3 / 16 (1 + (1 + c^2) / 4), c the cosine of normal and
// light; over a normalised lobe, whose mean square along its axis is (n + 1) / (n + 3), 3 / (16 pi) (1 + (1 + n c^2) / (n + 3)).
Measured measure_directional(const Run& run) {
  const std::vector<float> exponents{1, 20, 300}, tables = surface_airlight_tables({PhaseKind::rayleigh, 0}, exponents);
  Random random(160);
  Columns in;
  for (int i = 0; i < 4000; ++i) add_call(in, random.magnitude(1e-3, 30), i == 0 ? 0 : i == 1 ? 1 : random.number());
  Measured m;
  for (std::size_t which = 0; which <= exponents.size(); ++which) {
    const double n = which == 0 ? 0 : static_cast<double>(exponents[which - 1]);
    const Columns found = run({Formula::surface_airlight, in, {}, table_of(tables, which)});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const double c = 1 - 2 * in[1][i] * in[1][i];
      const double truth = which == 0 ? 3 / 16.0 * (1 + (1 + c * c) / 4) : 3 / (16 * pi) * (1 + (1 + n * c * c) / (n + 3));
      m.add(relative_error(found[1][i], truth), [&] {
        return place({{"shininess", n}, {"s", in[1][i]}, {"truth", truth}, {"found", found[1][i]}});
      });
    }
  }
  return m;
}

// Finite and not negative, whatever the optical depth.
Measured measure_extremes(const Run& run) {
  const std::vector<float> tables = surface_airlight_tables({PhaseKind::henyey_greenstein, 0.97}, {10000});
  Columns in;
  for (const double lambda : {0.0, 1e-30, 1e-12, 1e-3, 1.0, 1e2, 1e4, 1e12, 1e30}) {
    for (const double s : {0.0, 1e-12, 1e-6, 1e-3, 0.5, 0.999999, 1.0}) add_call(in, lambda, s);
  }
  Measured m;
  for (const std::size_t which : {0U, 1U}) {
    const Columns found = run({Formula::surface_airlight, in, {}, table_of(tables, which)});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      for (const std::size_t k : {0U, 1U}) {
        m.add(std::isfinite(found[k][i]) && found[k][i] >= 0 ? 0 : HUGE_VAL, [&] {
          return place({{"lambda", in[0][i]}, {"s", in[1][i]}, {"found", found[k][i]}});
        });
      }
    }
  }
  return m;
}

}  // namespace

void add_surface_airlight_checks(std::vector<Check>& checks) {
  checks.push_back({"surface_airlight_lambert", measure_lambert, "surface_airlight_table", "surface_airlight_table"});
  checks.push_back({"surface_airlight_phong", measure_phong, "surface_airlight_table", "surface_airlight_table"});
  checks.push_back({"surface_airlight_directional", measure_directional, "surface_airlight_sun", "surface_airlight_sun"});
  checks.push_back({"surface_airlight_extremes", measure_extremes, "exact_double", "exact_double"});
}

}  // namespace airlight
