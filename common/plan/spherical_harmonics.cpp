#include "common/plan/spherical_harmonics.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "common/formulas/double.h"

namespace airlight {

namespace {

// Gauss-Legendre of eight nodes in z, equal steps in azimuth: exact for polynomials of degree 15, three times the largest band.
constexpr std::array half_node{0.18343464249564980, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
constexpr std::array half_weight{0.36268378337836198, 0.31370664587788729, 0.22238103445337447, 0.10122853629037626};
constexpr int steps = 16;

struct Sample {
  double weight = 0;
  std::array<double, 36> basis{};
};

std::vector<Sample> samples(int order) {
  std::vector<Sample> all;
  for (std::size_t i = 0; i < 2 * half_node.size(); ++i) {
    const double z = i % 2 == 0 ? half_node[i / 2] : -half_node[i / 2], r = std::sqrt(1 - z * z);
    for (int k = 0; k < steps; ++k) {
      const double azimuth = 2 * std::numbers::pi * k / steps;
      Sample sample;
      sample.weight = half_weight[i / 2] * 2 * std::numbers::pi / steps;
      f64::sh_basis(order, r * std::cos(azimuth), r * std::sin(azimuth), z, sample.basis.data());
      all.push_back(sample);
    }
  }
  return all;
}

}  // namespace

std::vector<float> triple_products(int order) {
  const std::vector<Sample> all = samples(order);
  const auto count = static_cast<std::size_t>(order) * static_cast<std::size_t>(order);
  std::vector<float> table{0};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t k = 0; k < count; ++k) {
        double sum = 0;
        for (const Sample& s : all) sum += s.weight * s.basis[i] * s.basis[j] * s.basis[k];
        if (std::fabs(sum) < 1e-9) continue;  // those that are not 0 are above 1e-3
        for (const double v : {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k), sum}) {
          table.push_back(static_cast<float>(v));
        }
        table[0] += 1;
      }
    }
  }
  return table;
}

}  // namespace airlight
