// exp_ and log_ over their domain, against the C library, in units in the last place of a float; erf_ and atan_.
#include <algorithm>
#include <bit>
#include <cstdint>

#include "tests/formulas/checks/check.h"

namespace airlight {

namespace {

double ulps(double found, double truth) {
  if (truth == 0) return found == 0 ? 0 : HUGE_VAL;
  return std::fabs(found - truth) / std::ldexp(1.0, std::max(std::ilogb(truth), -126) - 23);
}

Measured measure_exp(const Run& run) {
  Columns in(1);
  for (int i = 0; i <= 1750000; ++i) in[0].push_back(as_float(-87 + i * 1e-4));
  const Columns found = run({Formula::exp, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    m.add(ulps(found[0][i], std::exp(in[0][i])), [&] { return place({{"x", in[0][i]}}); });
  }
  return m;
}

Measured measure_exp2(const Run& run) {
  Columns in(1);
  for (int i = 0; i <= 1260000; ++i) in[0].push_back(as_float(-i * 1e-4));
  for (int i = 0; i <= 400; ++i) in[0].push_back(as_float(-std::pow(2.0, -0.1 * i)));
  const Columns found = run({Formula::exp2, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    m.add(ulps(found[0][i], std::exp2(in[0][i])), [&] { return place({{"x", in[0][i]}}); });
  }
  return m;
}

Measured measure_log(const Run& run) {
  Columns in(1);
  for (std::uint32_t bits = 0x00800000; bits < 0x7f800000; bits += 1021)
    in[0].push_back(static_cast<double>(std::bit_cast<float>(bits)));
  in[0].push_back(1);
  const Columns found = run({Formula::log, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    m.add(ulps(found[0][i], std::log(in[0][i])), [&] { return place({{"x", in[0][i]}}); });
  }
  return m;
}

// Absolute: what optical depths need.
Measured measure_erf(const Run& run) {
  Columns in(1);
  for (int i = -1000000; i <= 1000000; ++i) in[0].push_back(as_float(i * 5e-6));
  for (const double x : {-1e30, -1e4, -1e-20, 1e-20, 1e4, 1e30}) in[0].push_back(as_float(x));
  const Columns found = run({Formula::erf, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    m.add(std::fabs(found[0][i] - std::erf(in[0][i])), [&] { return place({{"x", in[0][i]}}); });
  }
  return m;
}

// Zeros of both signs among them: the second of two that are equal, in the bits of every C++ build.
Measured measure_least_and_most(const Run& run) {
  Columns in;
  for (const double a : {-1e30, -1.5, -1e-30, -0.0, 0.0, 1e-30, 1.5, 1e30}) {
    for (const double b : {-1e30, -1.5, -1e-30, -0.0, 0.0, 1e-30, 1.5, 1e30}) add_call(in, a, b);
  }
  const Columns found = run({Formula::least_and_most, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double a = in[0][i], b = in[1][i];
    m.add(std::fabs(found[0][i] - std::min(a, b)) + std::fabs(found[1][i] - std::max(a, b)), [&] {
      return place({{"a", a}, {"b", b}});
    });
  }
  return m;
}

Measured measure_atan(const Run& run) {
  Columns in(1);
  for (int i = 0; i <= 1000000; ++i) in[0].push_back(as_float(i * 2e-6));
  for (std::uint32_t bits = 0x00800000; bits < 0x7f800000; bits += 100003)
    in[0].push_back(static_cast<double>(std::bit_cast<float>(bits)));
  const Columns found = run({Formula::atan, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    m.add(in[0][i] > 0 ? std::fabs(found[0][i] / std::atan(in[0][i]) - 1) : std::fabs(found[0][i]), [&] {
      return place({{"x", in[0][i]}});
    });
  }
  return m;
}

}  // namespace

void add_elementary_checks(std::vector<Check>& checks) {
  checks.push_back({"exp", measure_exp, "float_ulp_of_double", "exp_ulp"});
  checks.push_back({"exp2", measure_exp2, "float_ulp_of_double", "exp2_ulp"});
  checks.push_back({"log", measure_log, "float_ulp_of_double", "log_ulp"});
  checks.push_back({"erf", measure_erf, "exact_double", "erf"});
  checks.push_back({"least_and_most", measure_least_and_most, "exact_double", "exact_double"});
  checks.push_back({"atan", measure_atan, "exact_double", "atan"});
}

}  // namespace airlight
