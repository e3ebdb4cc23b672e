// The order of shadow planes as wholes: what a ray meets later comes first.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "common/plan/shadow_volumes.h"
#include "tests/parity/inputs.h"

namespace airlight {
namespace {

glm::dvec3 vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

glm::dvec3 in_cube(std::uint32_t seed, std::uint32_t k) {
  return {2 * uniform(seed, k) - 1, 2 * uniform(seed + 1, k) - 1, 2 * uniform(seed + 2, k) - 1};
}

std::vector<ShadowEdge> random_edges(std::uint32_t n, double longest) {
  std::vector<ShadowEdge> edges(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const glm::dvec3 a = 3.0 * in_cube(11, i), b = a + longest * in_cube(21, i);
    for (int c = 0; c < 3; ++c) edges[i].a[c] = a[c], edges[i].b[c] = b[c];
    edges[i].multiplicity = static_cast<std::int32_t>(i) + 1;
  }
  return edges;
}

// How far along the ray it crosses the plane.
std::optional<double> crossing(const glm::dvec3& ray, const ShadowEdge& e, const ShadowLight& light) {
  const glm::dvec3 a = vector(e.a), b = vector(e.b), l = vector(light.vector);
  if (light.point > 0) {  // t ray = l + alpha (a - l) + beta (b - l)
    const glm::dvec3 w = glm::inverse(glm::dmat3(ray, l - a, l - b)) * l;
    if (w.x > 0 && w.y >= 0 && w.z >= 0 && w.y + w.z >= 1) return w.x;
  } else {  // t ray = a + beta (b - a) - s l
    const glm::dvec3 w = glm::inverse(glm::dmat3(ray, a - b, l)) * a;
    if (w.x > 0 && w.y >= 0 && w.y <= 1 && w.z >= 0) return w.x;
  }
  return std::nullopt;
}

struct Range {
  double least, most;
};
// Of what grows along every ray: the angle at a point light, or the distance from the line toward a directional one.
Range range_of(const ShadowEdge& e, const ShadowLight& light) {
  const glm::dvec3 a = vector(e.a), b = vector(e.b), l = vector(light.vector), middle = 0.5 * (a + b);
  if (light.point == 0) {
    const double at = glm::length(glm::cross(l, middle)), half = 0.5 * glm::length(glm::cross(l, b - a));
    return {at - half, at + half};
  }
  const auto angle = [](const glm::dvec3& p, const glm::dvec3& q) {
    return std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));
  };
  const double at = angle(-l, middle - l), half = std::max(angle(a - l, middle - l), angle(b - l, middle - l));
  return {at - half, at + half};
}

void expect_back_to_front(const ShadowLight& light) {
  std::vector<ShadowEdge> edges = random_edges(150, 0.6);
  back_to_front(edges, light);
  std::int64_t sum = 0;
  for (const ShadowEdge& e : edges) sum += e.multiplicity;
  EXPECT_EQ(sum, 150 * 151 / 2) << "one is lost";
  int pairs = 0;
  for (std::uint32_t k = 0; k < 10000; ++k) {
    const glm::dvec3 ray = glm::normalize(in_cube(31, k));
    std::vector<std::pair<double, Range>> crossed;
    for (const ShadowEdge& e : edges) {
      if (const auto t = crossing(ray, e, light)) crossed.emplace_back(*t, range_of(e, light));
    }
    for (std::size_t i = 0; i < crossed.size(); ++i) {
      for (std::size_t j = i + 1; j < crossed.size(); ++j) {
        const Range &first = crossed[i].second, &second = crossed[j].second;
        if (first.least <= second.most && second.least <= first.most) continue;  // they may interleave
        EXPECT_GT(crossed[i].first, crossed[j].first);
        ++pairs;
      }
    }
  }
  EXPECT_GT(pairs, 1000);
}

TEST(ShadowOrder, IsThatOfEveryRayUnderALamp) {
  expect_back_to_front({.vector = {0.7, 1.9, -0.4}, .point = 1, .first = 0, .count = 0, .covering = 0});
}

TEST(ShadowOrder, IsThatOfEveryRayUnderTheSun) {
  const glm::dvec3 up = glm::normalize(glm::dvec3(0.3, 1, -0.2));
  expect_back_to_front({.vector = {up.x, up.y, up.z}, .point = 0, .first = 0, .count = 0, .covering = 0});
}

TEST(ShadowOrder, KeepsEqualPlanesAndThoseThroughTheLight) {
  std::vector<ShadowEdge> edges = random_edges(4, 0.5);
  edges[1] = edges[0];
  edges[1].multiplicity = -7;
  for (ShadowEdge* e : {&edges[2], &edges[3]}) {  // its middle is the light
    for (int c = 0; c < 3; ++c) e->a[c] = c == 0 ? -1 : 1, e->b[c] = c == 0 ? 3 : 1;
  }
  back_to_front(edges, {.vector = {1, 1, 1}, .point = 1, .first = 0, .count = 0, .covering = 0});
  std::vector<std::int32_t> order;
  order.reserve(edges.size());
  for (const ShadowEdge& e : edges) order.push_back(e.multiplicity);
  EXPECT_EQ(order, (std::vector<std::int32_t>{3, 4, 1, -7}));
}

}  // namespace
}  // namespace airlight
