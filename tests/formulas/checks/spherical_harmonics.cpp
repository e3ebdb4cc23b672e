// Spherical harmonics against those of the C++ library, their defining properties, and integrals over the sphere.
#include <algorithm>

#include <glm/geometric.hpp>

#include "common/plan/spherical_harmonics.h"
#include "tests/formulas/checks/random.h"
#include "tests/formulas/checks/sphere.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 240;
constexpr int most = 36;

// All coefficients that a formula gives, three a call: result[index][call].
Columns all_results(const Run& run, Formula formula, const Columns& in, std::span<const float> table = {}) {
  Columns all;
  for (int block = 0; block < most / 3; ++block) {
    Calls calls{formula, in, {}, table};
    calls.phase.kind = static_cast<PhaseKind>(block);
    for (std::vector<double>& column : run(calls)) all.push_back(std::move(column));
  }
  return all;
}

// Poles, axes, and random directions.
Columns directions(Random& random, int count) {
  Columns in;
  for (const double s : {-1.0, 1.0}) add_call(in, s, 0, 0), add_call(in, 0, s, 0), add_call(in, 0, 0, s);
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 d = random.direction();
    add_call(in, d.x, d.y, d.z);
  }
  return in;
}

// Any coefficients in a table.
std::vector<float> coefficients(Random& random, int count) {
  std::vector<float> f;
  for (int i = 0; i < count; ++i) f.push_back(static_cast<float>(random.number(-1, 1)));
  return f;
}

Measured measure_basis(const Run& run) {
  Random random(stream);
  const Columns in = directions(random, 1000), found = all_results(run, Formula::sh_basis, in);
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const glm::dvec3 d = vector_at(in, 0, i);
    for (int k = 0; k < most; ++k) {
      m.add(std::fabs(found[static_cast<std::size_t>(k)][i] - harmonic(k, glm::normalize(d))), [&] {
        return place({{"coefficient", static_cast<double>(k)}, {"x", d.x}, {"y", d.y}, {"z", d.z}});
      });
    }
  }
  return m;
}

Measured measure_orthonormal(const Run& run) {
  Columns in;
  std::vector<double> weights;
  each_direction([&](const glm::dvec3& d, double weight) {
    add_call(in, d.x, d.y, d.z);
    weights.push_back(weight);
  });
  const Columns found = all_results(run, Formula::sh_basis, in);
  Measured m;
  for (std::size_t a = 0; a < most; ++a) {
    for (std::size_t b = 0; b < most; ++b) {
      double sum = 0;
      for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * found[a][i] * found[b][i];
      m.add(std::fabs(sum - (a == b ? 1 : 0)), [&] {
        return place({{"a", static_cast<double>(a)}, {"b", static_cast<double>(b)}});
      });
    }
  }
  return m;
}

// Sum over a band of the products in two directions: (2 l + 1) / (4 pi) P_l of the cosine between them. Beside its largest value.
Measured measure_addition(const Run& run) {
  Random random(stream + 1);
  const Columns in = directions(random, 500), other = directions(random, 500);
  const Columns found = all_results(run, Formula::sh_basis, in), found_other = all_results(run, Formula::sh_basis, other);
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double cosine = glm::dot(glm::normalize(vector_at(in, 0, i)), glm::normalize(vector_at(other, 0, i)));
    for (int l = 0; l < 6; ++l) {
      double sum = 0;
      for (int k = l * l; k < (l + 1) * (l + 1); ++k)
        sum += found[static_cast<std::size_t>(k)][i] * found_other[static_cast<std::size_t>(k)][i];
      const double truth = std::legendre(static_cast<unsigned>(l), std::clamp(cosine, -1.0, 1.0));
      m.add(std::fabs(sum * 4 * std::numbers::pi / (2 * l + 1) - truth), [&] {
        return place({{"band", static_cast<double>(l)}, {"cosine", cosine}});
      });
    }
  }
  return m;
}

// Every order, of which the bands beyond must not matter.
Measured measure_value(const Run& run) {
  Random random(stream + 2);
  const Columns in = directions(random, 300);
  Measured m;
  for (int order = 1; order <= 6; ++order) {
    const std::vector<float> f = coefficients(random, most);
    Calls calls{Formula::sh_value, in, {}, f};
    calls.phase.kind = static_cast<PhaseKind>(order);
    const Columns found = run(calls);
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const glm::dvec3 d = glm::normalize(vector_at(in, 0, i));
      double truth = 0;
      for (int k = 0; k < order * order; ++k) truth += static_cast<double>(f[static_cast<std::size_t>(k)]) * harmonic(k, d);
      m.add(std::fabs(found[0][i] - truth), [&] {
        return place({{"order", static_cast<double>(order)}, {"x", d.x}, {"y", d.y}, {"z", d.z}});
      });
    }
  }
  return m;
}

// Of a table of coefficients about z: g(cos) = sum_l g_l y_l0.
double zonal(std::span<const float> g, double cosine) {
  double sum = 0;
  for (int l = 0; l < 6; ++l) {
    sum += static_cast<double>(g[static_cast<std::size_t>(l)]) * std::sqrt((2 * l + 1) / (4 * std::numbers::pi)) *
           std::legendre(static_cast<unsigned>(l), std::clamp(cosine, -1.0, 1.0));
  }
  return sum;
}

// The turned function, asked in other directions, is g of the angle from its axis.
Measured measure_rotated(const Run& run) {
  Random random(stream + 3);
  const Columns axes = directions(random, 200);
  const std::vector<float> g = coefficients(random, 6);
  const Columns found = all_results(run, Formula::sh_rotated, axes, g);
  Measured m;
  for (std::size_t i = 0; i < axes[0].size(); ++i) {
    const glm::dvec3 axis = glm::normalize(vector_at(axes, 0, i)), d = random.direction();
    double sum = 0;
    for (int k = 0; k < most; ++k) sum += found[static_cast<std::size_t>(k)][i] * harmonic(k, d);
    m.add(std::fabs(sum - zonal(g, glm::dot(axis, d))), [&] { return place({{"x", axis.x}, {"y", axis.y}, {"z", axis.z}}); });
  }
  return m;
}

// (f * g)(d) = int f(w) g(w . d) dw.
Measured measure_convolved(const Run& run) {
  Random random(stream + 4);
  std::vector<float> table = coefficients(random, 6 + most);
  const Columns in(1, std::vector<double>(1, 1.0)), found = all_results(run, Formula::sh_convolve, in, table);
  const std::span<const float> g(table.data(), 6), f(table.data() + 6, most);
  Measured m;
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 d = random.direction();
    double truth = 0, sum = 0;
    each_direction([&](const glm::dvec3& w, double weight) {
      double value = 0;
      for (int k = 0; k < most; ++k) value += static_cast<double>(f[static_cast<std::size_t>(k)]) * harmonic(k, w);
      truth += weight * value * zonal(g, glm::dot(w, d));
    });
    for (int k = 0; k < most; ++k) sum += found[static_cast<std::size_t>(k)][0] * harmonic(k, d);
    m.add(std::fabs(sum - truth), [&] { return place({{"x", d.x}, {"y", d.y}, {"z", d.z}}); });
  }
  return m;
}

// Three functions peaked about directions of their own, against sums over the sphere. Beside the order squared over 4 pi, which
// is the value of each at its peak.
Measured measure_triple(const Run& run) {
  Random random(stream + 5);
  Measured m;
  for (const int order : {1, 3, 4, 6}) {
    Columns in;
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 a = random.direction(), b = random.direction(), c = random.direction();
      add_call(in, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z);
    }
    const std::vector<float> products = triple_products(order);
    Calls calls{Formula::sh_triple_product, in, {}, products};
    calls.phase.kind = static_cast<PhaseKind>(order);
    const Columns found = run(calls);
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      double truth = 0;
      each_direction([&](const glm::dvec3& w, double weight) {
        double product = weight;
        for (std::size_t k = 0; k < 3; ++k) {
          const double cosine = glm::dot(glm::normalize(vector_at(in, 3 * k, i)), w);
          double peak = 0;
          for (int l = 0; l < order; ++l) {
            peak += (2 * l + 1) / (4 * std::numbers::pi) * std::legendre(static_cast<unsigned>(l), std::clamp(cosine, -1.0, 1.0));
          }
          product *= peak;
        }
        truth += product;
      });
      const double whole = order * order / (4 * std::numbers::pi);
      m.add(std::fabs(found[0][i] - truth) / whole, [&] {
        return place({{"order", static_cast<double>(order)}, {"call", static_cast<double>(i)}});
      });
    }
  }
  return m;
}

// Band l of the most peaked function, of a convolution, and of the cosine lobes, against their integrals.
Measured measure_bands(const Run& run) {
  Random random(stream + 6);
  Columns in;
  for (const double n : {1.0, 0.0, 2.0, 8.0, 1e4}) add_call(in, n);
  for (int i = 0; i < 50; ++i) add_call(in, random.magnitude(0.1, 1e4));
  Measured m;
  for (int l = 0; l < 6; ++l) {
    Calls calls{Formula::sh_bands, in};
    calls.phase.kind = static_cast<PhaseKind>(l);
    const Columns found = run(calls);
    const double pole = harmonic(l, 0, {0, 0, 1});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const double n = in[0][i];
      // With c = e^-s the powers are smooth: int_0^1 c^n P_l(c) dc.
      const double lobe = graded_integral(60 / (n + 1), 0, 24, [&](double s) {
        return -(n + 1) * std::exp(-(n + 1) * s) * std::legendre(static_cast<unsigned>(l), std::exp(-s));
      });
      const double error =
          std::max({std::fabs(found[0][i] / pole - 1), std::fabs(found[1][i] / std::sqrt(4 * std::numbers::pi / (2 * l + 1)) - 1),
                    std::fabs(found[2][i] - lobe)});
      m.add(error, [&] { return place({{"band", static_cast<double>(l)}, {"n", n}}); });
    }
  }
  return m;
}

}  // namespace

void add_spherical_harmonics_checks(std::vector<Check>& checks) {
  checks.push_back({"sh_basis", measure_basis, "sh_basis_double", "sh_basis"});
  checks.push_back({"sh_orthonormal", measure_orthonormal, "sh_basis_double", "sh_basis"});
  checks.push_back({"sh_addition", measure_addition, "sh_basis_double", "sh_basis"});
  checks.push_back({"sh_value", measure_value, "sh_basis_double", "sh_sums"});
  checks.push_back({"sh_rotated", measure_rotated, "sh_basis_double", "sh_sums"});
  checks.push_back({"sh_convolve", measure_convolved, "sh_convolve_double", "sh_sums"});
  checks.push_back({"sh_triple_product", measure_triple, "sh_triple_double", "sh_triple"});
  checks.push_back({"sh_bands", measure_bands, "sh_bands_double", "sh_bands"});
}

}  // namespace airlight
