#include "common/plan/gauss_legendre.h"

namespace airlight {

namespace {

// cos(x) for x in 0..pi by its series: the same on every machine, where the C library's is not.
double cosine(double x) {
  double term = 1, sum = 1;
  for (int k = 1; k < 20; ++k) {
    term *= -x * x / ((2 * k - 1) * (2 * k));
    sum += term;
  }
  return sum;
}

}  // namespace

GaussLegendre::GaussLegendre(int n) : node(static_cast<std::size_t>(n)), weight(node.size()), before(node.size() * node.size()) {
  std::vector<double> at, weights;
  for (int i = 0; i < n; ++i) {
    double x = -cosine(3.14159265358979323846 * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {  // Newton's, on Legendre's polynomial
      double last = 1, value = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * last) / k;
        last = value;
        value = next;
      }
      slope = n * (last - x * value) / (1 - x * x);
      x -= value / slope;
    }
    at.push_back(x);
    weights.push_back(2 / ((1 - x * x) * slope * slope));
    node[static_cast<std::size_t>(i)] = static_cast<float>(x);
    weight[static_cast<std::size_t>(i)] = static_cast<float>(weights.back());
  }
  // The polynomial that is 1 at node j and 0 at the others is w_j sum_m (m + 1/2) P_m(x_j) P_m(x), and
  // int_-1^x P_m = (P_m+1(x) - P_m-1(x)) / (2 m + 1).
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = 0; j < at.size(); ++j) {
      double there[2] = {1, at[j]}, here[2] = {1, at[i]}, sum = 1 + at[i];
      for (int m = 1; m < n; ++m) {
        const double next_here = ((2 * m + 1) * at[i] * here[1] - m * here[0]) / (m + 1);
        const double next_there = ((2 * m + 1) * at[j] * there[1] - m * there[0]) / (m + 1);
        sum += there[1] * (next_here - here[0]);
        here[0] = here[1], here[1] = next_here;
        there[0] = there[1], there[1] = next_there;
      }
      before[i * at.size() + j] = static_cast<float>(0.5 * weights[j] * sum);
    }
  }
}

}  // namespace airlight
