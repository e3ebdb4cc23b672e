#include "common/transfer/receivers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>
#include <unordered_set>

namespace airlight {

namespace {

constexpr double shortest_edge = 1.0 / 32;  // of the smallest caster
constexpr double least_bend = 0.03;         // of a white surface under a white sky
constexpr std::size_t chunk = 64;

}  // namespace

Receivers::Receivers(const Scene& scene, const Occluders& occluders, const SphereOfDirections& directions, int threads,
                     Progress& progress)
    : occluders_(occluders), directions_(directions), threads_(threads), progress_(progress) {
  shortest_ = std::max(shortest_edge * occluders.smallest(), 1000 * occluders.resolution());
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    const auto first = static_cast<std::uint32_t>(places_.size());
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(surface.transform)));
    std::map<std::tuple<double, double, double>, std::uint32_t> welds;
    for (std::size_t v = 0; v < surface.mesh->positions.size(); ++v) {
      Place place;
      place.position = glm::dvec3(surface.transform * glm::dvec4(glm::dvec3(surface.mesh->positions[v]), 1.0));
      place.normal = glm::normalize(turn * glm::dvec3(surface.mesh->normals[v]));
      const auto [at, added] = welds.try_emplace({place.position.x, place.position.y, place.position.z}, welds_);
      place.weld = at->second;
      if (added) ++welds_;
      places_.push_back(place);
    }
    for (const glm::uvec3& t : surface.mesh->triangles) triangles_.emplace_back(first + t, static_cast<std::uint32_t>(s));
  }
  own_ = places_.size();
}

// body(i) for all i on all threads; the first exception is thrown again when all have stopped.
void Receivers::each(std::size_t count, const char* what, const std::function<void(std::size_t)>& body) const {
  std::atomic<std::size_t> next{0};
  std::mutex lock;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t first = next.fetch_add(chunk); first < count; first = next.fetch_add(chunk)) {
        progress_.check();
        for (std::size_t i = first; i < std::min(first + chunk, count); ++i) body(i);
        progress_.report(what, static_cast<double>(first) / static_cast<double>(count));
      }
    } catch (...) {
      const std::lock_guard guard(lock);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads_; ++i) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

double Receivers::length(Edge e) const { return glm::length(places_[e >> 32U].position - places_[e & 0xffffffffU].position); }

// From a place on these triangles: a little inward from their borders, so that a wall that begins there is seen; above the planes
// of all, so that none of them is met; and off them by more than single precision tells apart.
void Receivers::look(Place& place, std::span<const std::uint32_t> triangles) const {
  const double long_enough = glm::length(place.normal);
  if (!(long_enough > 0.1) || triangles.empty()) return;  // nothing can be seen there
  const glm::dvec3 up = place.normal / long_enough;
  glm::dvec3 inward(0);
  double size = 0;
  for (const std::uint32_t number : triangles) {
    const glm::uvec4& t = triangles_[number];
    const glm::dvec3 way = (places_[t.x].position + places_[t.y].position + places_[t.z].position) / 3.0 - place.position;
    inward += way / static_cast<double>(triangles.size());
    size += glm::length(way) / static_cast<double>(triangles.size());
  }
  inward -= glm::dot(inward, up) * up;
  const double off = std::max(1e-4 * size, occluders_.resolution());
  for (int side = 0; side < 2; ++side) {
    const glm::dvec3 normal = side == 0 ? up : -up;
    glm::dvec3 from = 1e-3 * inward;
    double lift = 0;
    for (const std::uint32_t number : triangles) {
      const glm::uvec4& t = triangles_[number];
      const glm::dvec3 a = places_[t.x].position;
      glm::dvec3 face = glm::cross(places_[t.y].position - a, places_[t.z].position - a);
      const double slope = glm::dot(face, normal);
      if (std::fabs(slope) > 0.05 * glm::length(face)) lift = std::max(lift, -glm::dot(from, face) / slope);
    }
    from += place.position + (lift + off) * normal;
    place.sides[static_cast<std::size_t>(side)] = hidden_sphere(occluders_, directions_, from, normal);
  }
}

Receivers::Place Receivers::midway(Edge e) const {
  const Place &a = places_[e >> 32U], &b = places_[e & 0xffffffffU];
  Place middle;
  middle.position = (a.position + b.position) / 2.0;
  middle.normal = (a.normal + b.normal) / 2.0;
  return middle;
}

// Whether what is hidden in the middle differs from the mean of the ends; or a caster is so near that more may be hidden
// between than these three tell.
bool Receivers::bends(Edge e, const Place& middle) const {
  const Place &a = places_[e >> 32U], &b = places_[e & 0xffffffffU];
  const double size = length(e);
  if (!(glm::length(a.normal) > 0.1 && glm::length(b.normal) > 0.1 && glm::length(middle.normal) > 0.1)) return false;
  const glm::dvec3 normal = glm::normalize(middle.normal);
  if (size > 4 * shortest_ && occluders_.near(middle.position, size, normal, 1e-3 * size)) return true;
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1 : -1;
    const glm::dvec4 at = hidden_share(middle.sides[side], sign * normal);
    const glm::dvec4 mean = (hidden_share(a.sides[side], sign * glm::normalize(a.normal)) +
                             hidden_share(b.sides[side], sign * glm::normalize(b.normal))) /
                            2.0;
    if (glm::length(at - mean) > least_bend) return true;
  }
  return false;
}

void Receivers::look_from_vertices() {
  std::vector<std::uint32_t> first(places_.size() + 1), members(3 * triangles_.size());
  for (const glm::uvec4& t : triangles_) {
    for (int k = 0; k < 3; ++k) ++first[t[k] + 1];
  }
  for (std::size_t v = 0; v < places_.size(); ++v) first[v + 1] += first[v];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    for (int k = 0; k < 3; ++k) members[next[triangles_[i][k]]++] = i;
  }
  each(places_.size(), "what surfaces hide of the sky",
       [&](std::size_t v) { look(places_[v], std::span(members).subspan(first[v], first[v + 1] - first[v])); });
}

// From the middle of each that has none yet.
void Receivers::look_from_long_edges() {
  struct Asked {
    Edge edge;
    std::vector<std::uint32_t> triangles;
    Middle middle;
  };
  std::vector<Asked> asked;
  std::unordered_map<Edge, std::size_t> number;
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const Edge e = edge(triangles_[i][k], triangles_[i][(k + 1) % 3]);
      if (!(length(e) > shortest_) || middles_.contains(e)) continue;
      const auto [at, added] = number.try_emplace(e, asked.size());
      if (added) asked.push_back({e, {}, {}});
      asked[at->second].triangles.push_back(i);
    }
  }
  each(asked.size(), "where shadows of the sky bend", [&](std::size_t i) {
    Asked& a = asked[i];
    a.middle.place = midway(a.edge);
    look(a.middle.place, a.triangles);
    a.middle.bends = bends(a.edge, a.middle.place);
  });
  for (Asked& a : asked) middles_.emplace(a.edge, std::move(a.middle));
}

// Cuts edges that bend, and of each triangle that is cut the longest edge too (Rivara 1984), which keeps triangles from becoming
// slivers. False where none is left, or too many would be.
bool Receivers::cut() {
  std::unordered_set<Edge> chosen;  // welded
  for (const glm::uvec4& t : triangles_) {
    for (int k = 0; k < 3; ++k) {
      const Edge e = edge(t[k], t[(k + 1) % 3]);
      const auto middle = middles_.find(e);
      if (middle != middles_.end() && middle->second.bends) chosen.insert(welded(e));
    }
  }
  if (chosen.empty()) return false;
  // Of equally long ones the same for both triangles that share it.
  const auto longest = [&](const glm::uvec4& t) {
    int best = 0;
    for (int k = 1; k < 3; ++k) {
      const Edge a = edge(t[best], t[(best + 1) % 3]), b = edge(t[k], t[(k + 1) % 3]);
      const double la = length(a), lb = length(b);
      if (lb > la || (lb == la && welded(b) < welded(a))) best = k;
    }
    return best;
  };
  for (bool more = true; more;) {
    more = false;
    for (const glm::uvec4& t : triangles_) {
      bool any = false;
      for (int k = 0; k < 3; ++k) any = any || chosen.contains(welded(edge(t[k], t[(k + 1) % 3])));
      if (!any) continue;
      const int k = longest(t);
      more = chosen.insert(welded(edge(t[k], t[(k + 1) % 3]))).second || more;
    }
  }
  if (midpoints_.size() + chosen.size() > SurfaceTransfer::most_cuts) return false;

  std::unordered_map<Edge, std::uint32_t> vertex;
  const auto middle_of = [&](std::uint32_t a, std::uint32_t b) -> std::int64_t {
    const Edge e = edge(a, b);
    if (!chosen.contains(welded(e))) return -1;
    const auto [at, added] = vertex.try_emplace(e, static_cast<std::uint32_t>(places_.size()));
    if (added) {
      Place place = middles_.at(e).place;
      const auto [weld, first] = weld_of_middle_.try_emplace(welded(e), welds_);
      place.weld = weld->second;
      if (first) ++welds_;
      places_.push_back(place);
      midpoints_.emplace_back(e >> 32U, e & 0xffffffffU);
    }
    return at->second;
  };
  std::vector<glm::uvec4> next;
  next.reserve(triangles_.size() + 2 * chosen.size());
  for (const glm::uvec4& t : triangles_) {
    const int k = longest(t);
    const std::uint32_t p = t[k], q = t[(k + 1) % 3], r = t[(k + 2) % 3];
    if (!chosen.contains(welded(edge(p, q)))) {
      next.push_back(t);
      continue;
    }
    const auto m = static_cast<std::uint32_t>(middle_of(p, q));
    const std::int64_t beside_q = middle_of(q, r), beside_p = middle_of(r, p);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { next.emplace_back(a, b, c, t.w); };
    if (beside_q < 0) {
      add(m, q, r);
    } else {
      add(m, q, static_cast<std::uint32_t>(beside_q)), add(m, static_cast<std::uint32_t>(beside_q), r);
    }
    if (beside_p < 0) {
      add(m, r, p);
    } else {
      add(m, r, static_cast<std::uint32_t>(beside_p)), add(m, static_cast<std::uint32_t>(beside_p), p);
    }
  }
  triangles_ = std::move(next);
  return true;
}

SurfaceTransfer Receivers::transfer() {
  look_from_vertices();
  do {
    look_from_long_edges();
  } while (cut());

  SurfaceTransfer all;
  all.midpoints = midpoints_;
  if (!midpoints_.empty()) all.triangles = triangles_;
  for (std::size_t side = 0; side < 2; ++side) {
    for (const Place& place : places_) {
      const HiddenSphere& hidden = place.sides[side];
      if (hidden.kind != 0) {
        all.record.push_back(hidden.kind);
        continue;
      }
      all.record.push_back(static_cast<std::uint32_t>(all.records.size() / SurfaceTransfer::record_floats));
      all.records.insert(all.records.end(), hidden.record.begin(), hidden.record.end());
    }
  }
  return all;
}

}  // namespace airlight
