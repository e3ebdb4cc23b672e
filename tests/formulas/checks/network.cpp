// Links between particles and the source volume, against their definitions.
#include <algorithm>
#include <array>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 200;

// What a link of constant source takes of itself: int_0^all (1 - exp(-t)) dt, by Simpson's rule in parts of 1 at most.
double self_taken(double all) {
  const int parts = 64 * (1 + static_cast<int>(std::min(all, 100.0)));
  double sum = 0;
  for (int k = 0; k <= 2 * parts; ++k) {
    const double weight = k == 0 || k == 2 * parts ? 1 : k % 2 == 1 ? 4 : 2;
    sum -= weight * std::expm1(-all * k / (2 * parts));
  }
  return sum * all / (6 * parts);
}

// A link of one medium, or with another one in it that only takes: relative errors of all three shares.
Measured measure_links(const Run& run) {
  Random random(stream);
  Columns in;
  for (int i = 0; i < 3000; ++i) {
    const double all = random.magnitude(1e-6, 60);
    add_call(in, i % 3 == 0 ? all : all * random.number(0.01, 1), all);
  }
  add_call(in, 0.0, 0.0);
  add_call(in, 1e4, 1e4);
  const Columns found = run({Formula::link_shares, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double depth = in[0][i], all = in[1][i], ratio = all > 0 ? depth / all : 1;
    const double lost = -std::expm1(-all), kept = all > 1e3 ? all - 1 : self_taken(all);
    const std::array<double, 3> truth{lost, lost * ratio, kept * ratio * ratio};
    for (std::size_t k = 0; k < 3; ++k) {
      m.add(relative_error(found[k][i], truth[k]), [&] {
        return place({{"depth", depth}, {"all", all}, {"share", static_cast<double>(k)}});
      });
    }
  }
  return m;
}

// A function linear along each axis, of which lookups are exact, another in each channel, in one brick or in some of a box;
// beyond the nodes it stands still, in bricks without nodes it is 0. Beside its largest value.
void measure_source(const Run& run, const std::array<int, 3>& bricks, const std::vector<int>& filled, Measured& m) {
  Random random(stream + 2);
  const std::array<int, 3> n{4, 2, 5};
  const auto value = [](int channel, double x, double y, double z) { return channel + 0.25 * x + 0.5 * x * y + 0.125 * y * z; };
  const double largest = value(2, bricks[0] * 3, bricks[1], bricks[2] * 4);
  std::vector<float> table;
  for (const int size : n) table.push_back(static_cast<float>(size));
  table.push_back(static_cast<float>(largest));
  for (const int count : bricks) table.push_back(static_cast<float>(count));
  std::vector<float> numbers(static_cast<std::size_t>(bricks[0] * bricks[1] * bricks[2]), -1.0F);
  table.push_back(static_cast<float>(8 + numbers.size()));
  for (std::size_t k = 0; k < filled.size(); ++k) numbers[static_cast<std::size_t>(filled[k])] = static_cast<float>(k);
  table.insert(table.end(), numbers.begin(), numbers.end());
  for (const int brick : filled) {
    const std::array<int, 3> at{brick % bricks[0], brick / bricks[0] % bricks[1], brick / bricks[0] / bricks[1]};
    for (int channel = 0; channel < 3; ++channel) {
      for (int k = 0; k < n[2]; ++k) {
        for (int j = 0; j < n[1]; ++j) {
          for (int i = 0; i < n[0]; ++i)
            table.push_back(static_cast<float>(value(channel, at[0] * 3 + i, at[1] + j, at[2] * 4 + k)));
        }
      }
    }
  }
  for (int channel = 0; channel < 3; ++channel) {
    Columns in;
    for (int i = 0; i < 3000; ++i)
      add_call(in, random.number(-1, bricks[0] * 3 + 2), random.number(-1, bricks[1] + 2), random.number(-1, bricks[2] * 4 + 2));
    Calls calls{Formula::source_in_volume, in, {}, table};
    calls.phase.kind = static_cast<PhaseKind>(channel);
    const Columns found = run(calls);
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      std::array<double, 3> q{};
      int number = 0;
      for (std::size_t k = 3; k-- > 0;) {
        q[k] = std::clamp(in[k][i], 0.0, bricks[k] * (n[k] - 1.0));
        number = number * bricks[k] + std::min(static_cast<int>(q[k] / (n[k] - 1)), bricks[k] - 1);
      }
      const bool any = std::find(filled.begin(), filled.end(), number) != filled.end();
      m.add(std::fabs(found[0][i] - (any ? value(channel, q[0], q[1], q[2]) : 0)) / largest, [&] {
        return place({{"channel", static_cast<double>(channel)}, {"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}});
      });
    }
  }
}

Measured measure_sources(const Run& run) {
  Measured m;
  measure_source(run, {1, 1, 1}, {0}, m);
  measure_source(run, {3, 2, 2}, {0, 1, 4, 5, 9, 11}, m);
  return m;
}

}  // namespace

void add_network_checks(std::vector<Check>& checks) {
  checks.push_back({"link_shares", measure_links, "link_shares_double", "link_shares"});
  checks.push_back({"source_in_volume", measure_sources, "grid_value_double", "grid_value"});
}

}  // namespace airlight
