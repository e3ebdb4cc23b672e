#include "common/plan/gaussian_bins.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "common/error.h"

namespace airlight {

namespace {

constexpr std::int64_t most_listed = std::int64_t{1} << 28U;
constexpr double everywhere = 1e300;
constexpr double wider = 1e-6;   // beside a reach: what rays in single precision may miss of it
constexpr double margin = 1e-2;  // [pixel] the same on the screen

struct Range {
  double least, most;
};

// Of x / forward over the directions within a disc of the plane of both axes, before the camera; empty where it is behind.
Range seen(double x, double forward, double reach) {
  const double distance = std::sqrt(x * x + forward * forward);
  if (!(reach < distance)) return {-everywhere, everywhere};
  // Both tangents: the disc's direction, turned.
  const double sine = reach / distance, cosine = std::sqrt(1 - sine * sine);
  const double least_forward = forward * cosine + x * sine, most_forward = forward * cosine - x * sine;
  if (least_forward <= 0 && most_forward <= 0) return {everywhere, -everywhere};
  return {least_forward > 0 ? (x * cosine - forward * sine) / least_forward : -everywhere,
          most_forward > 0 ? (x * cosine + forward * sine) / most_forward : everywhere};
}

struct Squares {
  int least, most;  // none where most < least
};

// Squares that pixels of a range touch, of `count`.
Squares squares(double least, double most, int count) {
  const double from = std::floor((least - margin) / bin_side), to = std::floor((most + margin) / bin_side);
  if (!(from <= to) || to < 0 || from > count - 1) return {0, -1};
  return {static_cast<int>(std::max(from, 0.0)), static_cast<int>(std::min<double>(to, count - 1))};
}

struct Box {
  Squares columns, rows;
};

Box box_of(const View& view, const GaussianDensity& g) {
  const glm::dvec3 center(g.center);
  const double reach = static_cast<double>(g.reach) * (1 + wider), forward = glm::dot(center, glm::dvec3(view.forward));
  const double w = view.extent.width, h = view.extent.height, t = static_cast<double>(view.tan_half_fov);
  const Range x = seen(glm::dot(center, glm::dvec3(view.right)), forward, reach);
  const Range y = seen(glm::dot(center, glm::dvec3(view.up)), forward, reach);
  if (!(x.least <= x.most) || !(y.least <= y.most) || forward <= -reach) return {{0, -1}, {0, -1}};
  // A pixel's sample lies within half a pixel of its centre.
  const auto column = [&](double at) { return (at * h / (w * t) + 1) * w / 2; };
  const auto row = [&](double at) { return (1 - at / t) * h / 2; };
  return {squares(column(x.least), column(x.most), bin_columns(view.extent)),
          squares(row(y.most), row(y.least), bin_rows(view.extent))};
}

}  // namespace

bool in_view(const View& view, const GaussianDensity& g) {
  const Box box = box_of(view, g);
  return box.columns.least <= box.columns.most && box.rows.least <= box.rows.most;
}

std::size_t count_gaussian_bins(const View& view, std::span<const GaussianDensity> gaussians) {
  std::size_t count = static_cast<std::size_t>(bin_columns(view.extent)) * static_cast<std::size_t>(bin_rows(view.extent)) + 1;
  const auto of = [](const Squares& s) { return static_cast<std::size_t>(std::max(s.most - s.least + 1, 0)); };
  for (const GaussianDensity& g : gaussians) {
    const Box box = box_of(view, g);
    count += of(box.columns) * of(box.rows);
  }
  return count;
}

std::vector<std::int32_t> gaussian_bins(const View& view, std::span<const GaussianDensity> gaussians, std::string_view setting,
                                        std::string_view what) {
  const auto columns = static_cast<std::size_t>(bin_columns(view.extent)), rows = static_cast<std::size_t>(bin_rows(view.extent));
  std::vector<Box> boxes;
  std::vector<std::int64_t> counts(columns * rows, 0);
  const auto each = [&](const Box& b, auto&& use) {
    for (int row = b.rows.least; row <= b.rows.most; ++row) {
      for (int column = b.columns.least; column <= b.columns.most; ++column)
        use(static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column));
    }
  };
  std::int64_t all = 0;
  for (const GaussianDensity& g : gaussians) {
    boxes.push_back(box_of(view, g));
    each(boxes.back(), [&](std::size_t square) { ++counts[square], ++all; });
    if (all > most_listed) {
      throw InputError("setting " + std::string(setting) + ": " + std::to_string(gaussians.size()) + " " + std::string(what) +
                       " cover more squares of 16 x 16 pixels than 2^28 together, expected a smaller resolution");
    }
  }
  std::vector<std::int32_t> bins(counts.size() + 1 + static_cast<std::size_t>(all));
  auto at = static_cast<std::int32_t>(counts.size() + 1);
  for (std::size_t square = 0; square < counts.size(); ++square) {
    bins[square] = at;
    at += static_cast<std::int32_t>(counts[square]);
  }
  bins[counts.size()] = at;
  std::vector<std::int32_t> next(bins.begin(), bins.begin() + static_cast<std::ptrdiff_t>(counts.size()));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    each(boxes[i], [&](std::size_t square) { bins[static_cast<std::size_t>(next[square]++)] = static_cast<std::int32_t>(i); });
  }
  return bins;
}

}  // namespace airlight
