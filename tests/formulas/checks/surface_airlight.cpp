// Indirect single scattering on surfaces: the high-precision tables, closed forms for a directional light, extremes.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "common/plan/surface_airlight_tables.h"
#include "common/plan/surface_psf.h"
#include "common/plan/zonal.h"
#include "tests/formulas/checks/random.h"
#include "tests/formulas/checks/sphere.h"
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
  // What scatters back arrives at s as what scatters forward does at the cosine of that half angle.
  const std::vector<float> ahead = surface_airlight_tables({PhaseKind::henyey_greenstein, 0.9}, {20, 300});
  const std::vector<float> back = surface_airlight_tables({PhaseKind::henyey_greenstein, -0.9}, {20, 300});
  Columns turned;
  for (std::size_t i = 0; i < in[0].size(); ++i) add_call(turned, in[0][i], std::sqrt((1 - in[1][i]) * (1 + in[1][i])));
  for (const std::size_t which : {1U, 2U}) {
    const Columns truth = run({Formula::surface_airlight, turned, {}, table_of(ahead, which)});
    const Columns found = run({Formula::surface_airlight, in, {}, table_of(back, which)});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      m.add(relative_error(found[1][i], truth[1][i]), [&] {
        return place({{"table", static_cast<double>(which)}, {"s", in[1][i]}, {"truth", truth[1][i]}, {"found", found[1][i]}});
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

// NPSF's first six bands (the C++ library's harmonics) turned to the light and integrated over the lobe, by a rule about the
// lobe's axis that is exact for such polynomials.
Measured measure_psf(const Run& run) {
  const std::vector<float> exponents{2, 8}, tables = surface_psf_tables(exponents);
  const Zonal npsf = npsf_coefficients();
  Random random(161);
  Columns in;
  for (const double lambda : {0.0, 1e-30, 1.0, 80.0, 1e4, 1e30}) add_call(in, lambda, 0.5);
  for (int i = 0; i < 300; ++i) add_call(in, random.magnitude(1e-3, 30), i == 0 ? 1 : i == 1 ? -1 : random.number(-1, 1));
  Measured m;
  for (std::size_t which = 0; which <= exponents.size(); ++which) {
    const double n = which == 0 ? 1 : static_cast<double>(exponents[which - 1]), scale = which == 0 ? pi : 1;
    const auto of_light = [&](double c) {
      const double s = std::sqrt(std::max(0.0, 1 - c * c));
      double sum = 0;
      for (std::size_t k = 0; k < 8; ++k) {
        const double x = 0.5 + (k % 2 == 0 ? 0.5 : -0.5) * gauss_node[k / 2], y = std::sqrt(1 - x * x);
        const double weight = scale * gauss_weight[k / 2] / 2 * (n + 1) * std::pow(x, n) / 16;
        for (int a = 0; a < 16; ++a) {
          const double cosine = std::clamp(x * c + y * s * std::cos(pi * a / 8), -1.0, 1.0);
          for (unsigned l = 0; l < 6; ++l) sum += weight * npsf[l] * std::sqrt((2 * l + 1) / (4 * pi)) * std::legendre(l, cosine);
        }
      }
      return std::max(sum, 0.0);
    };
    const double top = of_light(1);
    const std::span<const float> table = std::span(tables).subspan(which * surface_psf_floats, surface_psf_floats);
    const Columns found = run({Formula::surface_airlight_psf, in, {}, table});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const double lambda = in[0][i], share = lambda * std::exp(-lambda);
      m.add(std::fabs(found[0][i] - share * of_light(in[1][i])) / (top * std::max(share * (1 + lambda), 1e-36)), [&] {
        return place({{"shininess", n}, {"lambda", lambda}, {"cosine", in[1][i]}, {"found", found[0][i]}});
      });
    }
  }
  return m;
}

}  // namespace

void add_surface_airlight_checks(std::vector<Check>& checks) {
  checks.push_back({"surface_airlight_lambert", measure_lambert, "surface_airlight_table", "surface_airlight_table"});
  checks.push_back({"surface_airlight_phong", measure_phong, "surface_airlight_table", "surface_airlight_table"});
  checks.push_back({"surface_airlight_directional", measure_directional, "surface_airlight_sun", "surface_airlight_sun"});
  checks.push_back({"surface_airlight_psf", measure_psf, "surface_airlight_psf_double", "surface_airlight_psf"});
  checks.push_back({"surface_airlight_extremes", measure_extremes, "exact_double", "exact_double"});
}

}  // namespace airlight
