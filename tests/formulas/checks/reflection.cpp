// Lambert and Phong.
#include <algorithm>
#include <numbers>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 130;
constexpr double pi = std::numbers::pi;

Measured measure_lambert(const Run& run) {
  Columns in;
  for (int i = -1000; i <= 1000; ++i) add_call(in, i / 1000.0);
  const Columns found = run({Formula::lambert, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    m.add(relative_error(found[0][i], std::max(in[0][i], 0.0) / pi), [&] { return place({{"cosine", in[0][i]}}); });
  }
  return m;
}

// 1 - cos of angles from 1e-3 to pi. Rounded to float, the vectors are no longer of length 1, which matters more to smaller
// angles.
Measured measure_unit_distance(const Run& run) {
  Random random(stream);
  Columns in;
  for (int i = 0; i < 40000; ++i) {
    const glm::dvec3 a = random.direction(), side = glm::normalize(glm::cross(a, random.direction()));
    const double angle = random.magnitude(1e-3, pi);
    const glm::dvec3 b = std::cos(angle) * a + std::sin(angle) * side;
    add_call(in, a.x, a.y, a.z, b.x, b.y, b.z);
  }
  const Columns found = run({Formula::unit_distance, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const glm::dvec3 a = glm::normalize(vector_at(in, 0, i)), b = glm::normalize(vector_at(in, 3, i));
    const double sine = glm::length(glm::cross(a, b)), angle = std::atan2(sine, glm::dot(a, b));
    m.add(relative_error(found[0][i], 2 * std::sin(angle / 2) * std::sin(angle / 2)), [&] { return place({{"angle", angle}}); });
  }
  return m;
}

// (n + 1) / 2 pi (r.l)^n, beside 1 + the logarithm of that power: it is rounded.
Measured measure_phong(const Run& run) {
  Random random(stream + 1);
  Columns in;
  for (const double n : {0.0, 1.0, 20.0, 1e4}) {
    for (const double apart : {0.0, 1e-7, 0.5, 1.0, 1.5, 2.0}) {
      for (const double cosine : {-0.5, 0.0, 0.5}) add_call(in, cosine, apart, n);
    }
  }
  for (int i = 0; i < 40000; ++i) {
    const double n = random.magnitude(0.1, 1e4);
    add_call(in, random.number(-0.2, 1), std::min(random.magnitude(1e-3, 50) / n, 0.999), n);
  }
  const Columns found = run({Formula::phong, in});
  Measured m;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    const double apart = in[1][i], n = in[2][i], power = apart < 1 ? n * std::log1p(-apart) : 0;
    const double truth = in[0][i] > 0 && apart < 1 ? (n + 1) / (2 * pi) * std::exp(power) : 0;
    if (power < -80) continue;  // held there
    m.add(relative_error(found[0][i], truth) / (1 - power), [&] {
      return place({{"cosine", in[0][i]}, {"apart", apart}, {"shininess", n}});
    });
  }
  return m;
}

}  // namespace

void add_reflection_checks(std::vector<Check>& checks) {
  checks.push_back({"lambert", measure_lambert, "exact_double", "exact_float"});
  checks.push_back({"unit_distance", measure_unit_distance, "unit_distance", "unit_distance"});
  checks.push_back({"phong", measure_phong, "phong_double", "phong"});
}

}  // namespace airlight
