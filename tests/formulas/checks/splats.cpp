// Splats of particles and the weights of directions, against their definitions.
#include <algorithm>
#include <array>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 950;

// int_{-1}^{s} 3/4 (1 - t^2) dt by Simpson's rule, exact for a cubic; 0 below -1 and 1 above 1.
double before(double s) {
  const double to = std::clamp(s, -1.0, 1.0), middle = 0.5 * (to - 1);
  const auto density = [](double t) { return 0.75 * (1 - t * t); };
  return (to + 1) / 6 * (density(-1) + 4 * density(middle) + density(to));
}

Measured measure_before(const Run& run) {
  Random random(stream);
  Columns in;
  for (int i = 0; i < 3000; ++i) add_call(in, random.number(-1.5, 1.5));
  for (const double s : {-1e30, -1.0, 0.0, 1.0, 1e30}) add_call(in, s);
  const Columns found = run({Formula::splat_before, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i)
    m.add(std::fabs(found[0][i] - before(in[0][i])), [&] { return place({{"s", in[0][i]}}); });
  // All of a splat is before 1 and none before -1, in every bit: splats that nothing cuts are not looked at.
  for (std::size_t i = in[0].size() - 5; i < in[0].size(); ++i) {
    if (std::fabs(in[0][i]) < 1) continue;
    m.add(found[0][i] == (in[0][i] > 0 ? 1 : 0) ? 0 : HUGE_VAL, [&] { return place({{"s", in[0][i]}}); });
  }
  return m;
}

// Rays at splats in all directions, whole and cut at both ends; beside the peak.
Measured measure_depth(const Run& run) {
  Random random(stream + 1);
  Columns in;
  for (int i = 0; i < 6000; ++i) {
    const glm::dvec3 d = random.direction(), beside = random.direction();
    const double support = random.magnitude(1e-2, 1e2), peak = random.magnitude(1e-3, 1e2);
    const double along = support * random.number(-1.2, i % 2 == 0 ? 1.2 : 20);
    const glm::dvec3 c = along * d + support * random.number(0, 1.1) * glm::normalize(glm::cross(d, beside));
    const double end = i % 3 == 0 ? 1e15 : std::max(0.0, along + support * random.number(-1.5, 1.5));
    add_call(in, d.x, d.y, d.z, c.x, c.y, c.z, 1 / support, peak, end);
  }
  const Columns found = run({Formula::splat_depth, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const glm::dvec3 d = vector_at(in, 0, i), c = vector_at(in, 3, i);
    const double inverse = in[6][i], foot = glm::dot(d, c), h = glm::length(c - foot * d) * inverse;
    const double u = std::max(1 - h * h, 0.0);
    const double truth = u * u * std::max(before((in[8][i] - foot) * inverse) - before(-foot * inverse), 0.0);
    m.add(std::max(std::fabs(found[0][i] / in[7][i] - truth), std::fabs(found[1][i] - foot) * inverse * 1e-1), [&] {
      return place({{"h", h}, {"foot", foot * inverse}, {"end", std::min(in[8][i] * inverse, 1e9)}, {"peak", in[7][i]}});
    });
  }
  return m;
}

// Integrated over the plane, the optical depth of a splat is pi / 3 times peak and support squared: its mass. Five nodes of Gauss
// and Legendre across, of a polynomial of degree 5; splats far away, so that rays are parallel.
Measured measure_mass(const Run& run) {
  constexpr std::array<double, 5> node{0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332};
  constexpr std::array<double, 5> weight{0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                                         0.118463442528095};
  constexpr double pi = 3.141592653589793;
  Random random(stream + 2);
  Measured m;
  for (int i = 0; i < 50; ++i) {
    const double support = as_float(random.magnitude(1e-2, 1e2)), peak = as_float(random.magnitude(1e-3, 1e2));
    Columns in;
    for (std::size_t k = 0; k < node.size(); ++k)
      add_call(in, 0, 0, -1, node[k] * support, 0, -5 * support, 1 / support, peak, 1e15);
    const Columns found = run({Formula::splat_depth, in});
    double mass = 0;
    for (std::size_t k = 0; k < node.size(); ++k) mass += weight[k] * 2 * pi * node[k] * support * support * found[0][k];
    const double truth = pi / 3 * peak * support * support;
    m.add(relative_error(mass, truth), [&] { return place({{"support", support}, {"peak", peak}}); });
  }
  return m;
}

Measured measure_opacity(const Run& run) {
  Random random(stream + 3);
  Columns in;
  for (int i = 0; i < 4000; ++i) add_call(in, random.magnitude(1e-9, 80));
  for (const double tau : {0.0, 1.0, 87.0, 1e30}) add_call(in, tau);
  const Columns found = run({Formula::splat_opacity, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i)
    m.add(relative_error(found[0][i], -std::expm1(-in[0][i])), [&] { return place({{"tau", in[0][i]}}); });
  return m;
}

// Beside the larger of the weight and 1 / reach^2: near the reach the weight is a square of nothing.
Measured measure_weight(const Run& run) {
  Random random(stream + 4);
  Columns in;
  for (int i = 0; i < 4000; ++i) {
    const double reach = random.number(0.1, 2), chord = random.number(0, std::min(1.2 * reach, 2.0));
    add_call(in, 1 - 0.5 * chord * chord, 1 / reach);
  }
  add_call(in, 1.0, 0.5), add_call(in, -1.0, 2.0), add_call(in, -1.0, 0.2);
  const Columns found = run({Formula::direction_weight, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double chord = std::sqrt(std::max(2 - 2 * in[0][i], 1e-6)), inverse = in[1][i];
    const double truth = chord * inverse < 1 ? std::pow((1 / inverse - chord) / (chord / inverse), 2) : 0;
    m.add(std::fabs(found[0][i] - truth) / std::max(truth, inverse * inverse), [&] {
      return place({{"mu", in[0][i]}, {"1/reach", inverse}});
    });
  }
  return m;
}

}  // namespace

void add_splat_checks(std::vector<Check>& checks) {
  checks.push_back({"splat_before", measure_before, "splat_double", "splat"});
  checks.push_back({"splat_depth", measure_depth, "splat_double", "splat_depth"});
  checks.push_back({"splat_mass", measure_mass, "splat_double", "splat_depth"});
  checks.push_back({"splat_opacity", measure_opacity, "splat_opacity_double", "splat_opacity"});
  checks.push_back({"direction_weight", measure_weight, "splat_double", "direction_weight"});
}

}  // namespace airlight
