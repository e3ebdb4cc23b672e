#include "common/plan/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/formulas/double.h"
#include "common/plan/brdf.h"
#include "common/plan/gauss_legendre.h"
#include "common/plan/hash.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int order = 6;
constexpr int least_columns = 256;  // of the projection: a coarse image is sampled between its pixels

// The constant environment is an image too.
Extent extent_of(const Environment& e) { return e.image ? e.image->extent : Extent{4, 2}; }

glm::dvec3 pixel(const Environment& e, int x, int y) {
  if (!e.image) return e.radiance;
  return e.radiance * glm::dvec3(e.image->at(x, y, 0), e.image->at(x, y, 1), e.image->at(x, y, 2));
}

// Sums over a row of each channel times cos(m azimuth) and sin(m azimuth).
struct Fourier {
  std::array<std::array<double, order>, 3> cosine{}, sine{};
};

EnvironmentHarmonics projected(std::span<const float> image) {
  const int width = static_cast<int>(image[0]), height = static_cast<int>(image[1]);
  const int parts = std::max(1, (least_columns + width - 1) / width), columns = width * parts, rows = height * parts;
  std::vector<std::array<double, order>> cosines, sines;
  for (int x = 0; x < columns; ++x) {
    const double azimuth = 2 * pi * ((x + 0.5) / columns - 0.5 - static_cast<double>(image[2]));
    auto &c = cosines.emplace_back(), &s = sines.emplace_back();
    for (std::size_t m = 0; m < order; ++m) {
      c[m] = std::cos(static_cast<double>(m) * azimuth);
      s[m] = std::sin(static_cast<double>(m) * azimuth);
    }
  }
  EnvironmentHarmonics sum{};
  for (int y = 0; y < rows; ++y) {
    const double above = pi * y / rows, below = pi * (y + 1) / rows, polar = (above + below) / 2;
    Fourier f;
    for (int x = 0; x < columns; ++x) {
      const double turns = (x + 0.5) / columns - static_cast<double>(image[2]);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const double value = f64::environment_value(image.data(), static_cast<int>(channel), turns, (y + 0.5) / rows);
        for (std::size_t m = 0; m < order; ++m) {
          f.cosine[channel][m] += value * cosines[static_cast<std::size_t>(x)][m];
          f.sine[channel][m] += value * sines[static_cast<std::size_t>(x)][m];
        }
      }
    }
    // At the azimuth 0 the harmonic m > 0 is what both m and -m share.
    double v[36];
    f64::sh_basis(order, std::sin(polar), 0, std::cos(polar), v);
    const double weight = (std::cos(above) - std::cos(below)) * 2 * pi / columns;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      for (int l = 0; l < order; ++l) {
        const int middle = l * (l + 1);
        for (int m = 0; m <= l; ++m) {
          const int right = middle + m, left = middle - m;
          const double shared = weight * v[right];
          const auto k = static_cast<std::size_t>(m);
          sum[channel][static_cast<std::size_t>(right)] += shared * f.cosine[channel][k];
          if (m > 0) sum[channel][static_cast<std::size_t>(left)] += shared * f.sine[channel][k];
        }
      }
    }
  }
  return sum;
}

// Nodes of environment_share(). In the plane of the lobe's direction and the normal a lobe cos^n is cos^n of the angle times what
// does not depend on it, so that what lies above the horizon is int cos^n over the angles there; with q the sine, (1 - q^2)^((n -
// 1) / 2). Beyond four widths of the lobe next to all of it does.
void add_shares(std::vector<float>& table, double n) {
  constexpr int nodes = 64;
  const double farthest = std::asin(std::min(1.0, 4 * std::sqrt(2 / (n + 1))));
  const double top = std::sin(farthest);
  table.push_back(static_cast<float>(nodes / top));
  const GaussLegendre rule(8);
  const auto between = [&](double from, double to) {
    double sum = 0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double at = (from + to + (to - from) * static_cast<double>(rule.node[i])) / 2;
      sum += static_cast<double>(rule.weight[i]) * std::pow(std::cos(at), n);
    }
    return sum * (to - from) / 2;
  };
  std::vector<double> above{0};
  for (int k = 0; k < nodes; ++k)
    above.push_back(above.back() + between(std::asin(top * k / nodes), std::asin(std::min(1.0, top * (k + 1) / nodes))));
  const double half = farthest < pi / 2 ? above.back() + between(farthest, pi / 2) : above.back();
  for (const double part : above) table.push_back(static_cast<float>(0.5 + 0.5 * part / half));
}

void add_lobe(std::vector<float>& table, const EnvironmentHarmonics& from, double n) {
  add_shares(table, n);
  for (const auto& channel : from) {
    for (int l = 0; l < order; ++l) {
      const double factor = f64::sh_lobe_factor(l, n);
      for (int i = l * l; i < (l + 1) * (l + 1); ++i)
        table.push_back(static_cast<float>(factor * channel[static_cast<std::size_t>(i)]));
    }
  }
}

}  // namespace

namespace {

std::size_t environment_image_floats(Extent extent) {
  return 4 + (static_cast<std::size_t>(extent.width) + 1) * (3 * static_cast<std::size_t>(extent.height) + 1);
}

}  // namespace

std::size_t environment_table_floats(const Environment& e, std::size_t shininess, std::size_t brdfs) {
  return environment_image_at(shininess, brdfs) + environment_image_floats(extent_of(e));
}

std::vector<float> environment_image(const Environment& e) {
  const Extent extent = extent_of(e);
  const double turns = e.rotation / 360;
  std::vector<float> table{static_cast<float>(extent.width), static_cast<float>(extent.height),
                           static_cast<float>(turns - std::floor(turns)), 0};
  const auto width = static_cast<std::size_t>(extent.width) + 1;
  table.resize(environment_image_floats(extent));
  float* to = table.data() + 4;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x <= extent.width; ++x) {
      const glm::dvec3 value = pixel(e, x % extent.width, y);
      for (int c = 0; c < 3; ++c)
        to[static_cast<std::size_t>(c) * width + static_cast<std::size_t>(x)] = static_cast<float>(value[c]);
    }
    to += 3 * width;
  }
  return table;
}

EnvironmentHarmonics environment_harmonics(const Environment& e) { return projected(environment_image(e)); }

std::vector<float> environment_table(const Environment& e, std::span<const float> shininess,
                                     std::span<const std::shared_ptr<const Brdf>> brdfs) {
  const std::vector<float> image = environment_image(e);
  const EnvironmentHarmonics harmonics = projected(image);
  std::vector<float> table;
  add_lobe(table, harmonics, 1);
  for (const float n : shininess) add_lobe(table, harmonics, static_cast<double>(n));
  if (!brdfs.empty()) {
    for (const auto& channel : harmonics) table.insert(table.end(), channel.begin(), channel.end());
  }
  for (const auto& brdf : brdfs) {
    const std::vector<float> lobes = brdf_lobes(*brdf);
    table.insert(table.end(), lobes.begin(), lobes.end());
  }
  table.insert(table.end(), image.begin(), image.end());
  return table;
}

std::vector<float> environment_airlight_table(const Environment& e, const Zonal& zonal) {
  std::vector<float> table;
  for (const auto& channel : environment_harmonics(e)) {
    for (int l = 0; l < order; ++l) {
      const double factor = f64::sh_zonal_factor(l) * zonal[static_cast<std::size_t>(l)];
      for (int i = l * l; i < (l + 1) * (l + 1); ++i)
        table.push_back(static_cast<float>(factor * channel[static_cast<std::size_t>(i)]));
    }
  }
  return table;
}

std::vector<float> environment_indirect_table(const Environment& e, std::span<const float> shininess, const Zonal& zonal) {
  EnvironmentHarmonics scattered = environment_harmonics(e);
  for (auto& channel : scattered) {
    for (int l = 0; l < order; ++l) {
      const double factor = f64::sh_zonal_factor(l) * zonal[static_cast<std::size_t>(l)];
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) channel[static_cast<std::size_t>(i)] *= factor;
    }
  }
  std::vector<float> table;
  add_lobe(table, scattered, 1);
  for (const float n : shininess) add_lobe(table, scattered, static_cast<double>(n));
  return table;
}

std::uint64_t environment_key(const Environment& e, std::span<const float> shininess) {
  Hash key;
  key.add(std::string_view("environment"));
  for (int c = 0; c < 3; ++c) key.add(e.radiance[c]);
  key.add(e.rotation);
  key.add(shininess.size());
  key.bytes(std::as_bytes(shininess));
  if (e.image) key.add(e.image->extent), key.bytes(std::as_bytes(std::span(e.image->values)));
  return key.value();
}

}  // namespace airlight
