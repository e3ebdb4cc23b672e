// Attenuation in the homogeneous medium, against the C library.
#include <algorithm>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 120;

// Optical depths from 1e-30 to 1e30, dense where a formula changes from its series and where the result becomes 0.
Columns optical_depths() {
  Random random(stream);
  Columns in;
  for (const double tau : {0.0, 0.25, 87.0, 1e30}) add_call(in, tau);
  for (int k = 0; k < 20000; ++k) {
    add_call(in, random.magnitude(1e-30, 1e30));
    add_call(in, random.magnitude(1e-4, 100));
    add_call(in, random.number(0.24, 0.26));
    add_call(in, random.number(86, 88));
  }
  return in;
}

// exp(-tau); nothing from 87 on.
double left_of(double tau) { return tau < 87 ? std::exp(-tau) : 0; }

template <class Truth>
Measured measure_of_depth(const Run& run, Formula formula, Truth&& truth) {
  const Columns in = optical_depths(), found = run({formula, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    m.add(relative_error(found[0][k], truth(in[0][k])), [&] { return place({{"optical depth", in[0][k]}}); });
  }
  return m;
}

Measured measure_transmittance(const Run& run) { return measure_of_depth(run, Formula::transmittance, left_of); }
Measured measure_opacity(const Run& run) {
  return measure_of_depth(run, Formula::opacity, [](double tau) { return -std::expm1(-tau); });
}
Measured measure_mean(const Run& run) {
  return measure_of_depth(run, Formula::mean_transmittance, [](double tau) { return tau > 0 ? -std::expm1(-tau) / tau : 1; });
}

// Lengths and extinctions: thin, dense, none, infinite.
Columns segments() {
  Random random(stream + 1);
  Columns in;
  for (const double k : {0.0, 1e-6, 1.0, 1e3}) {
    for (const double length : {0.0, 1e-3, 1.0, 1e30}) add_call(in, length, k);
  }
  for (int i = 0; i < 40000; ++i) {
    const double tau = random.magnitude(1e-8, 1e3), k = random.magnitude(1e-6, 1e3);
    add_call(in, tau / k, k);
  }
  return in;
}

template <class Truth>
Measured measure_of_segment(const Run& run, Formula formula, Truth&& truth) {
  const Columns in = segments(), found = run({formula, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    m.add(relative_error(found[0][i], truth(in[0][i], in[1][i])), [&] {
      return place({{"length", in[0][i]}, {"extinction", in[1][i]}});
    });
  }
  return m;
}

const double infinite = as_float(1e30);

Measured measure_depth(const Run& run) {
  return measure_of_segment(run, Formula::optical_depth, [](double length, double k) {
    return length >= infinite && k > 0 ? 1e30 : std::min(length * k, 1e30);
  });
}
Measured measure_attenuated(const Run& run) {
  return measure_of_segment(run, Formula::attenuated_length, [](double length, double k) {
    if (k <= 0) return length;
    return length >= infinite ? 1 / k : -std::expm1(-length * k) / k;
  });
}

// The nearer of surface and sky; the sky where there is no surface.
Measured measure_ray_length(const Run& run) {
  Columns in;
  for (const double distance : {0.0, 0.5, 3.0, 1e20, 1e30, 3e38}) {
    for (const double sky : {0.1, 2.0, 1e20, 1e30, 3e38}) add_call(in, distance, sky);
  }
  const Columns found = run({Formula::ray_length, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double truth = in[0][i] < infinite ? in[0][i] : std::min(in[1][i], infinite);
    m.add(relative_error(found[0][i], truth), [&] { return place({{"distance", in[0][i]}, {"sky", in[1][i]}}); });
  }
  return m;
}

// Beside 1 + optical depth: that product is rounded.
Measured measure_irradiance(const Run& run) {
  Random random(stream + 2);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double l = random.magnitude(1e-3, 1e4);
    add_call(in, l, random.magnitude(1e-6, 1e3), random.magnitude(1e-6, 80) / l);
  }
  const Columns found = run({Formula::point_irradiance, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double l = in[0][i], tau = in[2][i] * l, r = std::max(l, in[1][i]), truth = left_of(tau) / (r * r);
    if (truth < 2e-38) continue;  // no normal float
    m.add(relative_error(found[0][i], truth) / (1 + tau), [&] {
      return place({{"distance", l}, {"radius", in[1][i]}, {"optical depth", tau}});
    });
  }
  return m;
}

}  // namespace

void add_transmittance_checks(std::vector<Check>& checks) {
  checks.push_back({"ray_length", measure_ray_length, "exact_float", "exact_float"});  // 1e30 is not a float
  checks.push_back({"optical_depth", measure_depth, "exact_double", "exact_float"});
  checks.push_back({"transmittance", measure_transmittance, "exact_double", "transmittance"});
  checks.push_back({"opacity", measure_opacity, "opacity_double", "opacity"});
  checks.push_back({"mean_transmittance", measure_mean, "opacity_double", "opacity"});
  checks.push_back({"attenuated_length", measure_attenuated, "opacity_double", "opacity"});
  checks.push_back({"point_irradiance", measure_irradiance, "exact_double", "transmittance"});
}

}  // namespace airlight
