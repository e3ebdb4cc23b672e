#include "common/reference/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/scene/brdf.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int columns = 128;  // of the fine patches at least
constexpr int columns_for_rays = 32;
constexpr double narrow = 64;   // lobes from this shininess on are cut into patches of their own
constexpr int lobe_rings = 96;  // of those, with twice as many patches each

// Of a sum and one of patches twice as wide: their error falls with the square of it, but for kinks and steps, so that all of
// their difference is claimed.
Integral extrapolated(const glm::dvec3& fine, const glm::dvec3& coarse) {
  return {fine + (fine - coarse) / 3.0, glm::abs(fine - coarse)};
}

}  // namespace

EnvironmentLighting::EnvironmentLighting(const Environment& e) : environment_(e) {
  if (e.image) width_ = e.image->extent.width, height_ = e.image->extent.height;
  coarse_ = patches(columns / 2);
  fine_ = patches(columns);
  coarse_far_ = patches(columns_for_rays / 2);
  fine_far_ = patches(columns_for_rays);
  coarse_sky_ = patches(columns_for_rays / 4);
}

glm::dvec3 EnvironmentLighting::pixel(int column, int row) const {
  if (!environment_.image) return environment_.radiance;
  const int x = (column % width_ + width_) % width_, y = std::clamp(row, 0, height_ - 1);
  const HostImage& image = *environment_.image;
  return environment_.radiance * glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
}

glm::dvec3 EnvironmentLighting::at(double column, double row) const {
  const double left = std::floor(column), top = std::floor(row), u = column - left, v = row - top;
  const int x = static_cast<int>(left), y = static_cast<int>(top);
  return (1 - v) * ((1 - u) * pixel(x, y) + u * pixel(x + 1, y)) + v * ((1 - u) * pixel(x, y + 1) + u * pixel(x + 1, y + 1));
}

// Of a place in the image, 0..1 from the left and the top.
glm::dvec3 EnvironmentLighting::direction(double turns, double polar) const {
  const double azimuth = 2 * pi * (turns - 0.5 - environment_.rotation / 360), s = std::sin(pi * polar);
  return {s * std::sin(azimuth), std::cos(pi * polar), -s * std::cos(azimuth)};
}

glm::dvec3 EnvironmentLighting::radiance(const glm::dvec3& d) const {
  const double turns = std::atan2(d.x, -d.z) / (2 * pi) + 0.5 + environment_.rotation / 360;
  const double polar = std::atan2(std::hypot(d.x, d.z), d.y) / pi;
  return at((turns - std::floor(turns)) * width_ - 0.5, polar * height_ - 0.5);
}

// At least so many columns: pixels cut into parts, or joined.
std::vector<EnvironmentLighting::Patch> EnvironmentLighting::patches(int least) const {
  const int parts = std::max(1, (least + width_ - 1) / width_), joined = std::max(1, width_ / (2 * least) + 1);
  const int across = width_ * parts, down = height_ * parts;
  std::vector<Patch> all;
  for (int y = 0; y < down; y += joined) {
    for (int x = 0; x < across; x += joined) {
      Patch patch{};
      glm::dvec3 middle(0);
      for (int j = y; j < std::min(y + joined, down); ++j) {
        const double angle = (std::cos(pi * j / down) - std::cos(pi * (j + 1) / down)) * 2 * pi / across;
        for (int i = x; i < std::min(x + joined, across); ++i) {
          const double turns = (i + 0.5) / across, polar = (j + 0.5) / down;
          patch.power += angle * at(turns * width_ - 0.5, polar * height_ - 0.5);
          middle += angle * direction(turns, polar);
        }
      }
      patch.direction = glm::normalize(middle);
      if (patch.power != glm::dvec3(0)) all.push_back(patch);
    }
  }
  return all;
}

Integral EnvironmentLighting::reflected(const glm::dvec3& normal, const glm::dvec3& mirror, const Surface& surface,
                                        const std::function<double(const glm::dvec3&)>& transmittance) const {
  if (surface.brdf) {
    const glm::dvec3 viewer = 2 * glm::dot(normal, mirror) * normal - mirror;
    const auto sum_of = [&](const std::vector<Patch>& all) {
      glm::dvec3 sum(0);
      for (const Patch& p : all) {
        const glm::dvec3 reflection = tabulated_reflection(*surface.brdf, normal, p.direction, viewer);
        if (reflection != glm::dvec3(0)) sum += transmittance(p.direction) * reflection * p.power;
      }
      return sum;
    };
    return extrapolated(sum_of(fine_), sum_of(coarse_));
  }
  const Material& material = surface.material;
  const glm::dvec3 diffuse(material.diffuse), specular(material.specular);
  const auto n = static_cast<double>(material.shininess);
  const bool glossy = specular != glm::dvec3(0), by_lobe = glossy && n >= narrow;
  const auto by_patches = [&](const std::vector<Patch>& all) {
    glm::dvec3 sum(0);
    for (const Patch& p : all) {
      const double cosine = glm::dot(normal, p.direction);
      if (!(cosine > 0)) continue;
      glm::dvec3 reflection = diffuse * (cosine / pi);
      if (glossy && !by_lobe)
        reflection += specular * ((n + 1) / (2 * pi) * std::pow(std::max(0.0, glm::dot(mirror, p.direction)), n));
      if (reflection != glm::dvec3(0)) sum += transmittance(p.direction) * reflection * p.power;
    }
    return sum;
  };
  // In rings of equal weight about the mirror direction.
  const glm::dvec3 side =
      glm::normalize(std::fabs(mirror.x) < 0.5 ? glm::cross(mirror, {1, 0, 0}) : glm::cross(mirror, {0, 1, 0}));
  const glm::dvec3 other = glm::cross(mirror, side);
  const auto by_rings = [&](int rings) {
    glm::dvec3 sum(0);
    for (int k = 0; k < rings; ++k) {
      const double cosine = std::pow((k + 0.5) / rings, 1 / (n + 1)), sine = std::sqrt((1 - cosine) * (1 + cosine));
      for (int i = 0; i < 2 * rings; ++i) {
        const double angle = pi * (i + 0.5) / rings;
        const glm::dvec3 u = cosine * mirror + sine * (std::cos(angle) * side + std::sin(angle) * other);
        if (glm::dot(normal, u) > 0) sum += transmittance(u) * radiance(u);
      }
    }
    return sum * specular / (2.0 * rings * rings);
  };
  glm::dvec3 fine = by_patches(fine_), coarse = by_patches(coarse_);
  if (by_lobe) fine += by_rings(lobe_rings), coarse += by_rings(lobe_rings / 2);
  return extrapolated(fine, coarse);
}

Integral EnvironmentLighting::scattered(const std::function<Integral(const RelativeLight&)>& scattered) const {
  LightSource source;
  source.type = LightType::directional;
  const auto sum_of = [&](const std::vector<Patch>& all) {
    Integral sum;
    for (const Patch& p : all) {
      source.direction = -p.direction, source.power = p.power;
      const Integral part = scattered({source, glm::dvec3(0)});
      sum.value += part.value, sum.error += part.error;
    }
    return sum;
  };
  const Integral fine = sum_of(fine_far_), all = extrapolated(fine.value, sum_of(coarse_far_).value);
  return {all.value, fine.error + all.error};
}

}  // namespace airlight
