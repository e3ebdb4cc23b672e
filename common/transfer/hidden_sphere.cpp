#include "common/transfer/hidden_sphere.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/formulas/double.h"

namespace airlight {

SphereOfDirections::SphereOfDirections(int count) {
  // Turned by the golden angle from one to the next.
  constexpr double cosine = -0.73736887807831985597, sine = 0.67549029426152362720;
  double x = 1, y = 0;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt((1 - z) * (1 + z));
    directions_.emplace_back(r * y, z, -r * x);
    const glm::dvec3 d(directions_.back());
    const double scale = 1 / glm::length(d);
    double v[36];
    f64::sh_basis(6, -d.z * scale, d.x * scale, d.y * scale, v);
    auto& basis = basis_.emplace_back();
    for (std::size_t k = 0; k < basis.size(); ++k) basis[k] = static_cast<float>(v[k]);
    const double turned = x * cosine - y * sine;
    y = x * sine + y * cosine, x = turned;
    const double length = std::sqrt(x * x + y * y);
    x /= length, y /= length;
  }
}

HiddenSphere hidden_sphere(const Occluders& occluders, const SphereOfDirections& sphere, const glm::dvec3& from,
                           const glm::dvec3& normal) {
  constexpr std::size_t stride = 8;
  constexpr unsigned most = 16;
  const glm::vec3 n(normal);
  HiddenSphere hidden;
  std::size_t above = 0, found = 0;
  std::array<double, SurfaceTransfer::record_floats> sum{};
  glm::vec3 directions[most];
  std::size_t numbers[most];
  unsigned count = 0;
  const auto shoot = [&] {
    if (count == 0) return;
    const unsigned bits = occluders.hidden(from, directions, count);
    above += count;
    for (unsigned i = 0; i < count; ++i) {
      if ((bits >> i & 1U) == 0) continue;
      ++found;
      const auto& basis = sphere.basis(numbers[i]);
      const double lambert = static_cast<double>(glm::dot(n, directions[i])) / std::numbers::pi;
      for (std::size_t k = 0; k < 36; ++k) {
        sum[k] += lambert * static_cast<double>(basis[k]);
        sum[36 + k] += static_cast<double>(basis[k]);
      }
    }
    count = 0;
  };
  for (std::size_t first = 0; first < stride; ++first) {
    for (std::size_t i = first; i < sphere.size(); i += stride) {
      if (!(glm::dot(n, sphere[i]) > 0)) continue;
      directions[count] = sphere[i], numbers[count] = i;
      if (++count == most) shoot();
    }
    shoot();
    if (first == 0 && above >= most && found == above) break;
  }
  if (above > 0 && found == above) hidden.kind = SurfaceTransfer::everything;
  if (found == 0 || found == above) return hidden;
  hidden.kind = 0;
  const double angle = 4 * std::numbers::pi / static_cast<double>(sphere.size());
  for (const double s : sum) hidden.record.push_back(static_cast<float>(angle * s));
  return hidden;
}

glm::dvec4 hidden_share(const HiddenSphere& hidden, const glm::dvec3& normal) {
  const double scale = std::sqrt(4 * std::numbers::pi);
  glm::dvec4 share(0);
  if (hidden.kind == SurfaceTransfer::nothing) return share;
  double v[36];
  f64::sh_basis(2, -normal.z, normal.x, normal.y, v);
  for (int k = 0; k < 4; ++k) {
    const double all = f64::sh_lobe_factor(k == 0 ? 0 : 1, 1) * v[k];
    share[k] =
        scale *
        (hidden.kind == SurfaceTransfer::everything ? all : static_cast<double>(hidden.record[static_cast<std::size_t>(k)]));
  }
  return share;
}

}  // namespace airlight
