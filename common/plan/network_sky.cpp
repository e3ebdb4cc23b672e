// What an illumination network receives of an environment.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/formulas/double.h"
#include "common/plan/environment.h"
#include "common/plan/network.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int columns = 256, rows = 128;  // of cells of the sphere, much smaller than what a direction stands for

struct Cell {
  glm::dvec3 power{0};  // [W/m^2]
  double angle = 0;     // [sr]
};

std::vector<Cell> cells_of(const Environment& e) {
  const std::vector<float> image = environment_image(e);
  const int width = static_cast<int>(image[0]), height = static_cast<int>(image[1]);
  const int parts = (columns + width - 1) / width, across = width * parts, down = height * parts;
  std::vector<Cell> cells(static_cast<std::size_t>(columns) * rows);
  for (int y = 0; y < down; ++y) {
    const double angle = (std::cos(pi * y / down) - std::cos(pi * (y + 1) / down)) * 2 * pi / across;
    for (int x = 0; x < across; ++x) {
      const int column = static_cast<int>((x + 0.5) / across * columns), row = static_cast<int>((y + 0.5) / down * rows);
      Cell& cell = cells[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
      // Cells are of the image, which may be turned.
      const double turns = (x + 0.5) / across - static_cast<double>(image[2]);
      for (int c = 0; c < 3; ++c) cell.power[c] += angle * f64::environment_value(image.data(), c, turns, (y + 0.5) / down);
      cell.angle += angle;
    }
  }
  return cells;
}

}  // namespace

std::vector<float> network_sky(const Environment& e, int line_count, DirectionSet set) {
  const std::vector<glm::dvec3> directions = network_directions(line_count, set);
  const std::vector<Cell> cells = cells_of(e);
  const double turn = e.rotation / 360 - std::floor(e.rotation / 360);
  const auto each_cell = [&](auto&& body) {
    for (int row = 0; row < rows; ++row) {
      const double polar = pi * (row + 0.5) / rows;
      for (int column = 0; column < columns; ++column) {
        const double azimuth = 2 * pi * ((column + 0.5) / columns - 0.5 - turn);
        body(cells[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)],
             glm::dvec3(std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)));
      }
    }
  };
  std::vector<Cell> nearest(2 * directions.size());
  glm::dvec3 all(0);
  each_cell([&](const Cell& cell, const glm::dvec3& from) {
    std::size_t best = 0;
    double most = 0;
    for (std::size_t l = 0; l < directions.size(); ++l) {
      const double cosine = glm::dot(from, directions[l]);
      if (std::fabs(cosine) <= std::fabs(most)) continue;
      most = cosine;
      best = l;
    }
    Cell& to = nearest[2 * best + (most < 0 ? 0 : 1)];  // what comes from there goes the other way
    to.power += cell.power;
    to.angle += cell.angle;
    all += cell.power;
  });
  for (std::size_t d = 0; d < nearest.size(); ++d) {
    if (nearest[d].angle > 0) continue;
    double most = -2;
    each_cell([&](const Cell& cell, const glm::dvec3& from) {
      const double cosine = glm::dot(from, directions[d / 2]) * (d % 2 == 0 ? -1 : 1);
      if (cosine > most) most = cosine, nearest[d] = cell;
    });
  }
  // Directions stand for equal angles in the network, but the cells nearest to each are of nearly equal ones.
  glm::dvec3 sum(0);
  for (const Cell& cell : nearest) sum += cell.power / cell.angle * (4 * pi / static_cast<double>(nearest.size()));
  std::vector<float> sky;
  for (const Cell& cell : nearest) {
    for (int c = 0; c < 3; ++c)
      sky.push_back(static_cast<float>(cell.power[c] / cell.angle * (sum[c] > 0 ? all[c] / sum[c] : 0)));
    sky.push_back(0);
  }
  return sky;
}

}  // namespace airlight
