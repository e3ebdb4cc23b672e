#include "common/reference/quadrature.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>

namespace airlight {

namespace {

struct Piece {
  double begin = 0, end = 0;
  glm::dvec3 value{0}, error{0};
};

// The error estimate is QUADPACK's: |Kronrod - Gauss|, sharpened by how much f varies, never below rounding.
Piece measure(const std::function<glm::dvec3(double)>& f, double begin, double end) {
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  glm::dvec3 at[15];
  int n = 0;
  glm::dvec3 kronrod(0), gauss(0), size(0);
  for (const KronrodNode& node : kronrod_nodes) {
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec3 v = f(middle + side * node.x * half);
      at[n++] = v;
      kronrod += node.kronrod * v;
      gauss += node.gauss * v;
      size += node.kronrod * glm::abs(v);
      if (node.x == 0) break;
    }
  }
  glm::dvec3 variation(0);
  n = 0;
  for (const KronrodNode& node : kronrod_nodes) {
    for (int side = 0; side < (node.x == 0 ? 1 : 2); ++side) variation += node.kronrod * glm::abs(at[n++] - 0.5 * kronrod);
  }
  Piece piece{begin, end, half * kronrod, glm::dvec3(0)};
  for (int c = 0; c < 3; ++c) {
    double error = std::fabs(kronrod[c] - gauss[c]);
    if (variation[c] > 0 && error > 0) error = variation[c] * std::min(1.0, std::pow(200 * error / variation[c], 1.5));
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    piece.error[c] = std::fabs(half) * std::max(error, rounding * size[c]);
  }
  return piece;
}

}  // namespace

Integral integrate(const std::function<glm::dvec3(double)>& f, const std::vector<double>& ends, double tolerance,
                   const glm::dvec3& enough, std::size_t most) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) pieces.push_back(measure(f, ends[i], ends[i + 1]));
  for (;;) {
    Integral sum;
    for (const Piece& p : pieces) {
      sum.value += p.value;
      sum.error += p.error;
    }
    const glm::dvec3 allowed = glm::max(tolerance * glm::abs(sum.value), enough) + 1e-300;
    const auto within = [](const glm::dvec3& error, const glm::dvec3& limit) {
      return error.x <= limit.x && error.y <= limit.y && error.z <= limit.z;
    };
    if (within(sum.error, allowed) || pieces.size() >= most) return sum;

    // Halve every piece that has more than half its share of what is allowed.
    const glm::dvec3 share = allowed * (0.5 / static_cast<double>(pieces.size()));
    const std::size_t before = pieces.size();
    for (std::size_t i = 0; i < before; ++i) {
      const Piece p = pieces[i];
      const double middle = 0.5 * (p.begin + p.end);
      if (within(p.error, share) || middle == p.begin || middle == p.end) continue;
      pieces[i] = measure(f, p.begin, middle);
      pieces.push_back(measure(f, middle, p.end));
    }
    if (pieces.size() == before) return sum;
  }
}

}  // namespace airlight
