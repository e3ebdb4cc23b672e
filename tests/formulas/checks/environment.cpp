// Light of an environment: the table of mean optical depths and their series, lookups in images, lobes above a horizon.
#include <algorithm>

#include "common/plan/environment.h"
#include "tests/formulas/checks/random.h"
#include "tests/formulas/checks/sphere.h"
#include "tests/formulas/rows.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 250;
constexpr double pi = std::numbers::pi;

Measured measure_depth_table(const Run& run) {
  Columns in;
  std::vector<double> truth;
  for (const auto& row : csv_rows("reference/average_optical_depth.csv")) {
    const double u = number(row[0]);
    add_call(in, u * u);
    truth.push_back(number(row[1]));
  }
  const Columns found = run({Formula::average_gaussian_depth, in});
  Measured m;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    m.add(std::fabs(found[0][i] - truth[i]), [&] { return place({{"squared", in[0][i]}, {"truth", truth[i]}}); });
  }
  return m;
}

// exp(-u^2) int_0^1 exp(u^2 t^2) dt, near the end where it comes from.
Measured measure_depth(const Run& run) {
  Random random(stream);
  Columns in;
  for (const double squared : {0.0, 1e-30, 1e20, 4e30}) add_call(in, squared);
  for (int i = 0; i < 4000; ++i) add_call(in, random.magnitude(1e-6, 1e6));
  const Columns found = run({Formula::average_gaussian_depth, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double s = in[0][i];
    const double w = 1 / (2 * s);
    const double dawson = s > 500 ? w * (1 + w * (1 + w * (3 + w * (15 + w * 105))))
                                  : graded_integral(0, 1, 24, [s](double t) { return std::exp(s * (t - 1) * (t + 1)); });
    m.add(relative_error(found[0][i], dawson * std::sqrt(pi) / 2), [&] { return place({{"squared", s}}); });
  }
  return m;
}

Environment random_image(Random& random, Extent extent) {
  auto image = std::make_shared<HostImage>(extent, 3);
  for (float& v : image->values) v = static_cast<float>(random.number());
  return {image, {1, 1, 1}, 77};
}

// Every direction's place, and the values around it, by the C library.
Measured measure_value(const Run& run) {
  Random random(stream + 1);
  Measured m;
  for (const Extent extent : {Extent{4, 2}, Extent{32, 16}}) {
    const Environment e = random_image(random, extent);
    const std::vector<float> all = environment_table(e, {});
    Columns in;
    for (const double s : {-1.0, 1.0}) add_call(in, s, 0, 0), add_call(in, 0.001, s, 0), add_call(in, 0, 0, s);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 d = random.direction();
      add_call(in, d.x, d.y, d.z);
    }
    for (int channel = 0; channel < 3; ++channel) {
      Calls calls{Formula::environment_value, in, {}, std::span(all).subspan(environment_image_at(0))};
      calls.phase.kind = static_cast<PhaseKind>(channel);
      const Columns found = run(calls);
      for (std::size_t i = 0; i < in[0].size(); ++i) {
        const glm::dvec3 d = vector_at(in, 0, i);
        const double turns = std::atan2(d.x, -d.z) / (2 * pi) + 0.5 + e.rotation / 360,
                     polar = std::atan2(std::hypot(d.x, d.z), d.y) / pi;
        const double x = turns * extent.width - 0.5, y = std::clamp(polar * extent.height - 0.5, 0.0, extent.height - 1.0);
        const auto pixel = [&](double column, double row) {
          const int k = static_cast<int>(column);
          return static_cast<double>(e.image->at((k % extent.width + extent.width) % extent.width,
                                                 std::min(static_cast<int>(row), extent.height - 1), channel));
        };
        const double i0 = std::floor(x), j0 = std::floor(y), u = x - i0, v = y - j0;
        const double truth = (1 - v) * ((1 - u) * pixel(i0, j0) + u * pixel(i0 + 1, j0)) +
                             v * ((1 - u) * pixel(i0, j0 + 1) + u * pixel(i0 + 1, j0 + 1));
        m.add(std::fabs(found[0][i] - truth), [&] {
          return place({{"width", double(extent.width)}, {"x", d.x}, {"y", d.y}, {"z", d.z}});
        });
      }
    }
  }
  return m;
}

// The share of a lobe above a horizon by a sum over the sphere about the lobe's axis: of ring after ring, of equal weight, the
// part above.
Measured measure_share(const Run& run) {
  Random random(stream + 2);
  Measured m;
  for (const double n : {0.0, 1.0, 7.0, 50.0, 1000.0, 1e4}) {
    const std::vector<float> shininess{static_cast<float>(n)};
    const std::vector<float> all = environment_table({}, shininess);
    Columns in;
    for (const double c : {0.0, 0.5, 1.0}) add_call(in, c);
    for (int i = 0; i < 40; ++i) add_call(in, random.magnitude(0.001, 1));
    const Columns found = run({Formula::environment_share, in, {}, std::span(all).subspan(environment_lobe_floats)});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const double level = in[0][i], height = std::sqrt(std::max(0.0, 1 - level * level));
      double truth = 0;
      constexpr int rings = 20000;
      for (int k = 0; k < rings; ++k) {
        const double c = std::pow((k + 0.5) / rings, 1 / (n + 1)), s = std::sqrt(1 - c * c);
        // Above where c level + s height cos(angle) > 0.
        const double edge = s * height > 0 ? std::clamp(-c * level / (s * height), -1.0, 1.0) : -1;
        truth += std::acos(edge) / pi / rings;
      }
      m.add(std::fabs(found[0][i] - truth), [&] { return place({{"n", n}, {"cosine", level}, {"truth", truth}}); });
    }
  }
  return m;
}

// What a lobe reflects of an environment that has the harmonics of bands below 6 alone is its integral; of the image, by sums
// over its pixels.
Measured measure_reflection(const Run& run) {
  Random random(stream + 3);
  const Environment e = random_image(random, {32, 16});
  const EnvironmentHarmonics h = environment_harmonics(e);
  const std::vector<float> shininess{8};
  const std::vector<float> all = environment_table(e, shininess);
  Measured m;
  for (const std::size_t lobe : {std::size_t{0}, std::size_t{1}}) {
    const double n = lobe == 0 ? 1 : 8;
    Columns in;
    for (int i = 0; i < 60; ++i) {
      const glm::dvec3 d = random.direction();
      add_call(in, d.x, d.y, d.z);
    }
    const Columns found = run({Formula::environment_reflection,
                               in,
                               {},
                               std::span(all).subspan(lobe * environment_lobe_floats + environment_share_floats)});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const glm::dvec3 d = glm::normalize(vector_at(in, 0, i));
      // Gauss-Legendre about the axis of the lobe, whose edge is that of its hemisphere.
      const glm::dvec3 side = glm::normalize(std::fabs(d.x) < 0.5 ? glm::cross(d, {1, 0, 0}) : glm::cross(d, {0, 1, 0})),
                       other = glm::cross(d, side);
      glm::dvec3 truth(0);
      for (std::size_t k = 0; k < 8; ++k) {
        const double c = 0.5 + (k % 2 == 0 ? 0.5 : -0.5) * gauss_node[k / 2], s = std::sqrt(1 - c * c);
        const double weight = gauss_weight[k / 2] / 2 * (n + 1) * std::pow(c, n) / 16;
        for (int a = 0; a < 16; ++a) {
          const double angle = pi * a / 8;
          const glm::dvec3 w = c * d + s * (std::cos(angle) * side + std::sin(angle) * other);
          for (int channel = 0; channel < 3; ++channel) {
            double value = 0;
            for (int j = 0; j < 36; ++j) {
              value +=
                  h[static_cast<std::size_t>(channel)][static_cast<std::size_t>(j)] * harmonic(j, glm::dvec3(-w.z, w.x, w.y));
            }
            truth[channel] += weight * value;
          }
        }
      }
      for (int c = 0; c < 3; ++c) {
        m.add(std::fabs(found[static_cast<std::size_t>(c)][i] - std::max(truth[c], 0.0)), [&] {
          return place({{"n", n}, {"x", d.x}, {"y", d.y}, {"z", d.z}});
        });
      }
    }
  }
  return m;
}

// int_0^1 (h, g) exp(-(h + 2 g) t) dt, and h exp(-h).
Measured measure_scattered(const Run& run) {
  Random random(stream + 5);
  Columns in;
  for (const double h : {0.0, 1e-38, 1e-20, 1.0, 1e4, 1e30}) {
    for (const double g : {0.0, 1e-38, 1e-20, 1.0, 1e4}) add_call(in, h, g);
  }
  for (int i = 0; i < 2000; ++i) add_call(in, random.magnitude(1e-6, 60), random.magnitude(1e-6, 60));
  const Columns found = run({Formula::environment_scattered, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double h = in[0][i], g = in[1][i], both = h + 2 * g, mean = both > 0 ? -std::expm1(-both) / both : 1;
    const double error = std::max(
        {std::fabs(found[0][i] - h * mean), std::fabs(found[1][i] - g * mean), std::fabs(found[2][i] - h * std::exp(-h))});
    m.add(error, [&] { return place({{"h", h}, {"g", g}}); });
  }
  return m;
}

// exp(-g), and int_0^g exp(-2 t) dt.
Measured measure_scattered_to_surface(const Run& run) {
  Random random(stream + 6);
  Columns in;
  for (const double g : {0.0, 1e-38, 1e-20, 1.0, 86.0, 1e4, 1e30}) add_call(in, g);
  for (int i = 0; i < 2000; ++i) add_call(in, random.magnitude(1e-6, 60));
  const Columns found = run({Formula::environment_scattered_to_surface, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double g = in[0][i];
    m.add(std::max(std::fabs(found[0][i] - std::exp(-g)), std::fabs(found[1][i] + std::expm1(-2 * g) / 2)), [&] {
      return place({{"g", g}});
    });
  }
  return m;
}

// A function linear along each axis, of which lookups between nodes are exact; beyond the nodes it stands still. Beside its
// largest value.
Measured measure_lattice(const Run& run) {
  Random random(stream + 7);
  const auto value = [](double x, double y, double z) { return 1 + 0.25 * x + 0.5 * x * y + 0.125 * y * z; };
  std::vector<float> table{77};
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 5; ++i) table.push_back(static_cast<float>(value(i, j, k)));
    }
  }
  table.resize(table.size() + depth_lattice_padding);
  Columns in;
  for (int i = 0; i < 4000; ++i) add_call(in, random.number(-2, 7), random.number(-2, 6), random.number(-2, 5));
  const Columns found = run({Formula::value_among_nodes, in, {}, table});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double truth = value(std::clamp(in[0][i], 0.0, 4.0), std::clamp(in[1][i], 0.0, 3.0), std::clamp(in[2][i], 0.0, 2.0));
    m.add(std::fabs(found[0][i] - truth) / value(4, 3, 2), [&] {
      return place({{"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}});
    });
  }
  return m;
}

}  // namespace

void add_environment_checks(std::vector<Check>& checks) {
  checks.push_back(
      {"average_gaussian_depth_table", measure_depth_table, "average_gaussian_depth_double", "average_gaussian_depth"});
  checks.push_back({"average_gaussian_depth", measure_depth, "average_gaussian_depth_double", "average_gaussian_depth"});
  checks.push_back({"environment_value", measure_value, "environment_value_double", "environment_value"});
  checks.push_back({"environment_share", measure_share, "environment_share", "environment_share"});
  checks.push_back({"environment_scattered", measure_scattered, "environment_scattered_double", "environment_scattered"});
  checks.push_back({"environment_scattered_to_surface", measure_scattered_to_surface, "environment_scattered_double",
                    "environment_scattered"});
  checks.push_back({"value_among_nodes", measure_lattice, "grid_value_double", "depth_lookup"});
  checks.push_back({"environment_reflection", measure_reflection, "environment_reflection_double", "environment_reflection"});
}

}  // namespace airlight
