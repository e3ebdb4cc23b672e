// Voxel grids, against their definition: a value at each voxel's centre, linear between centres, an axis at a time.
#include <algorithm>
#include <array>
#include <bit>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 140;

// Voxel k of n covers [k, k + 1) size / n; the coordinate counts from the first centre. In cells, beside n.
Measured measure_coordinate(const Run& run) {
  Random random(stream);
  Columns in;
  for (int i = 0; i < 20000; ++i) {
    const double n = std::floor(random.magnitude(1, 1024)), size = random.magnitude(1e-3, 1e4);
    add_call(in, random.number(-1, 2) * size, size, n);
  }
  const Columns found = run({Formula::grid_coordinate, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double cell = in[1][i] / in[2][i], truth = (in[0][i] - cell / 2) / cell;
    m.add(std::fabs(found[0][i] - truth) / in[2][i], [&] {
      return place({{"x", in[0][i]}, {"size", in[1][i]}, {"n", in[2][i]}});
    });
  }
  return m;
}

// `lower` is an index that may be looked up, and lower + weight the coordinate, held inside.
Measured measure_lookup(const Run& run, bool clamped) {
  Random random(stream + 1);
  Columns in;
  for (const double n : {1.0, 2.0, 3.0, 64.0, 1000.0}) {
    for (double c = -3; c <= std::min(n + 3, 70.0); c += 0.25) add_call(in, c, n);
    for (const double far : {-1e30, -1e9, 1e9, 1e30, n - 1, n}) add_call(in, far, n);
    for (int i = 0; i < 4000; ++i) add_call(in, random.number(-2, n + 1), n);
  }
  const Columns found = run({clamped ? Formula::grid_lookup_clamped : Formula::grid_lookup_zero, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double c = in[0][i], n = in[1][i], lower = found[0][i], weight = found[1][i];
    const double first = clamped ? 0 : -1, last = clamped ? std::max(n - 2, 0.0) : n - 1;
    const double held = std::clamp(c, clamped ? 0.0 : -1.0, clamped ? n - 1 : n);
    const bool good = lower == std::floor(lower) && lower >= first && lower <= last && weight >= 0 && weight <= 1;
    m.add(good ? std::fabs(lower + weight - held) / n : HUGE_VAL, [&] {
      return place({{"coordinate", c}, {"n", n}, {"lower", lower}, {"weight", weight}});
    });
  }
  return m;
}

struct Grid {
  std::array<int, 3> n;
  std::array<double, 3> size;
  bool exact;  // floats hold the voxels' centres
  std::vector<float> table = {};

  double value(std::size_t i, std::size_t j, std::size_t k) const {
    const auto width = static_cast<std::size_t>(n[0] + 2), height = static_cast<std::size_t>(n[1] + 2);
    return static_cast<double>(table[3 + (i + 1) + width * ((j + 1) + height * (k + 1))]);
  }
};

std::vector<Grid> grids() {
  Random random(stream + 2);
  std::vector<Grid> all{{{1, 1, 1}, {2, 3, 5}, true},
                        {{5, 1, 2}, {1.25, 0.5, 4}, true},
                        {{4, 6, 7}, {3, 0.375, 1.75}, true},
                        {{13, 8, 3}, {100, 7.7, 0.01}, false}};
  for (Grid& grid : all) {
    for (double& s : grid.size) s = as_float(s);
    for (const int n : grid.n) grid.table.push_back(static_cast<float>(n));
    for (int k = 0; k < grid.n[2] + 2; ++k) {
      for (int j = 0; j < grid.n[1] + 2; ++j) {
        for (int i = 0; i < grid.n[0] + 2; ++i) {
          const bool ring = i == 0 || j == 0 || k == 0 || i > grid.n[0] || j > grid.n[1] || k > grid.n[2];
          grid.table.push_back(ring ? 0.0F : static_cast<float>(random.number(0.1, 1)));
        }
      }
    }
  }
  return all;
}

// The sum over all voxels of the value times a tent of one cell's width on either side of its centre.
double sum_of_tents(const Grid& grid, std::array<double, 3> x, bool clamped) {
  std::array<std::vector<double>, 3> tent;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double n = grid.n[axis], cell = grid.size[axis] / n;
    if (clamped) x[axis] = std::clamp(x[axis], cell / 2, grid.size[axis] - cell / 2);
    for (int k = 0; k < grid.n[axis]; ++k) {
      const double centre = (k + 0.5) * cell;
      tent[axis].push_back(std::max(0.0, 1 - std::fabs(x[axis] - centre) / cell));
    }
  }
  double sum = 0;
  for (std::size_t k = 0; k < tent[2].size(); ++k) {
    for (std::size_t j = 0; j < tent[1].size(); ++j) {
      for (std::size_t i = 0; i < tent[0].size(); ++i) sum += grid.value(i, j, k) * tent[0][i] * tent[1][j] * tent[2][k];
    }
  }
  return sum;
}

// Beside the largest value, which is 1.
Measured measure_value(const Run& run, bool clamped) {
  Random random(stream + 3);
  Measured m;
  for (const Grid& grid : grids()) {
    Columns in;
    const auto add = [&](double x, double y, double z) {
      add_call(in, x * grid.size[0], y * grid.size[1], z * grid.size[2], grid.size[0], grid.size[1], grid.size[2]);
    };
    for (int k = 0; k < grid.n[2]; ++k) {
      for (int j = 0; j < grid.n[1]; ++j) {
        for (int i = 0; i < grid.n[0]; ++i) add((i + 0.5) / grid.n[0], (j + 0.5) / grid.n[1], (k + 0.5) / grid.n[2]);
      }
    }
    const std::size_t centres = in[0].size();
    for (int i = 0; i < 3000; ++i) add(random.number(-0.7, 1.7), random.number(-0.7, 1.7), random.number(-0.7, 1.7));
    for (int i = 0; i < 3000; ++i) add(random.number(), random.number(), random.number());
    const std::size_t outside = in[0].size();
    for (std::size_t axis = 0; axis < 3; ++axis) {  // half a cell outside the box and beyond
      for (const double far : {0.5 / grid.n[axis] + 1e-5, 3.0, 1e6}) {
        for (const double x : {-far, 1 + far}) add(axis == 0 ? x : 0.5, axis == 1 ? x : 0.5, axis == 2 ? x : 0.5);
      }
    }
    const Columns found = run({clamped ? Formula::grid_value_clamped : Formula::grid_value_zero, in, {}, grid.table});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const auto where = [&] {
        return place({{"cells in x", static_cast<double>(grid.n[0])}, {"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}});
      };
      m.add(std::fabs(found[0][i] - sum_of_tents(grid, {in[0][i], in[1][i], in[2][i]}, clamped)), where);
      if (i < centres && grid.exact) {
        const auto nx = static_cast<std::size_t>(grid.n[0]), ny = static_cast<std::size_t>(grid.n[1]);
        m.add(std::fabs(found[0][i] - grid.value(i % nx, i / nx % ny, i / nx / ny)), where);
      }
      if (i >= outside && !clamped) m.add(found[0][i] == 0 ? 0 : HUGE_VAL, where);
    }
  }
  return m;
}

// The largest value that a lookup in the brick can meet: by going through the cells of the ring from 4 b to 4 b + 4.
Measured measure_bound(const Run& run) {
  Random random(stream + 4);
  Measured m;
  for (const Grid& grid : grids()) {
    std::array<int, 3> bricks{};
    std::vector<float> table;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bricks[axis] = (grid.n[axis] + 1 + 3) / 4;
      table.push_back(static_cast<float>(bricks[axis]));
    }
    const auto largest = [&](int a, int b, int c) {
      double most = 0;
      for (int k = 4 * c; k <= std::min(4 * c + 4, grid.n[2] + 1); ++k) {
        for (int j = 4 * b; j <= std::min(4 * b + 4, grid.n[1] + 1); ++j) {
          for (int i = 4 * a; i <= std::min(4 * a + 4, grid.n[0] + 1); ++i) {
            const bool ring = i == 0 || j == 0 || k == 0 || i > grid.n[0] || j > grid.n[1] || k > grid.n[2];
            if (ring) continue;
            most = std::max(most, grid.value(static_cast<std::size_t>(i - 1), static_cast<std::size_t>(j - 1),
                                             static_cast<std::size_t>(k - 1)));
          }
        }
      }
      return most;
    };
    for (int c = 0; c < bricks[2]; ++c) {
      for (int b = 0; b < bricks[1]; ++b) {
        for (int a = 0; a < bricks[0]; ++a) table.push_back(static_cast<float>(largest(a, b, c)));
      }
    }
    Columns in;
    for (int i = 0; i < 3000; ++i) {
      add_call(in, random.number(-2, grid.n[0] + 1), random.number(-2, grid.n[1] + 1), random.number(-2, grid.n[2] + 1),
               grid.n[0], grid.n[1], grid.n[2]);
    }
    const Columns found = run({Formula::grid_bound, in, {}, table});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      const auto brick = [&](std::size_t axis) {
        const int lower = std::clamp(static_cast<int>(std::floor(in[axis][i])), -1, grid.n[axis] - 1);
        return (lower + 1) / 4;
      };
      m.add(std::fabs(found[0][i] - largest(brick(0), brick(1), brick(2))), [&] {
        return place({{"cells in x", in[3][i]}, {"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}});
      });
    }
  }
  return m;
}

// All halves that are not negative and finite, in a box that they fill: each as it stands, and between eight. Beside the
// largest of these.
Measured measure_halves(const Run& run) {
  constexpr int width = 31, height = 32, count = width * height * 32;
  static_assert(count == 0x7c00);
  // Neighbours of all sizes: a step that meets every number once.
  const auto bits = [](int i) { return static_cast<std::uint32_t>(i * 1003L % count); };
  const auto value = [&](int i) {
    const auto exponent = static_cast<int>(bits(i) >> 10U), mantissa = static_cast<int>(bits(i) & 0x3ffU);
    return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  };
  std::vector<float> table{0};
  for (int i = 0; i < count; i += 2) table.push_back(std::bit_cast<float>(bits(i) | bits(i + 1) << 16U));
  table.resize(table.size() + width * (height + 1), 0.0F);  // what weights of 0 are for
  Random random(stream + 5);
  Columns in;
  for (int i = 0; i < count; ++i) add_call(in, i % width, i / width % height, i / width / height, 0, 0, 0);
  for (int i = 0; i < 20000; ++i) {
    add_call(in, std::floor(random.number(0, width - 1)), std::floor(random.number(0, height - 1)),
             std::floor(random.number(0, 31)), random.number(), random.number(), random.number());
  }
  const Columns found = run({Formula::half_cell, in, {}, table});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    double truth = 0, largest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      int at = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const int far = corner >> axis & 1;
        const double w = in[3 + static_cast<std::size_t>(axis)][i];
        weight *= far ? w : 1 - w;
        at += (static_cast<int>(in[static_cast<std::size_t>(axis)][i]) + far) * (axis == 0   ? 1
                                                                                 : axis == 1 ? width
                                                                                             : width * height);
      }
      if (weight == 0) continue;
      truth += weight * value(at);
      largest = std::max(largest, value(at));
    }
    const double error = std::fabs(found[0][i] - truth);
    const bool as_it_is = i < static_cast<std::size_t>(count);
    m.add(as_it_is ? (error == 0 ? 0 : HUGE_VAL) : error / largest, [&] {
      return place({{"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}, {"weight", in[3][i]}, {"truth", truth}});
    });
  }
  return m;
}

}  // namespace

void add_grid_checks(std::vector<Check>& checks) {
  const auto lookup = [](bool clamped) { return [=](const Run& run) { return measure_lookup(run, clamped); }; };
  const auto value = [](bool clamped) { return [=](const Run& run) { return measure_value(run, clamped); }; };
  checks.push_back({"grid_coordinate", measure_coordinate, "geometry_double", "image_plane"});
  checks.push_back({"grid_lookup_zero", lookup(false), "geometry_double", "exact_float"});
  checks.push_back({"grid_lookup_clamped", lookup(true), "geometry_double", "exact_float"});
  checks.push_back({"grid_bound", measure_bound, "exact_double", "exact_float"});
  checks.push_back({"grid_value_zero", value(false), "grid_value_double", "grid_value"});
  checks.push_back({"half_cell", measure_halves, "grid_value_double", "grid_value"});
  checks.push_back({"grid_value_clamped", value(true), "grid_value_double", "grid_value"});
}

}  // namespace airlight
