// Gaussians along a ray, against the table of their line integrals and the C library.
#include <algorithm>
#include <numbers>

#include "tests/csv.h"
#include "tests/formulas/checks/random.h"
#include "tests/formulas/rows.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 150;

// Beside the whole line through the centre, c sqrt(pi) / a.
Measured table_by(Formula depth, const Run& run) {
  Columns in;
  std::vector<double> truth;
  for (const auto& row : csv_rows("reference/gaussian_line_integral.csv")) {
    const double a = number(row[0]), c = number(row[1]), h = number(row[2]), center = number(row[3]), d = number(row[4]);
    add_call(in, a, h, -center, d - center);
    truth.push_back(number(row[5]) / (c * std::sqrt(std::numbers::pi) / a));
  }
  const Columns found = run({depth, in});
  Measured m;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    m.add(std::fabs(found[0][i] - truth[i]), [&] {
      return place({{"a", in[0][i]}, {"h", in[1][i]}, {"from", in[2][i]}, {"to", in[3][i]}});
    });
  }
  return m;
}

// From the camera's side to infinity, through the centre and far from it, lengths from a micrometre to a megametre.
Measured depth_by(Formula depth, const Run& run) {
  Random random(stream);
  Columns in;
  for (int i = 0; i < 40000; ++i) {
    const double radius = random.magnitude(1e-6, 1e6), from = random.number(-6, 6) * radius;
    const double to = i % 10 == 0 ? 1e30 : from + random.magnitude(1e-3, 10) * radius;
    add_call(in, 1 / radius, random.number(0, 5) * radius, from, to);
  }
  const Columns found = run({depth, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double a = in[0][i], h = a * in[1][i];
    const double truth = 0.5 * std::exp(-h * h) * (std::erf(a * in[3][i]) - std::erf(a * in[2][i]));
    m.add(std::fabs(found[0][i] - truth), [&] {
      return place({{"a", a}, {"h", in[1][i]}, {"from", in[2][i]}, {"to", in[3][i]}});
    });
  }
  return m;
}

// Without an end, and the whole line beside which it is told.
Measured beyond_by(Formula depth_beyond, const Run& run) {
  Random random(stream + 2);
  Columns in, lines;
  for (int i = 0; i < 40000; ++i) {
    const double radius = random.magnitude(1e-6, 1e6);
    add_call(in, 1 / radius, random.number(0, 5) * radius, random.number(-6, 6) * radius);
    add_call(lines, random.magnitude(1e-6, 1e6), radius);
  }
  const Columns found = run({depth_beyond, in}), whole = run({Formula::gaussian_whole, lines});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double a = in[0][i], h = a * in[1][i];
    const double truth = 0.5 * std::exp(-h * h) * std::erfc(a * in[2][i]);
    const double line = lines[0][i] * lines[1][i] * std::sqrt(std::numbers::pi);
    m.add(std::max(std::fabs(found[0][i] - truth), std::fabs(whole[0][i] / line - 1)), [&] {
      return place({{"a", a}, {"h", in[1][i]}, {"from", in[2][i]}});
    });
  }
  return m;
}

Measured measure_falloff(const Run& run) {
  Random random(stream + 1);
  Columns in;
  for (int i = 0; i < 40000; ++i) {
    const double radius = random.magnitude(1e-6, 1e6);
    const double distance = random.number(0, 12) * radius;
    add_call(in, 1 / radius, distance * distance);
  }
  const Columns found = run({Formula::gaussian_falloff, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double truth = std::exp(-std::min(in[0][i] * in[0][i] * in[1][i], 60.0));
    m.add(std::fabs(found[0][i] - truth), [&] { return place({{"a", in[0][i]}, {"squared distance", in[1][i]}}); });
  }
  return m;
}

// Stretches before the foot, behind it and around it.
Measured measure_nearest(const Run& run) {
  Random random(stream + 3);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double from = random.number(-5, 5);
    add_call(in, from, from + random.magnitude(1e-4, 10));
  }
  const Columns found = run({Formula::gaussian_nearest, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double truth = std::erf(std::clamp(0.0, in[0][i], in[1][i]));
    m.add(std::fabs(found[0][i] - truth), [&] { return place({{"from", in[0][i]}, {"to", in[1][i]}}); });
  }
  return m;
}

Measured measure_table(const Run& run) { return table_by(Formula::gaussian_depth, run); }
Measured measure_depth(const Run& run) { return depth_by(Formula::gaussian_depth, run); }
Measured measure_beyond(const Run& run) { return beyond_by(Formula::gaussian_depth_beyond, run); }
Measured measure_printed_table(const Run& run) { return table_by(Formula::gaussian_depth_printed, run); }
Measured measure_printed_depth(const Run& run) { return depth_by(Formula::gaussian_depth_printed, run); }
Measured measure_printed_beyond(const Run& run) { return beyond_by(Formula::gaussian_depth_beyond_printed, run); }

// Absolute; 1 exactly from the clamp on, and odd.
Measured measure_printed_erf(const Run& run) {
  Columns in(1);
  for (int i = -400000; i <= 400000; ++i) in[0].push_back(as_float(i * 1e-5));
  for (const double x : {-1e30, -2.62964, -2.62963, -1e-20, 1e-20, 2.62963, 2.62964, 1e30}) in[0].push_back(as_float(x));
  const Columns found = run({Formula::erf_printed, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double x = in[0][i], beyond = std::fabs(x) > 2.62964 && std::fabs(found[0][i]) != 1 ? HUGE_VAL : 0;
    m.add(std::max(std::fabs(found[0][i] - std::erf(x)), beyond), [&] { return place({{"x", x}}); });
  }
  return m;
}

}  // namespace

void add_gaussian_checks(std::vector<Check>& checks) {
  checks.push_back({"gaussian_table", measure_table, "gaussian_table", "gaussian_depth"});
  checks.push_back({"gaussian_depth", measure_depth, "exact_double", "gaussian_depth"});
  checks.push_back({"gaussian_depth_beyond", measure_beyond, "exact_double", "gaussian_depth"});
  checks.push_back({"erf_printed", measure_printed_erf, "erf_printed", "erf_printed"});
  checks.push_back({"gaussian_printed_table", measure_printed_table, "erf_printed", "erf_printed"});
  checks.push_back({"gaussian_printed_depth", measure_printed_depth, "erf_printed", "erf_printed"});
  checks.push_back({"gaussian_printed_depth_beyond", measure_printed_beyond, "erf_printed", "erf_printed"});
  checks.push_back({"gaussian_nearest", measure_nearest, "exact_double", "erf"});
  checks.push_back({"gaussian_falloff", measure_falloff, "exact_double", "gaussian_depth"});
}

}  // namespace airlight
