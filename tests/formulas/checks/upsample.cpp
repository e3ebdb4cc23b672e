// What is between samples, against polynomials that samples tell exactly, and against definitions in double.
#include <algorithm>
#include <array>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 260;

// Polynomials of the second degree along each axis, also beyond the samples (u, v up to 1.75), whose values floats hold exactly;
// and constants, in every bit. Beside the largest sample.
Measured measure_upsampled(const Run& run) {
  Random random(stream);
  Columns in;
  std::vector<double> truth, largest;
  for (int i = 0; i < 20000; ++i) {
    const bool constant = i % 8 == 0, negative = i % 8 == 1;
    const auto coefficient = [&] { return constant ? 0.0 : std::floor(random.number(-64, 64)) / 64; };
    const double base = negative ? -20 : constant ? as_float(random.magnitude(1e-6, 1e6)) : 20;
    const std::array<double, 5> p{coefficient(), coefficient(), coefficient(), coefficient(), coefficient()};
    const auto value = [&](double x, double y) {
      return base + p[0] * x + p[1] * y + p[2] * x * x + p[3] * y * y + p[4] * x * y;
    };
    const double u = std::floor(random.number(0, 8)) / 4, v = std::floor(random.number(0, 8)) / 4;
    add_call(in, value(0, 0), value(1, 0), value(0, 1), value(1, 1), 2 * p[2], 2 * p[2], 2 * p[3], 2 * p[3], u, v);
    truth.push_back(std::max(value(u, v), 0.0));
    largest.push_back(constant ? 0 : 40);
  }
  const Columns found = run({Formula::upsampled, in});
  Measured m;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double apart = std::fabs(found[0][i] - truth[i]);
    m.add(largest[i] > 0 ? apart / largest[i]
          : apart > 0    ? HUGE_VAL
                         : 0,
          [&] {
            return place({{"a", in[0][i]}, {"b", in[1][i]}, {"u", in[8][i]}, {"v", in[9][i]}});
          });
  }
  return m;
}

// What bends add at most, told their sizes: of bends that are the same on both sides what is between bilinear and bent, else
// more.
Measured measure_error(const Run& run) {
  Random random(stream + 1);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.number(-1, 1), y = random.number(-1, 1);
    const bool same = i % 2 == 0;
    add_call(in, random.number(10, 11), random.number(10, 11), random.number(10, 11), random.number(10, 11), x,
             same ? x : random.number(-1, 1), y, same ? y : random.number(-1, 1), random.number(0, 1), random.number(0, 1));
  }
  const Columns found = run({Formula::upsampled, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double u = in[8][i], v = in[9][i];
    const double flat = (in[0][i] * (1 - u) + in[1][i] * u) * (1 - v) + (in[2][i] * (1 - u) + in[3][i] * u) * v;
    const double of_x = u * (1 - u) / 2, of_y = v * (1 - v) / 2;  // of a second difference, what a chord leaves
    const double bound =
        of_x * std::max(std::fabs(in[4][i]), std::fabs(in[5][i])) + of_y * std::max(std::fabs(in[6][i]), std::fabs(in[7][i]));
    const double added = std::max(std::fabs(found[0][i] - flat) - bound, 0.0) / 11;
    m.add(std::max(std::fabs(found[1][i] - bound), added), [&] {
      return place({{"above", in[4][i]}, {"below", in[5][i]}, {"left", in[6][i]}, {"right", in[7][i]}, {"u", u}, {"v", v}});
    });
  }
  return m;
}

// Of the second differences at a and b the one of less size, and the mean size; that of the side which has samples, and the
// slope.
Measured measure_bend(const Run& run) {
  Random random(stream + 2);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const auto value = [&] { return std::floor(random.number(0, 4096)) / 256; };
    add_call(in, value(), value(), value(), value(), i % 3 == 0 ? 0 : 1, i % 3 == 1 ? 0 : 1);
  }
  const Columns found = run({Formula::bend_between, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double at_a = in[0][i] - 2 * in[1][i] + in[2][i], at_b = in[1][i] - 2 * in[2][i] + in[3][i];
    const double truth = in[4][i] == 0 ? at_b : in[5][i] == 0 ? at_a : std::fabs(at_a) < std::fabs(at_b) ? at_a : at_b;
    const double slope = std::fabs(in[1][i] - in[2][i]);
    const double size = in[4][i] == 0   ? std::fabs(at_b) + slope / 2
                        : in[5][i] == 0 ? std::fabs(at_a) + slope / 2
                                        : (std::fabs(at_a) + std::fabs(at_b)) / 2;
    m.add(std::max(std::fabs(found[0][i] - truth), std::fabs(found[1][i] - size)), [&] {
      return place({{"before", in[0][i]}, {"a", in[1][i]}, {"b", in[2][i]}, {"after", in[3][i]}});
    });
  }
  return m;
}

// 1 of the same end, 0 from the tolerance on, less the farther, the same on both sides.
Measured measure_fit(const Run& run) {
  Random random(stream + 3);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double inverse = as_float(i % 5 == 0 ? 1e-30 : random.magnitude(1e-4, 1e4)), tolerance = random.magnitude(1e-3, 0.3);
    const double off = i % 4 == 0 ? 0 : random.number(-2, 2) * tolerance;
    add_call(in, inverse, inverse * (1 + off), tolerance);
  }
  const Columns found = run({Formula::depth_fit, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double off = std::fabs(in[1][i] / in[0][i] - 1) / in[2][i], truth = off >= 1 ? 0 : 1 - off * off;
    m.add(std::fabs(found[0][i] - truth), [&] {
      return place({{"inverse", in[0][i]}, {"of sample", in[1][i]}, {"tolerance", in[2][i]}});
    });
  }
  return m;
}

// Means, and of equal samples that sample in every bit; what has no weight may be anything. Beside the largest that has one.
Measured measure_mean(const Run& run) {
  Random random(stream + 4);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 4> sample{}, weight{};
    const double same = random.magnitude(1e-6, 1e6);
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      weight[k] = (static_cast<unsigned>(i) >> k & 1U) != 0 || k + 1 == 4 ? std::floor(random.number(1, 64)) : 0;
      sample[k] = !(weight[k] > 0) ? 1e25 : i / 16 % 2 == 0 ? same : random.number(0, 8);
      sum += weight[k];
    }
    add_call(in, sample[0], sample[1], sample[2], sample[3], weight[0] / sum, weight[1] / sum, weight[2] / sum, weight[3] / sum);
  }
  const Columns found = run({Formula::weighted_mean, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    double truth = 0, most = 0, least = HUGE_VAL, sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(in[4 + k][i] > 0)) continue;
      truth += in[4 + k][i] * in[k][i];
      sum += in[4 + k][i];
      most = std::max(most, in[k][i]);
      least = std::min(least, in[k][i]);
    }
    const double apart = most == least ? (found[0][i] == most ? 0 : HUGE_VAL) : std::fabs(found[0][i] - truth / sum) / most;
    m.add(apart, [&] {
      return place({{"a", in[0][i]}, {"b", in[1][i]}, {"of a", in[4][i]}, {"of b", in[5][i]}, {"found", found[0][i]}});
    });
  }
  return m;
}

}  // namespace

void add_upsample_checks(std::vector<Check>& checks) {
  checks.push_back({"upsampled", measure_upsampled, "exact_double", "upsampled"});
  checks.push_back({"upsampling_error", measure_error, "exact_double", "upsampled"});
  checks.push_back({"bend_between", measure_bend, "exact_double", "exact_float"});
  checks.push_back({"depth_fit", measure_fit, "depth_fit_double", "depth_fit"});
  checks.push_back({"weighted_mean", measure_mean, "weighted_mean_double", "upsampled"});
}

}  // namespace airlight
