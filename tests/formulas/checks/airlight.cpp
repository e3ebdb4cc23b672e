// Single scattering along a ray: the high-precision table, the defining integral on rays of all kinds, extreme rays.
#include <algorithm>
#include <map>

#include "common/plan/airlight_tables.h"
#include "tests/formulas/airlight_truth.h"
#include "tests/formulas/checks/random.h"
#include "tests/formulas/rows.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

constexpr int default_nodes = 64;

// What a difference of end values can be known to: sigma_t times the larger of B at the start and B' at the end.
double end_value(const std::vector<float>& tables, const AirlightRow& row) {
  double end = f64::airlight_beyond(tables.data(), row.extinction, row.foot, row.h, 0);
  if (row.foot > 0) {
    end = std::max(end, f64::airlight_before(tables.data(), row.extinction, row.foot, row.h, std::min(row.length, row.foot)));
  }
  return row.extinction * end;
}

std::string place_of(const AirlightRow& row, double found) {
  return place({{"kind", static_cast<double>(row.phase.kind)},
                {"g", row.phase.g},
                {"sigma_t", row.extinction},
                {"foot", row.foot},
                {"h", row.h},
                {"length", row.length},
                {"truth", row.value},
                {"found", found}});
}

// As a multiple of what is allowed: 2e-5 of the value and 1e-7 of the end value.
Measured measure_table(const Run& run) {
  std::map<std::pair<PhaseKind, double>, std::vector<AirlightRow>> by_phase;
  for (const AirlightRow& row : airlight_rows()) by_phase[{row.phase.kind, row.phase.g}].push_back(row);
  Measured m;
  for (const auto& [key, rows] : by_phase) {
    const Phase phase = rows.front().phase;
    const std::vector<float> tables = airlight_tables(phase, default_nodes);
    Columns in;
    for (const AirlightRow& row : rows) add_call(in, row.extinction, row.foot, row.h, 0, row.length);
    const Columns found = run({Formula::point_airlight, in, phase, tables});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const AirlightRow& row = rows[i];
      const double allowed = std::fabs(row.value) < 1e-30 ? 1e-30
                                                          : tolerance("airlight_value") * std::fabs(row.value) +
                                                                tolerance("airlight_end") * end_value(tables, row);
      m.add(std::fabs(found[0][i] - row.value) / allowed, [&] { return place_of(row, found[0][i]); });
    }
  }
  return m;
}

// Rays of all kinds: the light ahead, beside and behind, optical depths from 1e-4 to 60, short and infinite.
Columns random_rays() {
  Columns in;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const double extinction = std::pow(10, 4 * uniform(1, i) - 3), l = std::pow(10, 3 * uniform(2, i) - 2);
    const double angle = uniform(3, i) < 0.5 ? std::acos(2 * uniform(4, i) - 1) : std::pow(10, -3 * uniform(4, i)) * 3.1;
    const double length = uniform(5, i) < 0.2 ? 1e30 : l * std::pow(10, 4 * uniform(6, i) - 2);
    add_call(in, std::min(extinction, 20 / l), l * std::cos(angle), std::max(l * std::sin(angle), 1e-3), 0, length);
  }
  return in;
}

// Beside the value and the end values.
Measured measure_rays(const Run& run, Phase phase) {
  const std::vector<float> tables = airlight_tables(phase, default_nodes);
  const Columns in = random_rays(), found = run({Formula::point_airlight, in, phase, tables});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    AirlightRow row{phase, in[0][i], in[1][i], in[2][i], in[4][i], 0};
    row.value = airlight_truth(phase, row.extinction, row.foot, row.h, 0, row.length);
    const auto where = [&] { return place_of(row, found[0][i]); };
    m.add(std::fabs(found[0][i] - row.value) / (row.value + end_value(tables, row) + 1e-26), where);
    m.add(found[0][i] >= 0 ? 0 : HUGE_VAL, where);
  }
  return m;
}

// Finite and not negative, whatever the ray.
Measured measure_extremes(const Run& run) {
  Columns in;
  for (const double k : {0.0, 1e-30, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    for (const double h : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
      for (const double foot : {-1e6, -1e3, -1.0, -1e-6, 0.0, 1e-6, 1.0, 1e3, 1e6}) {
        for (const double x1 : {0.0, 1e-6, 1.0, 1e3, 1e6, 1e12, 1e20, 1e30}) add_call(in, k, foot, h, 0, x1);
      }
    }
  }
  Measured m;
  for (const Phase phase : {Phase{PhaseKind::isotropic, 0}, Phase{PhaseKind::henyey_greenstein, 0.99}}) {
    const std::vector<float> tables = airlight_tables(phase, default_nodes);
    const Columns found = run({Formula::point_airlight, in, phase, tables});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      m.add(std::isfinite(found[0][i]) && found[0][i] >= 0 ? 0 : HUGE_VAL, [&] {
        return place_of({phase, in[0][i], in[1][i], in[2][i], in[4][i], 0}, found[0][i]);
      });
    }
  }
  return m;
}

// Of a directional light: p (exp(-sigma x0) - exp(-sigma x1)), here of Rayleigh's 3/(16 pi) (1 + mu^2), beside 1 + the optical
// depth.
Measured measure_directional(const Run& run) {
  Random random(150);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double sigma = random.magnitude(1e-6, 1e3), x0 = i % 2 == 0 ? 0 : random.magnitude(1e-3, 40) / sigma;
    add_call(in, sigma, random.number(-1, 1), as_float(x0),
             i % 5 == 0 ? 1e30 : as_float(x0) + random.magnitude(1e-3, 1e3) / sigma);
  }
  const Columns found = run({Formula::directional_airlight, in, {PhaseKind::rayleigh, 0}});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double sigma = in[0][i], mu = in[1][i], x0 = in[2][i], x1 = in[3][i];
    const double truth = 0.059683103659460751 * (1 + mu * mu) * std::exp(-sigma * x0) * -std::expm1(-sigma * (x1 - x0));
    // x1 - x0 is a float, too.
    const double known = 1 + sigma * x0 + x1 / (x1 - x0);
    m.add(relative_error(found[0][i], truth) / known, [&] {
      return place({{"sigma_t", sigma}, {"mu", mu}, {"x0", x0}, {"x1", x1}});
    });
  }
  return m;
}

// What a place scatters toward the camera, of a lamp and of a directional light, behind more than the homogeneous part. Optical
// depths above 60 are those of transmittance()'s check: it is held there.
Measured measure_density(const Run& run) {
  Random random(141);
  Columns in;
  for (int i = 0; i < 40000; ++i) {
    add_call(in, i % 10 == 0 ? 0 : random.magnitude(1e-4, 2), random.number(-20, 20), random.magnitude(1e-3, 20),
             random.magnitude(1e-3, 20), random.number(0, 8), random.number(-1, 1));
  }
  Measured m;
  for (const Phase& phase : {Phase{}, Phase{PhaseKind::henyey_greenstein, 0.6}}) {
    const Columns found = run({Formula::light_density, in, phase});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const double sigma = in[0][i], past = in[3][i] - in[1][i], r = std::hypot(past, in[2][i]), more = in[4][i];
      const int kind = static_cast<int>(phase.kind);
      const double lamp = sigma * (in[3][i] + r) + more, sun = sigma * in[3][i] + more;
      if (lamp > 60) continue;
      const double of_lamp = f64::phase_value(kind, phase.g, -past / r) * std::exp(-lamp) / (r * r);
      const double of_sun = f64::phase_value(kind, phase.g, in[5][i]) * std::exp(-sun);
      const double error =
          std::max(std::fabs(found[0][i] / of_lamp - 1) / (1 + lamp), std::fabs(found[1][i] / of_sun - 1) / (1 + sun));
      m.add(error, [&] {
        return place({{"g", phase.g}, {"sigma_t", sigma}, {"foot", in[1][i]}, {"h", in[2][i]}, {"x", in[3][i]}, {"more", more}});
      });
    }
  }
  return m;
}

}  // namespace

void add_airlight_checks(std::vector<Check>& checks) {
  checks.push_back({"airlight_table", measure_table, "airlight_allowed", "airlight_allowed"});
  const auto rays = [&](const char* name, Phase phase) {
    const std::string_view bound = std::fabs(phase.g) > 0.97 ? "airlight_interpolation_peak" : "airlight_interpolation";
    checks.push_back({std::string("airlight_") + name, [=](const Run& run) { return measure_rays(run, phase); }, bound, bound});
  };
  rays("isotropic", {PhaseKind::isotropic, 0});
  rays("rayleigh", {PhaseKind::rayleigh, 0});
  for (const auto& [name, g] : std::initializer_list<std::pair<const char*, double>>{{"hg060", 0.6},
                                                                                     {"hg090", 0.9},
                                                                                     {"hg097", 0.97},
                                                                                     {"hg099", 0.99},
                                                                                     {"hg060_back", -0.6},
                                                                                     {"hg090_back", -0.9},
                                                                                     {"hg097_back", -0.97},
                                                                                     {"hg099_back", -0.99}}) {
    rays(name, {PhaseKind::henyey_greenstein, g});
  }
  rays("cs060", {PhaseKind::cornette_shanks, 0.6});
  rays("cs095", {PhaseKind::cornette_shanks, 0.95});
  rays("mie_hazy", {PhaseKind::mie_hazy, 0});
  rays("mie_murky", {PhaseKind::mie_murky, 0});
  checks.push_back({"airlight_extremes", measure_extremes, "exact_double", "exact_double"});
  checks.push_back({"light_density", measure_density, "exact_double", "light_density"});
  checks.push_back({"directional_airlight", measure_directional, "opacity_double", "opacity"});
}

}  // namespace airlight
