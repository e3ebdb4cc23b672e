// Tabulated reflectances: the angles of the half vector, lookups, lobes of harmonics.
#include <algorithm>
#include <numbers>

#include "common/plan/brdf.h"
#include "tests/formulas/checks/random.h"
#include "tests/formulas/checks/sphere.h"
#include "tests/parity/brdfs.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 270;
constexpr double pi = std::numbers::pi;

struct Angles {
  double half, difference, phi;
};

// By the frame of the half vector itself: its x axis is what becomes of a tangent that is tilted with the normal.
Angles angles_of(const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v) {
  const glm::dvec3 h = glm::normalize(l + v), y = glm::normalize(glm::cross(n, h)), x = glm::cross(y, h);
  const double phi = std::atan2(glm::dot(l, y), glm::dot(l, x));
  return {std::atan2(glm::length(glm::cross(n, h)), glm::dot(n, h)), std::atan2(glm::length(glm::cross(h, l)), glm::dot(h, l)),
          phi < 0 ? phi + pi : phi};
}

double looked_up(const Brdf& brdf, int channel, const Angles& a) {
  const glm::ivec3& n = brdf.size;
  const double x = std::clamp(std::sqrt(a.half / (pi / 2)) * n.x - 0.5, 0.0, n.x - 1.0),
               y = std::clamp(a.difference / (pi / 2) * n.y - 0.5, 0.0, n.y - 1.0), z = a.phi / pi * n.z - 0.5;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = std::min(static_cast<int>(x), n.x - 2) + (corner & 1),
              j = std::min(static_cast<int>(y), n.y - 2) + (corner >> 1 & 1), k = static_cast<int>(std::floor(z)) + (corner >> 2);
    const double weight = (1 - std::fabs(x - i)) * (1 - std::fabs(y - j)) * (1 - std::fabs(z - k));
    const int at = ((channel * n.x + i) * n.y + j) * n.z + (k + n.z) % n.z;
    sum += weight * static_cast<double>(brdf.values[static_cast<std::size_t>(at)]);
  }
  return sum;
}

// Ways to the light and the viewer above the horizon of a normal, by chance: everywhere, and as a mirror would have them.
Columns ways(Random& random, int count) {
  Columns in;
  while (in.empty() || in[0].size() < static_cast<std::size_t>(count)) {
    const glm::dvec3 n = random.direction(), l = random.direction();
    const double size = random.magnitude(1e-3, 3);
    const glm::dvec3 near = glm::normalize(2 * glm::dot(n, l) * n - l + size * random.direction());
    if (glm::dot(n, l) < 1e-3 || glm::dot(n, near) < 1e-3) continue;
    add_call(in, n.x, n.y, n.z, l.x, l.y, l.z, near.x, near.y, near.z);
  }
  return in;
}

struct Ways {
  glm::dvec3 normal, light, viewer;
  Ways(const Columns& in, std::size_t i)
      : normal(glm::normalize(vector_at(in, 0, i))),
        light(glm::normalize(vector_at(in, 3, i))),
        viewer(glm::normalize(vector_at(in, 6, i))) {}
};

// An error of phi counts as it moves the light.
Measured measure_angles(const Run& run) {
  Random random(stream);
  const Columns in = ways(random, 20000);
  const Columns found = run({Formula::half_angles, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const Ways w(in, i);
    const Angles truth = angles_of(w.normal, w.light, w.viewer);
    const double turned =
        std::fabs(std::remainder(found[2][i] - truth.phi, pi)) * std::sin(truth.half) * std::sin(truth.difference);
    m.add(std::max({std::fabs(found[0][i] - truth.half), std::fabs(found[1][i] - truth.difference), turned}), [&] {
      return place({{"theta_half", truth.half}, {"theta_difference", truth.difference}, {"phi", truth.phi}});
    });
  }
  return m;
}

Measured measure_reflection(const Run& run) {
  Random random(stream + 1);
  Measured m;
  for (const glm::ivec3 size : {glm::ivec3(2, 2, 2), glm::ivec3(9, 7, 5)}) {
    const std::shared_ptr<const Brdf> brdf = microfacet_table(size, 0.5, 0.6);
    const auto largest = static_cast<double>(*std::max_element(brdf->values.begin(), brdf->values.end()));
    const std::vector<float> table = brdf_tables(std::span(&brdf, 1));
    Columns in = ways(random, 10000);
    add_call(in, 0, 1, 0, 0, 1, 0, 0, 1, 0), add_call(in, 0, 0, 1, 0.6, 0, -0.8, 0, 0, 1);
    const Columns found = run({Formula::brdf_reflection, in, {}, table});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const Ways w(in, i);
      const double cosine = std::max(glm::dot(w.normal, w.light), 0.0);
      const bool overhead = w.light == w.viewer && w.light == w.normal;
      const Angles angles = overhead ? Angles{0, 0, 0} : angles_of(w.normal, w.light, w.viewer);
      for (std::size_t c = 0; c < 3; ++c) {
        const double truth = cosine > 0 ? cosine * looked_up(*brdf, static_cast<int>(c), angles) : 0;
        m.add(std::fabs(found[c][i] - truth) / largest, [&] {
          return place(
              {{"theta_half", angles.half}, {"theta_difference", angles.difference}, {"phi", angles.phi}, {"cosine", cosine}});
        });
      }
    }
  }
  return m;
}

// An environment that has the harmonics below band 6 alone, reflected direction by direction at the viewing angles of the table:
// beside what an even environment of its mean size would be. A part of one may be below 0, as this one is nearly everywhere.
Measured measure_environment(const Run& run, Formula formula) {
  const bool part = formula == Formula::brdf_environment_part;
  Random random(stream + 2);
  const std::shared_ptr<const Brdf> brdf = microfacet_table({24, 16, 16}, 0.5);
  std::vector<float> table;
  for (int k = 0; k < 108; ++k)
    table.push_back(static_cast<float>(random.number(-0.2, 0.2) + (k % 36 == 0 ? (part ? -3 : 3) : 0)));
  const std::vector<float> lobes = brdf_lobes(*brdf);
  table.insert(table.end(), lobes.begin(), lobes.end());
  Columns in;
  for (int i = 0; i < 12; ++i) {
    const double at = (i < 4 ? i : 3 * i - 8) / 32.0, level = 1 - at * at, slope = std::sqrt(1 - level * level);
    glm::dvec3 n = random.direction();
    if (i == 0) n = {0, 1, 0};
    const glm::dvec3 t = glm::normalize(glm::cross(n, random.direction())), v = level * n + slope * t;
    add_call(in, n.x, n.y, n.z, v.x, v.y, v.z);
  }
  const Columns found = run({formula, in, {}, table});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const glm::dvec3 n = glm::normalize(vector_at(in, 0, i)), v = glm::normalize(vector_at(in, 3, i));
    const glm::dvec3 x = glm::normalize(std::fabs(n.x) < 0.5 ? glm::cross(n, {1, 0, 0}) : glm::cross(n, {0, 1, 0})),
                     y = glm::cross(n, x);
    glm::dvec3 truth(0), even(0);
    constexpr int rings = 48;
    for (int k = 0; k < rings; ++k) {
      const double c = (k + 0.5) / rings, s = std::sqrt(1 - c * c);
      for (int a = 0; a < 2 * rings; ++a) {
        const double angle = pi * (a + 0.5) / rings, weight = c * pi / rings / rings;
        const glm::dvec3 l = c * n + s * (std::cos(angle) * x + std::sin(angle) * y);
        const Angles angles = angles_of(n, l, v);
        std::array<double, 36> basis{};
        for (int j = 0; j < 36; ++j) basis[static_cast<std::size_t>(j)] = harmonic(j, glm::dvec3(-l.z, l.x, l.y));
        for (int channel = 0; channel < 3; ++channel) {
          double value = 0;
          for (std::size_t j = 0; j < 36; ++j)
            value += basis[j] * static_cast<double>(table[static_cast<std::size_t>(36 * channel) + j]);
          const double sent = weight * looked_up(*brdf, channel, angles);
          truth[channel] += sent * value, even[channel] += sent;
        }
      }
    }
    for (int c = 0; c < 3; ++c) {
      m.add(std::fabs(found[static_cast<std::size_t>(c)][i] - (part ? truth[c] : std::max(truth[c], 0.0))) / even[c], [&] {
        return place({{"cosine", glm::dot(n, v)},
                      {"channel", double(c)},
                      {"truth", truth[c]},
                      {"found", found[static_cast<std::size_t>(c)][i]}});
      });
    }
  }
  return m;
}

}  // namespace

void add_brdf_checks(std::vector<Check>& checks) {
  checks.push_back({"half_angles", measure_angles, "half_angles_double", "half_angles"});
  checks.push_back({"brdf_reflection", measure_reflection, "brdf_reflection_double", "brdf_reflection"});
  const auto environment = [](const Run& run) { return measure_environment(run, Formula::brdf_environment); };
  const auto part = [](const Run& run) { return measure_environment(run, Formula::brdf_environment_part); };
  checks.push_back({"brdf_environment", environment, "brdf_environment", "brdf_environment"});
  checks.push_back({"brdf_environment_part", part, "brdf_environment", "brdf_environment"});
}

}  // namespace airlight
