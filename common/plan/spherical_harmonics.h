// Spherical harmonics: what of common/formulas/spherical_harmonics.h is made once, in double.
#pragma once

#include <vector>

namespace airlight {

// The integrals of three basis functions that are not 0, for expansions of `order` 1..6, as sh_triple_product() takes them.
std::vector<float> triple_products(int order);

}  // namespace airlight
