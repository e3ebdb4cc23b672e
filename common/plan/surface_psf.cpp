#include "common/plan/surface_psf.h"

#include <array>
#include <numbers>

#include "common/formulas/double.h"
#include "common/plan/zonal.h"

namespace airlight {

namespace {

constexpr std::size_t order = surface_psf_floats;
using Polynomial = std::array<double, order>;

// Legendre's of the bands below six (Bonnet's recurrence): a delta function's convolution with a zonal function of coefficients
// g_l has the value sum g_l y_l0, y_l0 = sqrt((2 l + 1) / (4 pi)) P_l, and a lobe multiplies each band.
std::array<Polynomial, order> legendre() {
  std::array<Polynomial, order> p{};
  p[0][0] = 1;
  p[1][1] = 1;
  for (std::size_t l = 2; l < order; ++l) {
    const auto n = static_cast<double>(l);
    for (std::size_t i = 0; i < order; ++i) {
      const double shifted = i > 0 ? p[l - 1][i - 1] : 0;
      p[l][i] = ((2 * n - 1) * shifted - (n - 1) * p[l - 2][i]) / n;
    }
  }
  return p;
}

void add_lobe(std::vector<float>& tables, double exponent, double scale) {
  static const std::array<Polynomial, order> bands = legendre();
  static const Zonal npsf = npsf_coefficients();
  Polynomial sum{};
  for (std::size_t l = 0; l < order; ++l) {
    const int band = static_cast<int>(l);
    const double factor = scale * npsf[l] * f64::sh_delta(band) * f64::sh_lobe_factor(band, exponent);
    for (std::size_t i = 0; i < order; ++i) sum[i] += factor * bands[l][i];
  }
  for (const double c : sum) tables.push_back(static_cast<float>(c));
}

}  // namespace

std::vector<float> surface_psf_tables(const std::vector<float>& shininess) {
  std::vector<float> tables;
  add_lobe(tables, 1, std::numbers::pi);
  for (const float n : shininess) add_lobe(tables, static_cast<double>(n), 1);
  return tables;
}

}  // namespace airlight
