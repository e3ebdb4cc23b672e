// Volumes of optical depth, and densities put on cells, against their definitions.
#include <algorithm>
#include <array>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 190;

// A place is (face's axis: c away; the next two: a and b), and nothing is farther than c.
Measured measure_face(const Run& run) {
  Random random(stream);
  Columns in;
  for (int i = 0; i < 6000; ++i) {
    const double scale = random.magnitude(1e-3, 1e3);
    add_call(in, random.number(-1, 1) * scale, random.number(-1, 1) * scale, random.number(-1, 1) * scale);
  }
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) add_call(in, x, y, z);
    }
  }
  const Columns found = run({Formula::cube_face, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const std::array<double, 3> place_of{in[0][i], in[1][i], in[2][i]};
    const double c = found[2][i];
    const auto face = [&] {  // by trying all
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
          if (place_of[axis] == sign * c && place_of[(axis + 1) % 3] == found[0][i] && place_of[(axis + 2) % 3] == found[1][i])
            return true;
        }
      }
      return false;
    };
    const double largest = std::max({std::fabs(place_of[0]), std::fabs(place_of[1]), std::fabs(place_of[2])});
    m.add(face() && c == largest ? 0 : HUGE_VAL, [&] {
      return place({{"x", place_of[0]}, {"y", place_of[1]}, {"z", place_of[2]}, {"c", c}});
    });
  }
  return m;
}

// A function linear along each axis of the nodes, of which lookups are exact, in every kind of volume; beyond the nodes it stands
// still. Beside its largest value.
Measured measure_lookup(const Run& run) {
  Random random(stream + 1);
  Measured m;
  for (int kind = 0; kind < 4; ++kind) {
    const std::array<int, 3> n{5, 4, 7};
    const int faces = kind == 3 ? 6 : 1;
    const std::array<double, 3> first{kind == 3 ? -1.0 : -0.75, kind == 3 ? -1.0 : -0.5, kind == 2 ? 0.5 : 0.0};
    const std::array<double, 3> scale{kind == 3 ? 2.0 : 4.0, kind == 3 ? 1.5 : 2.0, 4.0};
    std::vector<float> table;
    for (const double x : first) table.push_back(static_cast<float>(x));
    for (const double x : scale) table.push_back(static_cast<float>(x));
    for (const int x : n) table.push_back(static_cast<float>(x));
    const auto value = [&](int face, double u, double v, double w) { return face + 1 + 0.25 * u + 0.5 * u * v + 0.125 * v * w; };
    for (int face = 0; face < faces; ++face) {
      for (int k = 0; k < n[2]; ++k) {
        for (int j = 0; j < n[1]; ++j) {
          for (int i = 0; i < n[0]; ++i) table.push_back(static_cast<float>(value(face, i, j, k)));
        }
      }
    }
    Columns in;
    for (int i = 0; i < 4000; ++i) add_call(in, random.number(-2, 2), random.number(-2, 2), random.number(-1, 2.5));
    Calls calls{Formula::depth_in_volume, in, {}, table};
    calls.phase.kind = static_cast<PhaseKind>(kind);
    const Columns found = run(calls);
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      std::array<double, 3> q{in[0][i], in[1][i], in[2][i]};
      int face = 0;
      if (kind == 3) {
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k) axis = std::fabs(q[k]) > std::fabs(q[axis]) ? k : axis;
        face = static_cast<int>(2 * axis) + (q[axis] < 0 ? 1 : 0);
        q = {q[(axis + 1) % 3], q[(axis + 2) % 3], std::fabs(q[axis])};
      }
      if (kind >= 2) {
        if (q[2] < 0.01) continue;  // behind the light or beside it
        q[0] /= q[2], q[1] /= q[2];
      }
      double distance = (q[2] - first[2]) * scale[2];
      for (std::size_t k = 0; k < 3; ++k) q[k] = std::clamp((q[k] - first[k]) * scale[k], 0.0, n[k] - 1.0);
      if (kind == 3) {  // plane k is k^2 / (k + 8) away
        distance = std::clamp(distance, 0.0, std::pow(n[2] - 1, 2) / (n[2] + 7));
        q[2] = (distance + std::sqrt(distance * distance + 32 * distance)) / 2;
      }
      m.add(std::fabs(found[0][i] - (kind == 3 ? distance : 1) * value(face, q[0], q[1], q[2])) / (kind == 3 ? 30 : 12), [&] {
        return place({{"kind", static_cast<double>(kind)}, {"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}});
      });
    }
  }
  return m;
}

// The mean, over a cell between two nodes, of what is linear between sharpened values is that of the parabola.
Measured measure_sharpened(const Run& run) {
  Random random(stream + 2);
  Columns in, next;
  std::vector<double> means;
  for (int i = 0; i < 2000; ++i) {
    const auto fraction = [&](double from, double to) { return std::floor(1024 * random.number(from, to)) / 1024; };
    const double a = fraction(2, 4), b = fraction(-1, 1), c = fraction(-0.3, 0.3);
    const auto f = [&](double x) { return a + x * (b + x * c); };
    add_call(in, f(-1), f(0), f(1));
    add_call(next, f(0), f(1), f(2));
    means.push_back(a + b / 2 + c / 3);
  }
  add_call(in, 1.0, 0.0, 1.0);  // never negative
  add_call(next, 1.0, 0.0, 1.0);
  const Columns left = run({Formula::sharpened_depth, in}), right = run({Formula::sharpened_depth, next});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double truth = i < means.size() ? means[i] : 0;
    m.add(std::fabs((left[0][i] + right[0][i]) / 2 - truth) / 4, [&] { return place({{"call", static_cast<double>(i)}}); });
  }
  return m;
}

// All cells of a line together have what the Gaussian has, however fine they are and wherever they lie: sqrt(pi) radii. Beside
// that.
Measured measure_injected(const Run& run) {
  Random random(stream + 3);
  Measured m;
  for (const double cell : {0.05, 0.3, 0.7, 1.0, 2.5, 20.0}) {
    const double shift = as_float(random.number(-0.5, 0.5) * cell);
    Columns in;
    const int reach = static_cast<int>(std::ceil(6 / cell)) + 2;
    for (int i = -reach; i <= reach; ++i) add_call(in, 1.0, i * as_float(cell) + shift, as_float(cell));
    for (std::vector<double>& column : in) {
      for (double& x : column) x = as_float(x);
    }
    const Columns found = run({Formula::injected_gaussian, in});
    double sum = 0;
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      sum += found[0][i] * as_float(cell);
      if (found[0][i] < 0) sum = HUGE_VAL;
    }
    // Where cells are about as wide as the radius, what sharpening would take below 0 is left.
    m.add(std::fabs(sum / 1.7724538509055160 - 1) * (cell > 0.6 && cell < 2 ? 1e-3 : 1), [&] { return place({{"cell", cell}}); });
  }
  return m;
}

// In a medium of constant extinction the consistent scheme is exact where the light's way is along the axes, the printed one
// everywhere off by the way's length an axis after the other.
Measured measure_beside(const Run& run) {
  Random random(stream + 4);
  Measured m;
  for (int scheme = 0; scheme < 2; ++scheme) {
    Columns in;
    for (int i = 0; i < 2000; ++i) add_call(in, random.number(0, 2), random.number(0, 3), random.number(0.2, 1.7));
    Calls calls{Formula::depth_beside, in};
    calls.phase.kind = static_cast<PhaseKind>(scheme);
    const Columns found = run(calls);
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const double own = in[0][i], others = in[1][i], weights = in[2][i];
      const double truth = scheme == 0 ? own + others / weights : own / weights + others / weights;
      m.add(std::fabs(found[0][i] - truth) / (1 + truth), [&] { return place({{"own", own}, {"weights", weights}}); });
    }
  }
  return m;
}

}  // namespace

void add_depth_volume_checks(std::vector<Check>& checks) {
  checks.push_back({"cube_face", measure_face, "exact_double", "exact_float"});
  checks.push_back({"depth_in_volume", measure_lookup, "grid_value_double", "depth_lookup"});
  checks.push_back({"sharpened_depth", measure_sharpened, "grid_value_double", "grid_value"});
  checks.push_back({"injected_gaussian", measure_injected, "injected_mass", "injected_mass"});
  checks.push_back({"depth_beside", measure_beside, "grid_value_double", "grid_value"});
}

}  // namespace airlight
