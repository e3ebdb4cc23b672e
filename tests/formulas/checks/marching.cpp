// Steps along a ray, against closed forms in double.
#include <algorithm>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 160;

// Steps begin at 0, end at the length and grow with 1 + optical depth; in its logarithm, beside that of the whole.
Measured measure_graded_step(const Run& run) {
  Random random(stream);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double n = std::floor(random.magnitude(1, 1024)), tau = random.magnitude(1e-6, 80), k = random.magnitude(1e-4, 1e2);
    const double which = i % 8 == 0 ? 0 : i % 8 == 1 ? n : std::floor(random.number(0, n));
    add_call(in, which, n, tau / k, k);
  }
  const Columns found = run({Formula::graded_step, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double share = in[0][i] / in[1][i], length = in[2][i], k = in[3][i], all = std::log1p(k * length);
    const double error = k * length < 0.02 ? std::fabs(found[0][i] - length * share) / length
                                           : std::fabs(std::log1p(k * found[0][i]) - share * all) / all;
    const bool ends = (share > 0 || found[0][i] == 0) && (share < 1 || found[0][i] == length) && found[0][i] <= length;
    m.add(ends ? error : HUGE_VAL, [&] {
      return place({{"k", in[0][i]}, {"n", in[1][i]}, {"length", length}, {"extinction", k}});
    });
  }
  return m;
}

Columns steps_beside_lights() {
  Random random(stream + 1);
  Columns in;
  for (int i = 0; i < 40000; ++i) {
    const double h = random.magnitude(1e-3, 1e3), foot = random.number(-5, 20), a = random.number(0, 20);
    add_call(in, a, a + random.magnitude(1e-2, 1e3), foot, h);
  }
  return in;
}

// The angle over h relative to itself and to half a turn over h: a light that nearly touches the ray is seen in half a turn.
Measured measure_angle(const Run& run) {
  const Columns in = steps_beside_lights(), found = run({Formula::step_of_light, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double a = in[0][i] - in[2][i], b = in[1][i] - in[2][i], h = in[3][i];
    const double truth = std::atan2(h * (b - a), h * h + a * b);
    m.add(std::fabs(found[0][i] * h - truth) / (truth + 0.01 * 3.14159265358979), [&] {
      return place({{"a", in[0][i]}, {"b", in[1][i]}, {"foot", in[2][i]}, {"h", h}});
    });
  }
  return m;
}

// The means, by quadrature, beside the step or 1e-3 of the places it is made of.
Measured measure_means(const Run& run, bool of_distance) {
  const Columns in = steps_beside_lights(), found = run({Formula::step_of_light, in});
  constexpr int nodes = 2000;
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); i += 16) {
    const double a = in[0][i] - in[2][i], b = in[1][i] - in[2][i], h = in[3][i];
    // With x = h sinh(s), dt / r^2 = ds / r: smooth however near the light is. Simpson's rule.
    const double s0 = std::asinh(a / h), s1 = std::asinh(b / h), size = (s1 - s0) / nodes;
    double weight = 0, place_sum = 0, distance_sum = 0;
    for (int k = 0; k <= nodes; ++k) {
      const double s = s0 + k * size, w = (k == 0 || k == nodes ? 1 : k % 2 == 1 ? 4 : 2) / std::cosh(s);
      weight += w;
      place_sum += w * h * std::sinh(s);
      distance_sum += w * h * std::cosh(s);
    }
    const double truth = of_distance ? distance_sum / weight : in[2][i] + place_sum / weight;
    const double scale = std::max(b - a, 1e-3 * (std::fabs(in[2][i]) + std::fabs(in[1][i])));
    m.add(std::fabs(found[of_distance ? 2 : 1][i] - truth) / scale, [&] {
      return place({{"a", in[0][i]}, {"b", in[1][i]}, {"foot", in[2][i]}, {"h", h}});
    });
  }
  return m;
}

// Parts are as many as they should be and of one angle: where the first ends, beside that angle.
Measured measure_parts(const Run& run) {
  Random random(stream + 5);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double h = random.magnitude(1e-3, 1e2), a = random.number(-10, 10);
    add_call(in, a, a + random.magnitude(1e-3, 30), h);
  }
  const Columns found = run({Formula::step_parts, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double a = in[0][i], b = in[1][i], h = in[2][i], from = std::atan2(a, h), all = std::atan2(h * (b - a), h * h + a * b);
    double parts = 1;
    while (parts < 8 && std::cos(all / parts) < 0.97) parts *= 2;
    const bool close =
        std::fabs(std::cos(2 * all / found[0][i]) - 0.97) < 1e-5 || std::fabs(std::cos(all / found[0][i]) - 0.97) < 1e-5;
    const bool right = (close || found[0][i] == parts) && (found[0][i] == 1 || found[2][i] == 1);
    const double part = all / found[0][i];
    const double error = found[0][i] > 1 ? std::fabs(std::atan2(found[1][i], h) - from - part) / part : 0;  // else it is unasked
    m.add(right && found[1][i] <= b ? error : HUGE_VAL, [&] { return place({{"a", a}, {"b", b}, {"h", h}}); });
  }
  return m;
}

// The mean phase function, beside itself and a tenth of the isotropic one, for steps of every size; |g| up to 0.7.
Measured measure_phase(const Run& run) {
  Measured m;
  for (const Phase& phase :
       {Phase{PhaseKind::isotropic, 0}, Phase{PhaseKind::rayleigh, 0}, Phase{PhaseKind::mie_hazy, 0},
        Phase{PhaseKind::henyey_greenstein, 0.7}, Phase{PhaseKind::cornette_shanks, -0.5}, Phase{PhaseKind::mie_murky, 0}}) {
    Random random(stream + 3);
    Columns in, at;
    constexpr int nodes = 512;
    std::vector<double> mu;
    for (int i = 0; i < 500; ++i) {
      const double h = random.magnitude(1e-3, 1e2), a = random.number(-10, 10), b = a + random.magnitude(1e-2, 30);
      add_call(in, a, b, h);
      const double from = std::atan2(in[0].back(), in[2].back()), to = std::atan2(in[1].back(), in[2].back());
      for (int k = 0; k < nodes; ++k) mu.push_back(-std::sin(from + (k + 0.5) * (to - from) / nodes));
    }
    const Columns found = run({Formula::step_phase, in, phase});
    for (const double cosine : mu) add_call(at, cosine);
    const Columns values = run({Formula::phase_value, at, phase});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      double truth = 0;
      for (std::size_t k = 0; k < nodes; ++k) truth += values[0][i * nodes + k] / nodes;
      m.add(std::fabs(found[0][i] - truth) / (truth + 0.008), [&] {
        return place({{"phase", static_cast<double>(phase.kind)}, {"a", in[0][i]}, {"b", in[1][i]}, {"h", in[2][i]}});
      });
    }
  }
  return m;
}

// At the step's middle it is the mean of exp(-t) over the step, whatever its depth.
Measured measure_transmittance(const Run& run) {
  Random random(stream + 2);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    add_call(in, random.number(0, 5), random.magnitude(1e-6, 20), i % 2 == 0 ? 0.5 : random.number(), random.number(0, 5));
  }
  const Columns found = run({Formula::step_transmittance, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double front = in[0][i], tau = in[1][i], u = in[2][i], beside = in[3][i];
    const double mean = -std::expm1(-tau) / tau;
    const double before = std::exp(-front - beside), all = std::exp(-(front + tau * (u - 0.5) + beside)) * mean;
    const double truth = u == 0.5 ? before * mean : tau * (0.5 - u) > 1e-3 ? std::min(all, before) : all;
    m.add(std::fabs(found[0][i] / truth - 1) / (1 + front + tau + beside), [&] {
      return place({{"front", front}, {"tau", tau}, {"share", u}, {"beside", beside}});
    });
  }
  return m;
}

// Share of wrong answers: never before exp(-16), always behind exp(-80), between them by what may still come. Inputs close to a
// threshold are left out.
Measured measure_end(const Run& run) {
  Random random(stream + 3);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double front = random.number(0, 100), least = std::exp(-std::min(front, 80.0)) * 1e6;
    const double side = i % 2 == 0 ? random.magnitude(1e-4, 0.99) : random.magnitude(1.01, 1e4),
                 most = random.magnitude(1e-6, 1e6);
    if (std::fabs(front - 16) > 0.01 && std::fabs(front - 80) > 0.01) add_call(in, front, most, side * least * most);
  }
  const Columns found = run({Formula::ray_ended, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double front = in[0][i], rest = std::exp(-front) * in[1][i];
    const bool ended = front >= 80 || (front >= 16 && rest <= 1e-6 * in[2][i]);
    m.add(std::fabs(found[0][i] - (ended ? 1 : 0)), [&] {
      return place({{"front", front}, {"most", in[1][i]}, {"seen", in[2][i]}});
    });
  }
  return m;
}

}  // namespace

void add_marching_checks(std::vector<Check>& checks) {
  checks.push_back({"graded_step", measure_graded_step, "geometry_double", "graded_step"});
  checks.push_back({"step_angle", measure_angle, "geometry_double", "step_angle"});
  checks.push_back({"step_mean_place", [](const Run& run) { return measure_means(run, false); }, "step_means", "step_means"});
  checks.push_back({"step_mean_distance", [](const Run& run) { return measure_means(run, true); }, "step_means", "step_means"});
  checks.push_back({"step_parts", measure_parts, "geometry_double", "step_parts"});
  checks.push_back({"step_phase", measure_phase, "step_phase", "step_phase"});
  checks.push_back({"ray_ended", measure_end, "exact_double", "exact_float"});
  checks.push_back({"step_transmittance", measure_transmittance, "opacity_double", "opacity"});
}

}  // namespace airlight
