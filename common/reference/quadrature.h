// Adaptive Gauss-Kronrod quadrature of three channels at once.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace airlight {

// Nodes x >= 0 of the 15-point Kronrod rule on -1..1 (mirrored for x > 0) with its weights and those of the 7-point Gauss rule in
// it (0 elsewhere). Kronrod 1965; digits as in Piessens et al., QUADPACK, 1983, routine qk15.
struct KronrodNode {
  double x, kronrod, gauss;
};
inline constexpr KronrodNode kronrod_nodes[8] = {
    {0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0},
    {0.949107912342758524526189684047851, 0.063092092629978553290700663189204, 0.129484966168869693270611432679082},
    {0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0},
    {0.741531185599394439863864773280788, 0.140653259715525918745189590510238, 0.279705391489276667901467771423780},
    {0.586087235467691130294144691693013, 0.169004726639267902826583426598550, 0},
    {0.405845151377397166906606412076961, 0.190350578064785409913256402421014, 0.381830050505118944950369775488975},
    {0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0},
    {0.000000000000000000000000000000000, 0.209482141084727828012999174891714, 0.417959183673469387755102040816327},
};

// A value and its estimated absolute error, a channel each.
struct Integral {
  glm::dvec3 value{0}, error{0};
};

// Sum of the integrals of f over [breaks[i], breaks[i+1]] for even i (a list of separate pieces), halved where needed until
// in each channel the estimated error is at most tolerance * |value| or `enough`, or `most` pieces are reached (the error tells).
// Deterministic.
Integral integrate(const std::function<glm::dvec3(double)>& f, const std::vector<double>& pieces, double tolerance,
                   const glm::dvec3& enough = glm::dvec3(0), std::size_t most = 20000);

}  // namespace airlight
