// Where a ray meets the plane of a triangle, and the normal there.
#include <algorithm>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 110;

void add_triangle(Columns& in, const glm::dvec3& d, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  add_call(in, d.x, d.y, d.z, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z);
}

// Rays through the inside, seen under any angle. What is known of the distance and the weights falls with the cosine of that
// angle and with the triangle's height beside its distance: the error is stated beside that.
Measured measure_ray_triangle(const Run& run) {
  Random random(stream);
  Columns in;
  while (in.empty() || in[0].size() < 40000) {
    const glm::dvec3 a = random.direction() * random.magnitude(0.1, 100);
    const double size = random.magnitude(1e-2, 10) * glm::length(a);
    const glm::dvec3 b = a + random.direction() * size, c = a + random.direction() * size * random.number(0.1, 1);
    double wb = random.number(0.02, 0.96), wc = random.number(0.02, 0.96);
    if (wb + wc > 0.98) wb = 0.98 - wb, wc = 0.98 - wc;
    if (wb < 0.02 || wc < 0.02) continue;
    add_triangle(in, glm::normalize(a + wb * (b - a) + wc * (c - a)), a, b, c);
  }
  const Columns found = run({Formula::ray_triangle, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    const glm::dvec3 d = vector_at(in, 0, k), a = vector_at(in, 3, k), u = vector_at(in, 6, k) - a, v = vector_at(in, 9, k) - a;
    const glm::dvec3 n = glm::cross(u, v);
    const double cosine = std::fabs(glm::dot(n, d)) / glm::length(n),
                 far = std::max({glm::length(a), glm::length(a + u), glm::length(a + v)});
    const double height = glm::length(n) / std::max({glm::length(u), glm::length(v), glm::length(u - v)});
    if (!(cosine > 0.02) || height < 0.002 * far) continue;
    // Moeller and Trumbore 1997: Cramer's rule on a + wb u + wc v = t d.
    const glm::dvec3 p = glm::cross(d, v), q = glm::cross(-a, u);
    const double det = glm::dot(u, p), t = glm::dot(v, q) / det, wb = glm::dot(-a, p) / det, wc = glm::dot(d, q) / det;
    const double known = far / (height * cosine);
    m.add(std::fabs(found[0][k] - t) * cosine / far + (std::fabs(found[1][k] - wb) + std::fabs(found[2][k] - wc)) / known, [&] {
      return place({{"distance", t}, {"b", wb}, {"c", wc}, {"cosine", cosine}, {"height", height}});
    });
  }
  return m;
}

// Rays beside the triangle, in its plane, triangles without an area, huge and tiny ones: the results are held inside.
Measured measure_ray_triangle_held(const Run& run) {
  Random random(stream + 1);
  Columns in;
  for (int k = 0; k < 40000; ++k) {
    const double scale = random.magnitude(1e-6, 1e6);
    const glm::dvec3 a = random.direction() * scale, b = a + random.direction() * scale * random.magnitude(1e-4, 1);
    glm::dvec3 c = a + random.direction() * scale * random.magnitude(1e-4, 1);
    glm::dvec3 d = random.direction();
    if (k % 4 == 1) d = glm::normalize(a + random.number() * (b - a));
    if (k % 4 == 2) c = k % 8 == 2 ? b : a + 0.5 * (b - a);
    if (k % 4 == 3) d = glm::normalize(b - a);
    add_triangle(in, d, a, b, c);
  }
  const Columns found = run({Formula::ray_triangle, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    const double far =
        std::max({glm::length(vector_at(in, 3, k)), glm::length(vector_at(in, 6, k)), glm::length(vector_at(in, 9, k))});
    const double t = found[0][k], wb = found[1][k], wc = found[2][k];
    const bool inside = t >= 0 && wb >= 0 && wc >= 0;  // NaN is not
    m.add(inside ? std::max({t / far - 1, wb + wc - 1, 0.0}) : HUGE_VAL, [&] {
      return place({{"distance", t}, {"farthest", far}, {"b", wb}, {"c", wc}});
    });
  }
  return m;
}

// Interpolated, of length 1, against the ray. The error is stated beside the length of the sum: what is left where normals cancel
// has few digits.
Measured measure_shading_normal(const Run& run) {
  Random random(stream + 2);
  Columns in;
  for (int k = 0; k < 40000; ++k) {
    const glm::dvec3 d = random.direction(), na = random.direction();
    const double spread = random.magnitude(1e-3, 3);
    const glm::dvec3 nb = glm::normalize(na + spread * random.direction()), nc = glm::normalize(na + spread * random.direction());
    const double wb = random.number(), wc = random.number(0, 1 - wb);
    add_call(in, d.x, d.y, d.z, na.x, na.y, na.z, nb.x, nb.y, nb.z, nc.x, nc.y, nc.z, wb, wc);
  }
  // Normals that cancel: against the ray.
  for (int k = 0; k < 10; ++k) {
    const glm::dvec3 d = random.direction(), n = random.direction();
    add_call(in, d.x, d.y, d.z, n.x, n.y, n.z, -n.x, -n.y, -n.z, n.x, n.y, n.z, 0.5, 0);
  }
  const Columns found = run({Formula::shading_normal, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    const glm::dvec3 d = vector_at(in, 0, k);
    const double wb = in[12][k], wc = in[13][k];
    const glm::dvec3 sum = (1 - wb - wc) * vector_at(in, 3, k) + wb * vector_at(in, 6, k) + wc * vector_at(in, 9, k);
    const double length = glm::length(sum), toward = length > 0 ? glm::dot(sum, d) / length : 0;
    const auto where = [&] {
      return place({{"length of the sum", length}, {"toward the ray", toward}, {"call", static_cast<double>(k)}});
    };
    if (length == 0) {
      m.add(glm::length(vector_at(found, 0, k) + d), where);
    } else if (length > 1e-3 && std::fabs(toward) * length > 1e-5) {
      const glm::dvec3 truth = toward > 0 ? -sum / length : sum / length;
      m.add(glm::length(vector_at(found, 0, k) - truth) * length, where);
    }
  }
  return m;
}

// The side whose normal, that of the interpolated ones, looks against the ray.
Measured measure_seen_side(const Run& run) {
  Random random(stream + 3);
  Columns in;
  for (int k = 0; k < 20000; ++k) {
    const glm::dvec3 d = random.direction(), na = random.direction(), nb = random.direction(), nc = random.direction();
    const double wb = random.number(), wc = random.number(0, 1 - wb);
    add_call(in, d.x, d.y, d.z, na.x, na.y, na.z, nb.x, nb.y, nb.z, nc.x, nc.y, nc.z, wb, wc);
  }
  const Columns found = run({Formula::seen_side, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    const double wb = in[12][k], wc = in[13][k];
    const double toward =
        glm::dot(vector_at(in, 0, k), (1 - wb - wc) * vector_at(in, 3, k) + wb * vector_at(in, 6, k) + wc * vector_at(in, 9, k));
    if (!(std::fabs(toward) > 1e-5)) continue;
    m.add(std::fabs(found[0][k] - (toward > 0 ? -1 : 1)), [&] { return place({{"toward the ray", toward}}); });
  }
  return m;
}

// The weighted sum, beside the largest of the three; at the corners what is there.
Measured measure_between_corners(const Run& run) {
  Random random(stream + 4);
  Columns in;
  for (int k = 0; k < 20000; ++k) {
    const double scale = random.magnitude(1e-6, 1e6), wb = k % 4 == 0 ? k / 4 % 2 : random.number();
    const double wc = k % 4 == 0 ? (1 - wb) * (k / 8 % 2) : random.number(0, 1 - wb);
    add_call(in, scale * random.number(-1, 1), scale * random.number(-1, 1), scale * random.number(-1, 1), wb, wc);
  }
  const Columns found = run({Formula::between_corners, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    const double a = in[0][k], b = in[1][k], c = in[2][k], wb = in[3][k], wc = in[4][k];
    const double truth = (1 - wb - wc) * a + wb * b + wc * c;
    m.add(std::fabs(found[0][k] - truth) / std::max({std::fabs(a), std::fabs(b), std::fabs(c)}), [&] {
      return place({{"a", a}, {"b", b}, {"c", c}, {"weight of b", wb}, {"of c", wc}});
    });
  }
  return m;
}

}  // namespace

void add_triangle_checks(std::vector<Check>& checks) {
  checks.push_back({"ray_triangle", measure_ray_triangle, "geometry_double", "ray_triangle"});
  checks.push_back({"ray_triangle_held", measure_ray_triangle_held, "geometry_double", "direction"});
  checks.push_back({"seen_side", measure_seen_side, "geometry_double", "geometry_double"});
  checks.push_back({"between_corners", measure_between_corners, "between_corners_double", "between_corners"});
  checks.push_back({"shading_normal", measure_shading_normal, "geometry_double", "direction"});
}

}  // namespace airlight
