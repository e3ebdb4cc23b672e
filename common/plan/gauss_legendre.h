// Gauss and Legendre's quadrature. Only + - * /: the same on every machine.
#pragma once

#include <vector>

namespace airlight {

// Nodes and weights of the Gauss-Legendre rule on [-1, 1], ascending; n in 1..16. What values at the nodes have in front of node
// i of them is the sum of before[i n + j] times value j.
struct GaussLegendre {
  explicit GaussLegendre(int n);
  std::vector<float> node, weight, before;
};

}  // namespace airlight
