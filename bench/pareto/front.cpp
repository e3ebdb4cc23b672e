#include "bench/pareto/front.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace airlight {

namespace {

bool timed(const Point& p) { return p.ms > 0 && std::isfinite(p.error.everywhere); }

bool same_backend(const Point& a, const Point& b) { return a.configuration.backend == b.configuration.backend; }

// The least timed point by an order, the first of equal ones.
template <class Accepted, class Order>
const Point* least(const std::vector<Point>& points, const Accepted& accepted, const Order& order) {
  const Point* best = nullptr;
  for (const Point& p : points) {
    if (timed(p) && accepted(p) && (!best || order(p) < order(*best))) best = &p;
  }
  return best;
}

std::tuple<double, double> by_time(const Point& p) { return {p.ms, p.error.everywhere}; }
std::tuple<double, double> by_error(const Point& p) { return {p.error.everywhere, p.ms}; }

}  // namespace

void mark_fronts(std::vector<Point>& points) {
  const auto beats = [](const Point& a, const Point& b) {
    return a.ms <= b.ms && a.error.everywhere <= b.error.everywhere && (a.ms < b.ms || a.error.everywhere < b.error.everywhere);
  };
  for (Point& p : points) {
    p.on_front = timed(p) && std::none_of(points.begin(), points.end(), [&](const Point& other) {
                   return timed(other) && same_backend(other, p) && beats(other, p);
                 });
  }
}

std::vector<bool> near_front(const std::vector<Point>& points, double slack) {
  std::vector<bool> near;
  near.reserve(points.size());
  for (const Point& p : points) {
    near.push_back(std::isfinite(p.error.everywhere) && std::none_of(points.begin(), points.end(), [&](const Point& other) {
                     return same_backend(other, p) && other.configuration.technique == p.configuration.technique &&
                            other.small_ms * slack < p.small_ms && other.error.everywhere <= p.error.everywhere;
                   }));
  }
  return near;
}

const Point* chosen(const std::vector<Point>& points, const Goal& goal) {
  if (goal.error)
    return least(
        points, [&](const Point& p) { return p.error.everywhere <= *goal.error; }, by_time);
  return least(
      points, [&](const Point& p) { return p.ms <= 1e3 * goal.seconds.value_or(0); }, by_error);
}

const Point* nearest(const std::vector<Point>& points, const Goal& goal) {
  const auto any = [](const Point&) { return true; };
  return goal.error ? least(points, any, by_error) : least(points, any, by_time);
}

}  // namespace airlight
