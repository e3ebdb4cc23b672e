#include "common/plan/brdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "common/algorithms/environment_light.h"
#include "common/error.h"
#include "common/formulas/double.h"
#include "common/plan/hash.h"
#include "common/scene/brdf_directions.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int order = 6, axes = 6;

// The table of brdf_reflection().
std::vector<float> brdf_table(const Brdf& brdf) {
  const auto phis = static_cast<std::size_t>(brdf.size.z);
  std::vector<float> table;
  table.reserve(3 + brdf.values.size() / phis * (phis + 1));
  for (const int n : {brdf.size.z, brdf.size.y, brdf.size.x}) table.push_back(static_cast<float>(n));
  for (auto row = brdf.values.begin(); row != brdf.values.end(); row += brdf.size.z) {
    table.insert(table.end(), row, row + brdf.size.z);
    table.push_back(*row);
  }
  return table;
}

// The lobe of a viewing angle: its coefficients y_lm with m >= 0, those with m < 0 are 0; at l (l + 1) / 2 + m.
using Lobe = std::array<std::array<double, 3>, 21>;

Lobe lobe_of(const Brdf& brdf, double level) {
  Lobe lobe{};
  each_direction(brdf, level, [&](const glm::dvec3& light, double angle, const glm::dvec3& sent) {
    double basis[36];
    f64::sh_basis(order, light.x, light.y, light.z, basis);
    for (int l = 0; l < order; ++l) {
      for (int m = 0; m <= l; ++m) {
        const int at = l * (l + 1) / 2 + m;
        auto& to = lobe[static_cast<std::size_t>(at)];
        for (int c = 0; c < 3; ++c) to[static_cast<std::size_t>(c)] += basis[l * (l + 1) + m] * angle * sent[c];
      }
    }
  });
  return lobe;
}

double axis_angle(int axis) { return pi * axis / axes; }

// The least weights w of zonal functions about the axes, P_l times what makes them sums of products of the basis, that add up to
// given coefficients m = 0..l of a band: A w = b, w = A^T (A A^T)^-1 b. `inverse`: A^T (A A^T)^-1, axis by m.
std::array<std::array<double, order>, axes> axis_weights(int l) {
  const int n = l + 1;
  double a[order][axes], square[order][2 * order] = {};
  for (int j = 0; j < axes; ++j) {
    double basis[36];
    f64::sh_basis(order, std::sin(axis_angle(j)), 0, std::cos(axis_angle(j)), basis);
    for (int m = 0; m < n; ++m) a[m][j] = basis[l * n + m];
  }
  for (int m = 0; m < n; ++m) {
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < axes; ++j) square[m][k] += a[m][j] * a[k][j];
    }
    square[m][n + m] = 1;
  }
  for (int m = 0; m < n; ++m) {  // positive definite: no pivoting
    const double pivot = square[m][m];
    for (int k = 0; k < 2 * n; ++k) square[m][k] /= pivot;
    for (int other = 0; other < n; ++other) {
      if (other == m) continue;
      const double factor = square[other][m];
      for (int k = 0; k < 2 * n; ++k) square[other][k] -= factor * square[m][k];
    }
  }
  std::array<std::array<double, order>, axes> inverse{};
  for (std::size_t j = 0; j < axes; ++j) {
    for (int m = 0; m < n; ++m) {
      for (int k = 0; k < n; ++k) inverse[j][static_cast<std::size_t>(m)] += a[k][j] * square[k][n + m];
    }
  }
  return inverse;
}

// Edge-on the table says little.
double level_of(int node) {
  const double at = static_cast<double>(node) / (brdf_viewing_angles - 1);
  return std::max(1 - at * at, 1e-3);
}

}  // namespace

SceneBrdfs brdfs_of(const Scene& scene) {
  SceneBrdfs brdfs;
  for (const Surface& s : scene.surfaces) {
    const auto found = std::find(brdfs.all.begin(), brdfs.all.end(), s.brdf);
    brdfs.of_surface.push_back(s.brdf ? static_cast<int>(found - brdfs.all.begin()) : -1);
    if (s.brdf && found == brdfs.all.end()) brdfs.all.push_back(s.brdf);
  }
  Hash key;
  key.add(std::string_view("brdf"));
  for (const auto& brdf : brdfs.all) {
    for (int k = 0; k < 3; ++k) key.add(brdf->size[k]);
    key.bytes(std::as_bytes(std::span(brdf->values)));
  }
  brdfs.key = key.value();
  return brdfs;
}

std::vector<Material> SceneBrdfs::without_lobes(std::vector<Material> materials) const {
  for (std::size_t i = 0; i < of_surface.size(); ++i) {
    if (of_surface[i] >= 0) materials[i].specular = glm::vec3(0);
  }
  return materials;
}

std::vector<float> brdf_tables(std::span<const std::shared_ptr<const Brdf>> brdfs) {
  std::vector<float> all;
  for (const auto& brdf : brdfs) {
    const std::vector<float> table = brdf_table(*brdf);
    all.insert(all.end(), table.begin(), table.end());
  }
  return all;
}

std::vector<int> brdf_places(std::span<const std::shared_ptr<const Brdf>> brdfs) {
  std::vector<int> places;
  std::int64_t at = 0;
  for (const auto& brdf : brdfs) {
    places.push_back(static_cast<int>(at));
    at += 3 + std::int64_t{3} * brdf->size.x * brdf->size.y * (brdf->size.z + 1);
    if (at > std::int64_t{1} << 30U) throw InputError("the surfaces' tabulated reflectances have more than 2^30 values in all");
  }
  return places;
}

std::vector<float> brdf_lobes(const Brdf& brdf) {
  const Brdf from = both_sides(brdf);
  std::vector<float> lobes;
  lobes.reserve(std::size_t{2} * axes + 1);
  for (int j = 0; j < axes; ++j) lobes.push_back(static_cast<float>(std::cos(axis_angle(j))));
  for (int j = 0; j < axes; ++j) lobes.push_back(static_cast<float>(std::sin(axis_angle(j))));
  lobes.push_back(static_cast<float>(brdf_viewing_angles));
  std::array<std::array<std::array<double, order>, axes>, order> inverse;
  for (int l = 0; l < order; ++l) inverse[static_cast<std::size_t>(l)] = axis_weights(l);
  for (int node = 0; node < brdf_viewing_angles; ++node) {
    const Lobe lobe = lobe_of(from, level_of(node));
    for (std::size_t j = 0; j < axes; ++j) {
      for (std::size_t l = 0; l < order; ++l) {
        for (std::size_t c = 0; c < 3; ++c) {
          double weight = 0;
          for (std::size_t m = 0; m <= l; ++m) weight += inverse[l][j][m] * lobe[l * (l + 1) / 2 + m][c];
          lobes.push_back(static_cast<float>(weight));
        }
      }
    }
  }
  return lobes;
}

}  // namespace airlight
