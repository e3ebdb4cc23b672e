// The table of optical depths through sums of Gaussians.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <locale>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "tests/csv.h"

namespace airlight {

struct WayThroughGaussians {
  glm::dvec3 from, to;
  std::vector<Gaussian> gaussians;
  double optical_depth;
};

inline std::vector<WayThroughGaussians> optical_depth_table() {
  const auto stream = [](const std::string& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    return in;
  };
  const auto point = [&](const std::string& text) {
    std::istringstream in = stream(text);
    glm::dvec3 p;
    in >> p.x >> p.y >> p.z;
    return p;
  };
  std::vector<WayThroughGaussians> ways;
  for (const auto& row : csv_rows("reference/optical_depth.csv")) {
    if (row.size() != 4) throw std::runtime_error("optical_depth.csv: a row without four fields");
    WayThroughGaussians way{point(row[0]), point(row[1]), {}, std::stod(row[3])};
    for (const std::string& one : split(row[2], ';')) {
      std::istringstream in = stream(one);
      Gaussian g;
      double a = 0;
      in >> g.center.x >> g.center.y >> g.center.z >> a >> g.extinction;
      g.radius = 1 / a;
      way.gaussians.push_back(g);
    }
    ways.push_back(way);
  }
  return ways;
}

// Optical depth of all lines through the centres.
inline double lines_through_centers(const std::vector<Gaussian>& gaussians) {
  double whole = 0;
  for (const Gaussian& g : gaussians) whole += g.extinction * g.radius * std::sqrt(std::numbers::pi);
  return whole;
}

}  // namespace airlight
