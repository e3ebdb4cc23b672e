// The ray of a pixel, and a light's place beside it.
#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 100;

// Column i of `width` is the i-th of as many equal parts of [-tan W/H, tan W/H], from the left; its middle is moved by the
// offset.
Measured measure_plane_x(const Run& run) {
  Random random(stream);
  Columns in;
  for (int k = 0; k < 20000; ++k) {
    const double w = std::floor(random.magnitude(1, 16384)), h = std::floor(random.magnitude(1, 16384));
    add_call(in, std::floor(random.number(0, w)), random.number(-0.5, 0.5), w, h, random.magnitude(1e-3, 50));
  }
  add_call(in, 0, 0, 4, 2, 1);  // known: -1.5
  const Columns found = run({Formula::image_plane_x, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    const double edge = in[4][k] * in[2][k] / in[3][k], part = (in[0][k] + 0.5 + in[1][k]) / in[2][k];
    const double truth = (1 - part) * -edge + part * edge;
    m.add(std::fabs(found[0][k] - truth) / edge, [&] { return place({{"column", in[0][k]}, {"width", in[2][k]}}); });
  }
  m.add(std::fabs(found[0].back() + 1.5), [] { return "column 0 of 4"; });
  return m;
}

// Row j of `height`, from the top.
Measured measure_plane_y(const Run& run) {
  Random random(stream + 1);
  Columns in;
  for (int k = 0; k < 20000; ++k) {
    const double h = std::floor(random.magnitude(1, 16384));
    add_call(in, std::floor(random.number(0, h)), random.number(-0.5, 0.5), h, random.magnitude(1e-3, 50));
  }
  add_call(in, 0, 0, 2, 1);  // known: 0.5
  const Columns found = run({Formula::image_plane_y, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    const double edge = in[3][k], part = (in[0][k] + 0.5 + in[1][k]) / in[2][k];
    m.add(std::fabs(found[0][k] - ((1 - part) * edge - part * edge)) / edge, [&] {
      return place({{"row", in[0][k]}, {"height", in[2][k]}});
    });
  }
  m.add(std::fabs(found[0].back() - 0.5), [] { return "row 0 of 2"; });
  return m;
}

Measured measure_view_ray(const Run& run) {
  Random random(stream + 2);
  Columns in;
  for (int k = 0; k < 20000; ++k) {
    const glm::dvec3 f = random.direction(), r = glm::normalize(glm::cross(f, random.direction())), u = glm::cross(r, f);
    const double x = random.number(-1, 1) * random.magnitude(1e-6, 50), y = random.number(-1, 1) * random.magnitude(1e-6, 50);
    add_call(in, x, y, r.x, r.y, r.z, u.x, u.y, u.z, f.x, f.y, f.z);
  }
  const Columns found = run({Formula::view_ray, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    // The inputs' vectors are orthonormal only to a float's accuracy, and the formula scales by what they should be.
    const double x = in[0][k], y = in[1][k];
    const glm::dvec3 truth = (vector_at(in, 2, k) * x + vector_at(in, 5, k) * y + vector_at(in, 8, k)) / std::hypot(x, y, 1.0);
    m.add(glm::length(vector_at(found, 0, k) - truth), [&] { return place({{"x", x}, {"y", y}}); });
  }
  return m;
}

// Foot and distance relative to the point's distance; `least` holds.
Measured measure_perpendicular(const Run& run) {
  Random random(stream + 3);
  Columns in;
  for (int k = 0; k < 20000; ++k) {
    const glm::dvec3 d = random.direction();
    const glm::dvec3 side = glm::normalize(glm::cross(d, random.direction()));
    const double l = random.magnitude(1e-3, 1e5), angle = k % 2 == 0 ? random.magnitude(1e-7, 1) : random.number(0, 3.14159);
    const glm::dvec3 p = l * (std::cos(angle) * d + std::sin(angle) * side);
    add_call(in, d.x, d.y, d.z, p.x, p.y, p.z, l * random.magnitude(1e-6, 1e-2));
  }
  const Columns found = run({Formula::perpendicular, in});
  Measured m;
  for (std::size_t k = 0; k < in[0].size(); ++k) {
    const glm::dvec3 d = vector_at(in, 0, k), p = vector_at(in, 3, k);
    const double l = glm::length(p), foot = glm::dot(d, p) / glm::length(d);
    const double h = std::max(glm::length(glm::cross(d, p)) / glm::length(d), in[6][k]);
    m.add(std::max(std::fabs(found[0][k] - foot), std::fabs(found[1][k] - h)) / l, [&] {
      return place({{"foot", foot}, {"h", h}, {"distance", l}});
    });
    m.add(found[1][k] >= in[6][k] ? 0 : HUGE_VAL, [&] { return place({{"least", in[6][k]}, {"found h", found[1][k]}}); });
  }
  return m;
}

}  // namespace

void add_camera_checks(std::vector<Check>& checks) {
  checks.push_back({"image_plane_x", measure_plane_x, "geometry_double", "image_plane"});
  checks.push_back({"image_plane_y", measure_plane_y, "geometry_double", "image_plane"});
  checks.push_back({"view_ray", measure_view_ray, "geometry_double", "direction"});
  checks.push_back({"perpendicular", measure_perpendicular, "perpendicular_double", "direction"});
}

}  // namespace airlight
