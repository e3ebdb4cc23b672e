// The steps of an illumination network on the CPU against what they are meant to be: particles against the density, links against
// closed forms, the iteration against a dense solve in double and against the light that goes in and out.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <set>

#include "common/plan/network.h"
#include "tests/tolerances.h"
#include "tests/unit/network_ran.h"

namespace airlight {

namespace {

// n equations, by elimination.
std::vector<double> solve(std::vector<std::vector<double>> m, std::vector<double> right) {
  const std::size_t n = right.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t k = i + 1; k < n; ++k) pivot = std::fabs(m[k][i]) > std::fabs(m[pivot][i]) ? k : pivot;
    std::swap(m[i], m[pivot]), std::swap(right[i], right[pivot]);
    for (std::size_t k = i + 1; k < n; ++k) {
      const double factor = m[k][i] / m[i][i];
      if (factor == 0) continue;
      for (std::size_t j = i; j < n; ++j) m[k][j] -= factor * m[i][j];
      right[k] -= factor * right[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) right[i] -= m[i][j] * right[j];
    right[i] /= m[i][i];
  }
  return right;
}

// What one way of a line's list does, as a matrix: [taking particle][sending particle], straight from the links' definition, with
// transmittances and their integrals in double instead of the stored shares.
template <class Add>
void list_matrix(const RanNetwork& ran, std::size_t line, const std::vector<std::size_t>& list, std::size_t record, bool backward,
                 Add&& add) {
  const std::size_t n = list.size();
  struct Link {
    double depth;
    std::size_t ends[2];
  };
  std::vector<Link> way;
  for (std::size_t k = 0; k <= n; ++k)
    way.push_back({ran.link(line, link_depth, record + k), {list[k == 0 ? 0 : k - 1], list[k == n ? n - 1 : k]}});
  if (backward) std::reverse(way.begin(), way.end());
  for (std::size_t from = 0; from <= n; ++from) {
    double arriving = 0;  // of one unit of source in link `from`
    for (std::size_t to = from; to <= n; ++to) {
      const double lost = -std::expm1(-way[to].depth);
      const double taken = to == from ? way[to].depth - lost : arriving * lost;
      for (const std::size_t sends : way[from].ends) {
        for (const std::size_t takes : way[to].ends) add(takes, sends, 0.25 * taken * ran.area(line, list, record));
      }
      arriving = to == from ? lost : arriving * (1 - lost);
    }
  }
}

double relative_largest(const std::vector<double>& found, const std::vector<double>& truth) {
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    worst = std::max(worst, std::fabs(found[i] - truth[i]));
    largest = std::max(largest, std::fabs(truth[i]));
  }
  return worst / largest;
}

void is_dense_solution(const Scene& scene, bool gradients, ParticleSet particle_set = ParticleSet::sampled) {
  const RanNetwork ran(scene, network_lights(),
                       {.particles = 60,
                        .lines = 6,
                        .window = 4,
                        .extinction = 0,
                        .tolerance = 1e-8F,
                        .iterations = 400,
                        .particle_set = particle_set,
                        .gradients = gradients});
  const std::size_t n = ran.shape.particles;
  std::vector<std::vector<double>> taken(n, std::vector<double>(n, 0.0));
  std::vector<double> weight(n, 0.0);
  for (std::size_t line = 0; line < ran.shape.lines; ++line) {
    ran.each_list(line, [&](std::size_t, const std::vector<std::size_t>& list, std::size_t record) {
      for (const bool backward : {false, true}) {
        list_matrix(ran, line, list, record, backward, [&](std::size_t to, std::size_t from, double x) { taken[to][from] += x; });
      }
      for (std::size_t k = 0; k <= list.size(); ++k) {
        const double depth = ran.link(line, link_depth, record + k) * ran.area(line, list, record);  // half an end, both ways
        weight[list[k == 0 ? 0 : k - 1]] += depth;
        weight[list[k == list.size() ? k - 1 : k]] += depth;
      }
    });
  }
  std::vector<std::vector<double>> m(n, std::vector<double>(n));
  std::vector<double> first(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      m[i][j] = (i == j ? 1.0 : 0.0) - ran.particle(particle_albedo, i) * taken[i][j] / weight[i];
    first[i] = static_cast<double>(ran.first[4 * i]);
  }
  std::vector<double> found(n);
  for (std::size_t i = 0; i < n; ++i) found[i] = static_cast<double>(ran.sources[4 * i]);
  const double error = relative_largest(found, solve(m, first));
  std::printf("%g of the largest, %g rounds\n", error, static_cast<double>(ran.residuals[0]));
  EXPECT_LE(error, tolerance("network_dense"));
  EXPECT_LT(ran.residuals[0], 400);
}

// One Gaussian scatters all light and the other no red: particles between them have an albedo each.
Scene unlike_gaussians() {
  Scene scene = two_gaussians(1);
  scene.medium.gaussians[1].albedo = {0, 0.5, 1};
  return scene;
}

TEST(IlluminationNetwork, IterationIsTheDenseSolution) {
  is_dense_solution(two_gaussians(0.9), false);
  is_dense_solution(test_gaussian_scene(70), false, ParticleSet::gaussians);
}
TEST(IlluminationNetwork, GradientsAreTheDenseSolution) {
  is_dense_solution(two_gaussians(0.9), true);
  is_dense_solution(two_gaussians(1), true);
  is_dense_solution(unlike_gaussians(), true);
  is_dense_solution(test_gaussian_scene(70), true, ParticleSet::gaussians);
}

// Each channel is a system of its own: where nothing scatters, first sources are all; one particle scatters to itself alone.
TEST(IlluminationNetwork, GradientsWhereLittleScatters) {
  const RanNetwork black(two_gaussians(0), network_lights(), {.particles = 60, .lines = 6, .window = 4, .gradients = true});
  EXPECT_EQ(black.sources, black.first);
  EXPECT_EQ(black.residuals[0], 1);
  EXPECT_EQ(black.residuals[1], 0);
  const NetworkParts parts{.particles = 60, .lines = 6, .window = 4, .tolerance = 0, .gradients = true};
  const RanNetwork unlike(unlike_gaussians(), network_lights(), parts);
  Scene alike = unlike_gaussians();
  for (Gaussian& g : alike.medium.gaussians) g.albedo = glm::dvec3(g.albedo.x);
  const RanNetwork red(alike, network_lights(), parts);
  for (std::size_t v = 0; v < unlike.shape.particles; ++v) EXPECT_EQ(unlike.sources[4 * v], red.sources[4 * v]) << v;
  for (const bool gradients : {false, true}) {
    const RanNetwork one(two_gaussians(1), network_lights(),
                         {.particles = 1, .lines = 3, .window = 1, .tolerance = 1e-7F, .gradients = gradients});
    std::printf("one particle: %.9g of %.9g after %g rounds\n", static_cast<double>(one.sources[0]),
                static_cast<double>(one.first[0]), static_cast<double>(one.residuals[0]));
    EXPECT_GT(one.sources[0], one.first[0]);
    EXPECT_LE(one.residuals[0], gradients ? 3 : 100);
  }
}

// The same where sources depend on the direction: one unknown a particle and direction.
TEST(IlluminationNetwork, AnisotropicIterationIsTheDenseSolution) {
  const RanNetwork ran(two_gaussians(0.8), network_lights(),
                       {.particles = 20,
                        .lines = 5,
                        .window = 3,
                        .phase = {PhaseKind::henyey_greenstein, 0.5},
                        .extinction = 0,
                        .tolerance = 1e-8F,
                        .iterations = 400});
  const std::size_t n = ran.shape.particles, directions = 2 * ran.shape.lines;
  const auto phase = [&](std::size_t d, std::size_t i) {
    const auto way = [&](std::size_t k) { return glm::normalize(ran.axis(k / 2, line_direction)) * (k % 2 == 0 ? 1.0 : -1.0); };
    return 0.75 / std::pow(1.25 - glm::dot(way(d), way(i)), 1.5);
  };
  std::vector<std::vector<double>> weight(directions, std::vector<double>(n, 0.0)), could = weight, rest = weight;
  std::vector<std::vector<std::vector<double>>> taken(directions,
                                                      std::vector<std::vector<double>>(n, std::vector<double>(n, 0.0)));
  for (std::size_t d = 0; d < directions; ++d) {
    const std::size_t line = d / 2;
    ran.each_list(line, [&](std::size_t, const std::vector<std::size_t>& list, std::size_t record) {
      list_matrix(ran, line, list, record, d % 2 == 1,
                  [&](std::size_t to, std::size_t from, double x) { taken[d][to][from] += x; });
      for (std::size_t k = 0; k <= list.size(); ++k) {
        const double depth = 0.5 * ran.link(line, link_depth, record + k) * ran.area(line, list, record);
        weight[d][list[k == 0 ? 0 : k - 1]] += depth;
        weight[d][list[k == list.size() ? k - 1 : k]] += depth;
      }
    });
  }
  for (std::size_t d = 0; d < directions; ++d) {
    for (std::size_t v = 0; v < n; ++v) {
      double all = 0;
      for (std::size_t j = 0; j < directions; ++j) {
        could[d][v] += phase(d, j) * weight[d][v];
        rest[d][v] += phase(d, j) * (weight[d][v] - weight[j][v]);
        all += weight[j][v];
      }
      rest[d][v] /= all;
    }
  }
  const std::size_t all = n * directions;
  std::vector<std::vector<double>> m(all, std::vector<double>(all, 0.0));
  std::vector<double> first(all);
  for (std::size_t i = 0; i < directions; ++i) {
    for (std::size_t v = 0; v < n; ++v) {
      m[i * n + v][i * n + v] = 1;
      first[i * n + v] = static_cast<double>(ran.first[4 * (i * n + v)]);
      for (std::size_t d = 0; d < directions; ++d) {
        const double x = ran.particle(particle_albedo, v) * (phase(d, i) + rest[d][v]) / could[d][v];
        for (std::size_t from = 0; from < n; ++from) m[i * n + v][d * n + from] -= x * taken[d][v][from];
      }
    }
  }
  std::vector<double> found(all);
  for (std::size_t k = 0; k < all; ++k) found[k] = static_cast<double>(ran.sources[4 * k]);
  const double error = relative_largest(found, solve(m, first));
  std::printf("%g of the largest, %g rounds\n", error, static_cast<double>(ran.residuals[0]));
  EXPECT_LE(error, tolerance("network_dense"));
}

// At albedo 1, what leaves all lines is what the first sources put into them.
void out_is_in(const Phase& phase, DirectionSet set = DirectionSet::fibonacci, const Scene& scene = two_gaussians(1),
               bool gradients = false, ParticleSet particle_set = ParticleSet::sampled) {
  const RanNetwork ran(scene, network_lights(),
                       {.particles = 200,
                        .lines = 10,
                        .window = 5,
                        .phase = phase,
                        .extinction = 0,
                        .tolerance = 0,
                        .iterations = 400,
                        .set = set,
                        .particle_set = particle_set,
                        .gradients = gradients});
  const std::size_t n = ran.shape.particles, directions = 2 * ran.shape.lines;
  const bool isotropic = phase.kind == PhaseKind::isotropic;
  const auto value = [&](std::size_t d, std::size_t v) { return 4 * ((isotropic ? 0 : d * n) + v); };
  double in = 0, out = 0;
  for (std::size_t d = 0; d < directions; ++d) {
    const std::size_t line = d / 2;
    ran.each_list(line, [&](std::size_t, const std::vector<std::size_t>& list, std::size_t record) {
      double beam = 0;
      for (std::size_t step = 0; step <= list.size(); ++step) {
        const std::size_t k = d % 2 == 0 ? step : list.size() - step;
        const std::size_t a = list[k == 0 ? 0 : k - 1], b = list[k == list.size() ? k - 1 : k];
        const double depth = ran.link(line, link_depth, record + k);
        const auto mean = [&](const auto& of) { return 0.5 * (of(a) + of(b)); };
        in += depth * ran.area(line, list, record) *
              mean([&](std::size_t v) { return static_cast<double>(ran.first[value(d, v)]); });
        beam += -std::expm1(-depth) * (mean([&](std::size_t v) { return static_cast<double>(ran.sources[value(d, v)]); }) - beam);
      }
      out += beam * ran.area(line, list, record);
    });
  }
  std::printf("out / in - 1 = %g after %g rounds\n", out / in - 1, static_cast<double>(ran.residuals[0]));
  EXPECT_LE(std::fabs(out / in - 1), tolerance("network_energy"));
}

TEST(IlluminationNetwork, WhatGoesInComesOut) { out_is_in({}); }
TEST(IlluminationNetwork, WhatGoesInComesOutOfGradients) { out_is_in({}, DirectionSet::fibonacci, two_gaussians(1), true); }
TEST(IlluminationNetwork, WhatGoesInComesOutForward) { out_is_in({PhaseKind::henyey_greenstein, 0.7}); }
TEST(IlluminationNetwork, WhatGoesInComesOutOfGaussians) {
  Scene scene = test_gaussian_scene(80);  // unlike masses
  for (Gaussian& g : scene.medium.gaussians) g.albedo = glm::dvec3(1);
  for (const bool gradients : {false, true}) out_is_in({}, DirectionSet::fibonacci, scene, gradients, ParticleSet::gaussians);
  out_is_in({PhaseKind::henyey_greenstein, 0.7}, DirectionSet::fibonacci, scene, false, ParticleSet::gaussians);
}
TEST(IlluminationNetwork, WhatGoesInComesOutAtRandom) { out_is_in({PhaseKind::henyey_greenstein, 0.7}, DirectionSet::random); }

// A Gaussian smaller than the lattice's cells within another: its particles, most of all, stand on each other.
TEST(IlluminationNetwork, WhatGoesInComesOutOfCoincidentParticles) {
  Scene scene = two_gaussians(1);
  Gaussian& small = scene.medium.gaussians[1];
  small.center = scene.medium.gaussians[0].center, small.radius = 1e-4, small.extinction = 1e12;
  const std::vector<float> planes = network_particles(scene, network_frame(medium_box(scene, 12)), 200);
  std::set<std::array<float, 3>> places;
  for (std::size_t v = 0; v < 200; ++v) places.insert({planes[v], planes[200 + v], planes[400 + v]});
  EXPECT_LT(places.size(), 100U);
  for (const bool gradients : {false, true}) out_is_in({}, DirectionSet::fibonacci, scene, gradients);
}

// What glows by itself: where light meets nothing else it is all; where nothing gets through, all orders of it are there.
TEST(IlluminationNetwork, ThinAndOpaqueMediaGlow) {
  constexpr double albedo = 0.5;
  for (const auto& [times, gradients] : {std::pair{1e-9, false}, {1e9, false}, {1e-9, true}, {1e9, true}}) {
    Scene scene = two_gaussians(albedo);
    for (Gaussian& g : scene.medium.gaussians) g.extinction *= times, g.emission = glm::dvec3(g.extinction);
    const RanNetwork ran(
        scene, {}, {.particles = 100, .lines = 8, .window = 4, .extinction = 0, .tolerance = 1e-7F, .gradients = gradients});
    const double expected = times < 1 ? 1 : 1 / (1 - albedo);
    double worst = 0;
    for (std::size_t v = 0; v < ran.shape.particles; ++v)
      worst = std::max(worst, std::fabs(static_cast<double>(ran.sources[4 * v]) / expected - 1));
    std::printf("extinction times %g, %g rounds: off by %g\n", times, static_cast<double>(ran.residuals[0]), worst);
    EXPECT_LE(worst, tolerance("network_glow"));
  }
}

// Each particle once a line, in order, in the pixel where it is; the links of a list add up to the line through their mean place.
void links_are_lines(const NetworkParts& parts) {
  const RanNetwork ran(two_gaussians(1), {}, parts);
  double worst = 0, worst_other = 0;
  for (std::size_t line = 0; line < ran.shape.lines; ++line) {
    std::set<std::size_t> seen;
    const std::int32_t *l = ran.lines.data() + line * line_fields, *edges = ran.lines.data() + ran.shape.edges(line);
    const glm::dvec3 way = ran.axis(line, line_direction), across = ran.axis(line, line_across), down = ran.axis(line, line_down);
    ran.each_list(line, [&](std::size_t c, const std::vector<std::size_t>& list, std::size_t record) {
      const auto unit = static_cast<double>(ran.t.network.unit);
      const auto columns = static_cast<std::size_t>(l[line_pixels]);
      double before = -1e9, x = 0, y = 0;
      for (const std::size_t v : list) {
        EXPECT_TRUE(seen.insert(v).second);
        const glm::dvec3 p = glm::dvec3(ran.particle(0, v), ran.particle(1, v), ran.particle(2, v)) * unit;
        for (const int which : {0, 1}) {
          const double at = glm::dot(p, which == 0 ? across : down) * lattice_length / unit + 0.5;
          const std::int32_t* edge = edges + (which == 0 ? c % columns : columns + 1 + c / columns);
          EXPECT_TRUE(edge[0] <= at && at < edge[1]);
          // Places are summed up in eighths of a lattice unit.
          const double eighths = std::floor((at - edge[0]) / (lattice_length / 8)) + 0.5;
          (which == 0 ? x : y) +=
              (edge[0] + eighths * lattice_length / 8) / lattice_length * unit / static_cast<double>(list.size());
        }
        EXPECT_GE(glm::dot(p, way), before - 1e-9);
        before = glm::dot(p, way);
      }
      double sum = 0, truth = 0;
      for (std::size_t k = 0; k <= list.size(); ++k) {
        const double depth = ran.link(line, link_depth, record + k);
        sum += depth;
        // Fog between particles takes too: given is what is lost but for it.
        if (k == 0 || k == list.size()) continue;
        const auto along = [&](std::size_t v) {
          return glm::dot(glm::dvec3(ran.particle(0, v), ran.particle(1, v), ran.particle(2, v)) * unit, way);
        };
        const double all = depth + 0.3 * (along(list[k]) - along(list[k - 1]));
        const double lost = -std::expm1(-all), given = all > 0 ? lost * depth / all : 0;
        worst_other = std::max({worst_other, std::fabs(ran.link(line, link_lost, record + k) - lost),
                                std::fabs(ran.link(line, link_given, record + k) - given)});
      }
      for (const GaussianDensity& g : ran.t.network.gaussians) {
        const glm::dvec3 center(g.center);
        const double dx = glm::dot(center, across) - x, dy = glm::dot(center, down) - y, r = static_cast<double>(g.radius);
        truth += static_cast<double>(g.extinction) * r * std::sqrt(M_PI) * std::exp(-(dx * dx + dy * dy) / (r * r));
      }
      worst = std::max(worst, std::fabs(sum - truth));
    });
    EXPECT_EQ(seen.size(), ran.shape.particles);
  }
  std::printf("depth of a line off by %g, shares of a link by %g\n", worst, worst_other);
  EXPECT_LE(worst, tolerance("network_line_depth"));
  EXPECT_LE(worst_other, tolerance("link_shares"));
}

TEST(IlluminationNetwork, LinksAreTheLineThroughTheirParticles) {
  links_are_lines({.particles = 300, .lines = 9, .window = 6, .extinction = 0.3F, .iterations = 1});
  links_are_lines({.particles = 100000, .lines = 1, .window = 46, .extinction = 0.3F, .iterations = 1});
}

// Means and second moments of the particles about each Gaussian, and how many each has.
TEST(IlluminationNetwork, ParticlesFollowTheDensity) {
  const Scene scene = two_gaussians(0.7);
  const MediumBox box = medium_box(scene, 16);
  const NetworkFrame frame = network_frame(box);
  constexpr int n = 4096;
  const std::vector<float> planes = network_particles(scene, frame, n);
  // By the density: masses c r^3, and about the middle of all.
  double masses = 0;
  glm::dvec3 mean(0), squares(0);
  for (const Gaussian& g : scene.medium.gaussians) {
    const double mass = g.extinction * std::pow(g.radius, 3);
    masses += mass;
    mean += mass * g.center;
    squares += mass * (g.center * g.center + 0.5 * g.radius * g.radius);
  }
  glm::dvec3 found_mean(0), found_squares(0);
  for (std::size_t v = 0; v < n; ++v) {
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(planes[static_cast<std::size_t>(axis) * n + v]);
    p = frame.middle + p * frame.unit;
    found_mean += p / static_cast<double>(n);
    found_squares += p * p / static_cast<double>(n);
    EXPECT_NEAR(static_cast<double>(planes[particle_albedo * n + v]), 0.7, 1e-6);
  }
  double error = 0;
  for (int axis = 0; axis < 3; ++axis) {
    error = std::max(
        {error, std::fabs(found_mean[axis] - mean[axis] / masses), std::fabs(found_squares[axis] - squares[axis] / masses)});
  }
  std::printf("moments off by %g\n", error);
  EXPECT_LE(error, tolerance("network_moments"));
}

}  // namespace

}  // namespace airlight
