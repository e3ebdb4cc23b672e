// The rays of a square of the screen as a cone, and what bounds hold over all of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"
#include "common/plan/gaussian_shadows.h"

namespace airlight {

// The rays of a square of `side` pixels whose upper left one is (x, y): those from the camera within an angle of the axis. Places
// are seen from the camera [m]. Only + - * / and square roots: the same on every machine.
struct RayCone {
  glm::dvec3 axis{0, 0, 1};
  double cos = 1, sin = 0;

  RayCone(const View& view, int x, int y, int side) {
    const double w = view.extent.width, h = view.extent.height, t = static_cast<double>(view.tan_half_fov);
    glm::dvec3 corner[4];
    for (int k = 0; k < 4; ++k) {
      const double across = x + (k % 2 == 0 ? 0 : side), down = y + (k < 2 ? 0 : side);
      const double u = (2 * across / w - 1) * t * w / h, v = (1 - 2 * down / h) * t;
      corner[k] = glm::normalize(u * glm::dvec3(view.right) + v * glm::dvec3(view.up) + glm::dvec3(view.forward));
    }
    // Samples lie up to half a pixel beside a pixel's centre: within the corners.
    axis = glm::normalize(corner[0] + corner[1] + corner[2] + corner[3]);
    for (const glm::dvec3& c : corner) cos = std::min(cos, glm::dot(axis, c));
    cos -= 1e-12;
    sin = std::sqrt(std::max(0.0, 1 - cos * cos));
  }

  // A place by its coordinates along the axis and beside it.
  struct Place {
    double along, beside;
  };
  Place place(const glm::dvec3& p) const {
    const double along = glm::dot(p, axis);
    return {along, std::sqrt(std::max(0.0, glm::dot(p, p) - along * along))};
  }
  // Bounds over all rays of the foot of a place, and of its distance from them.
  double least_foot(Place p) const { return p.along * cos - p.beside * sin; }
  double most_foot(Place p) const {
    const bool inside = p.along > 0 && p.beside * cos < p.along * sin;
    return inside ? std::sqrt(p.along * p.along + p.beside * p.beside) : p.along * cos + p.beside * sin;
  }
  double least_distance(Place p) const { return std::max(0.0, p.beside * cos - std::fabs(p.along) * sin); }

  bool meets(const GaussianDensity& g) const {
    const Place p = place(g.center);
    const double within = static_cast<double>(g.reach), h = least_distance(p);
    return h < within && most_foot(p) + std::sqrt((within - h) * (within + h)) > 0;
  }

  // Around what the rays cover between two distances.
  Sphere around(double from, double to) const {
    const double middle = (from + to) / 2;
    double radius = (to - from) / 2;
    for (const double t : {from, to}) {
      const double along = t * cos - middle, beside = t * sin;
      radius = std::max(radius, std::sqrt(along * along + beside * beside));
    }
    return {axis * middle, radius};
  }
};

}  // namespace airlight
