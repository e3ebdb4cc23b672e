// Gradient noise, against one by integers and the twelve gradients as vectors, in double; and what it promises.
#include <algorithm>
#include <array>
#include <cstdint>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 280;
constexpr std::int64_t period = 256;
constexpr double bound = 1.05;

std::int64_t permuted(std::int64_t x) { return (34 * x + 1) * x % 289; }

// Toward the middles of a cube's edges, in Perlin's order of sixteen.
constexpr std::array<std::array<int, 3>, 16> gradients{{{1, 1, 0},
                                                        {-1, 1, 0},
                                                        {1, -1, 0},
                                                        {-1, -1, 0},
                                                        {1, 0, 1},
                                                        {-1, 0, 1},
                                                        {1, 0, -1},
                                                        {-1, 0, -1},
                                                        {0, 1, 1},
                                                        {0, -1, 1},
                                                        {0, 1, -1},
                                                        {0, -1, -1},
                                                        {1, 1, 0},
                                                        {0, -1, 1},
                                                        {-1, 1, 0},
                                                        {0, -1, -1}}};

// At an offset in a cell, for any choice of gradients: weight of a corner times its product, summed.
template <class Product>
double blended(const glm::dvec3& in_cell, Product&& product) {
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    glm::dvec3 way;
    glm::ivec3 at;
    for (int k = 0; k < 3; ++k) {
      at[k] = corner >> k & 1;
      const double t = in_cell[k], fade = t * t * t * (t * (6 * t - 15) + 10);
      weight *= at[k] == 1 ? fade : 1 - fade;
      way[k] = t - at[k];
    }
    sum += weight * product(at, way);
  }
  return sum;
}

double noise(const glm::dvec3& p, int component) {
  const glm::dvec3 cell = glm::floor(p);
  return blended(p - cell, [&](const glm::ivec3& at, const glm::dvec3& way) {
    std::int64_t hash = 0;
    for (int k = 0; k < 3; ++k) {
      const std::int64_t place = static_cast<std::int64_t>(cell[k]) + at[k];
      hash = permuted(hash + (place % period + period) % period);
    }
    if (component > 0) hash = permuted(hash + component);
    const auto& g = gradients[static_cast<std::size_t>(hash % 16)];
    return way.x * g[0] + way.y * g[1] + way.z * g[2];
  });
}

// Places of which floats hold the offset in the cell as well, also beyond a period and below 0; at some a lattice place, where it
// is 0.
Columns places() {
  Random random(stream);
  Columns in;
  for (int i = 0; i < 4000; ++i) {
    const auto coordinate = [&] { return std::floor(random.number(-600, 600) * 1024) / 1024; };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    const bool lattice = i % 50 == 0;
    add_call(in, lattice ? std::floor(x) : x, lattice ? std::floor(y) : y, lattice ? std::floor(z) : z);
  }
  return in;
}

Measured measure_noise(const Run& run) {
  const Columns in = places(), found = run({Formula::gradient_noise, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      m.add(std::fabs(found[static_cast<std::size_t>(c)][i] - noise(vector_at(in, 0, i), c)), [&] {
        return place({{"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}, {"component", static_cast<double>(c)}});
      });
    }
  }
  return m;
}

// The same after a period along any axis, in every bit; no more than its bound, which no choice of gradients passes; and the
// three of one place are not alike.
Measured measure_tiles(const Run& run) {
  const Columns in = places();
  Columns moved = in;
  Random random(stream + 1);
  for (std::vector<double>& column : moved) {
    for (double& x : column) x += static_cast<double>(period) * std::floor(random.number(-2, 3));
  }
  const Columns here = run({Formula::gradient_noise, in}), there = run({Formula::gradient_noise, moved});
  Measured m;
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const bool holds = here[c][i] == there[c][i] && std::fabs(here[c][i]) <= bound;
      m.add(holds ? 0 : HUGE_VAL, [&] { return place({{"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}}); });
      products += here[c][i] * here[(c + 1) % 3][i];
      squares += here[c][i] * here[c][i];
    }
  }
  m.add(std::fabs(products) < 0.05 * squares ? 0 : HUGE_VAL, [&] { return place({{"correlation", products / squares}}); });
  double worst = 0;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      for (int k = 0; k <= 20; ++k) {
        worst = std::max(worst, blended(glm::dvec3(i, j, k) / 20.0, [](const glm::ivec3&, const glm::dvec3& way) {
                           const glm::dvec3 a = glm::abs(way);
                           return a.x + a.y + a.z - std::min({a.x, a.y, a.z});
                         }));
      }
    }
  }
  m.add(worst <= bound && worst > 1 ? 0 : HUGE_VAL, [&] { return place({{"worst", worst}}); });
  return m;
}

// Across faces of cells it changes no faster than within, and its slope has no step: second differences stay small. Beside the
// step.
Measured measure_smooth(const Run& run) {
  Random random(stream + 2);
  constexpr double step = 1.0 / 512;
  Columns in;
  for (int i = 0; i < 2000; ++i) {
    glm::dvec3 p;
    for (int k = 0; k < 3; ++k) p[k] = std::floor(random.number(-40, 40) * 512) / 512;
    const int axis = i % 3;
    p[axis] = std::floor(p[axis]);
    for (int side = -1; side <= 1; ++side) {
      glm::dvec3 q = p;
      q[axis] += side * step;
      add_call(in, q.x, q.y, q.z);
    }
  }
  const Columns found = run({Formula::gradient_noise, in});
  Measured m;
  for (std::size_t i = 0; i + 2 < in[0].size(); i += 3) {
    for (const std::vector<double>& n : {found[0], found[1], found[2]}) {
      const double slope = std::fabs(n[i + 2] - n[i]) / (2 * step), bend = std::fabs(n[i] - 2 * n[i + 1] + n[i + 2]) / step;
      m.add(slope <= 2.5 ? bend : HUGE_VAL, [&] {
        return place({{"x", in[0][i]}, {"y", in[1][i]}, {"z", in[2][i]}, {"slope", slope}});
      });
    }
  }
  return m;
}

// Rays bent by noise at the place nearest to a Gaussian's centre.
Measured measure_bent(const Run& run) {
  Random random(stream + 3);
  Columns in;
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec3 d = random.direction(), c = random.direction() * random.magnitude(1e-2, 50);
    add_call(in, d.x, d.y, d.z, c.x, c.y, c.z, random.magnitude(0.05, 5), i % 9 == 0 ? 0 : random.number(0, 1),
             random.magnitude(0.2, 4), random.number(0, 256), random.number(0, 256), random.number(0, 256));
  }
  const Columns found = run({Formula::bent_ray, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const glm::dvec3 d = vector_at(in, 0, i), c = vector_at(in, 3, i), offset = vector_at(in, 9, i);
    const glm::dvec3 at = d * std::max(glm::dot(d, c), 0.0) * in[8][i] + offset;
    const double size = in[7][i] * in[6][i] / std::max(glm::length(c), in[6][i]);
    const glm::dvec3 way = glm::normalize(d + size * glm::dvec3(noise(at, 0), noise(at, 1), noise(at, 2)));
    m.add(glm::length(vector_at(found, 0, i) - way), [&] {
      return place({{"dx", d.x}, {"cx", c.x}, {"radius", in[6][i]}, {"amplitude", in[7][i]}});
    });
  }
  return m;
}

}  // namespace

void add_noise_checks(std::vector<Check>& checks) {
  checks.push_back({"gradient_noise", measure_noise, "exact_double", "gradient_noise"});
  checks.push_back({"noise_tiles", measure_tiles, "exact_double", "exact_float"});
  checks.push_back({"noise_smooth", measure_smooth, "noise_smooth", "noise_smooth"});
  checks.push_back({"bent_ray", measure_bent, "bent_ray", "bent_ray"});
}

}  // namespace airlight
