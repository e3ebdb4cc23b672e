#include "common/reference/grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <utility>

namespace airlight {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int block_side = 8;

}  // namespace

GridField::GridField(const GridMedium& grid)
    : pieces_(grid.voxels->size + 1),
      blocks_((pieces_ + (block_side - 1)) / block_side),
      scale_(grid.scale),
      albedo_(grid.albedo) {
  // Piece 0 begins at the ring's centres, half a cell outside the box.
  const glm::dmat4 to_world = glm::translate(grid.transform, glm::dvec3(-0.5));
  to_pieces_ = glm::inverse(to_world);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 at(glm::ivec3(i & 1, i >> 1 & 1, i >> 2 & 1) * pieces_);
    corners_.emplace_back(to_world * glm::dvec4(at, 1));
  }

  const glm::ivec3 size = grid.voxels->size;
  row_ = static_cast<std::size_t>(size.x) + 2;
  slice_ = row_ * (static_cast<std::size_t>(size.y) + 2);
  values_.resize(slice_ * (static_cast<std::size_t>(size.z) + 2));
  auto from = grid.voxels->values.begin();
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y, from += size.x) {
      std::copy_n(from, size.x, values_.begin() + static_cast<std::ptrdiff_t>(index({1, y + 1, z + 1})));
    }
  }

  full_.resize(static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y) * static_cast<std::size_t>(blocks_.z));
  const auto mark = [&](const glm::ivec3& value) {  // a value belongs to the eight pieces around it
    for (int i = 0; i < 8; ++i) full_[block(value - glm::ivec3(i & 1, i >> 1 & 1, i >> 2 & 1))] = 1;
  };
  for (int z = 1; z <= size.z; ++z) {
    for (int y = 1; y <= size.y; ++y) {
      for (int x = 1; x <= size.x; ++x) {
        if (values_[index({x, y, z})] != 0) mark({x, y, z});
      }
    }
  }
}

std::size_t GridField::block(const glm::ivec3& piece) const {
  const glm::ivec3 b = piece / block_side;
  return static_cast<std::size_t>(b.x) +
         static_cast<std::size_t>(blocks_.x) *
             (static_cast<std::size_t>(b.y) + static_cast<std::size_t>(blocks_.y) * static_cast<std::size_t>(b.z));
}

GridField::Line GridField::line(const glm::dvec3& from, const glm::dvec3& unit_direction) const {
  return {glm::dvec3(to_pieces_ * glm::dvec4(from, 1)), glm::dmat3(to_pieces_) * unit_direction};
}

double GridField::extinction(const Line& l, const glm::ivec3& piece, double t) const {
  const glm::dvec3 f = l.o + t * l.d - glm::dvec3(piece);
  const float* const v = values_.data() + index(piece);
  const auto along = [](double a, double b, double w) { return a + w * (b - a); };
  const auto edge = [&](std::size_t i) { return along(static_cast<double>(v[i]), static_cast<double>(v[i + 1]), f.x); };
  const double value = along(along(edge(0), edge(row_), f.y), along(edge(slice_), edge(slice_ + row_), f.y), f.z);
  return scale_ * std::max(value, 0.0);  // rounding may put t a little outside the piece
}

double GridField::integral(const Line& l, const glm::ivec3& piece, double begin, double end) const {
  constexpr double node = 0.57735026918962576451;  // 1 / sqrt(3)
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  return half * (extinction(l, piece, middle - node * half) + extinction(l, piece, middle + node * half));
}

template <class Visit>
void GridField::walk(const Line& l, double length, Visit&& visit) const {
  // The part of the line within the box.
  const glm::dvec3 inverse(1 / l.d.x, 1 / l.d.y, 1 / l.d.z);
  double t = 0, last = length;
  for (int k = 0; k < 3; ++k) {
    if (l.d[k] == 0) {
      if (!(l.o[k] > 0 && l.o[k] < pieces_[k])) return;
      continue;
    }
    const double p = (0 - l.o[k]) * inverse[k], q = (pieces_[k] - l.o[k]) * inverse[k];
    t = std::max(t, std::min(p, q));
    last = std::min(last, std::max(p, q));
  }
  if (!(t < last)) return;

  glm::ivec3 piece(0);
  const auto place = [&](int k, int least, int most) {
    piece[k] = std::clamp(static_cast<int>(std::floor(l.o[k] + t * l.d[k])), least, most);
  };
  for (int k = 0; k < 3; ++k) place(k, 0, pieces_[k] - 1);
  for (;;) {
    // An empty block is left at once; in others every piece is.
    const bool skip = full_[block(piece)] == 0;
    const glm::ivec3 begin = skip ? piece / block_side * block_side : piece;
    const glm::ivec3 end = skip ? glm::min(begin + block_side, pieces_) : piece + 1;
    int axis = 0;
    double next = infinity;
    for (int k = 0; k < 3; ++k) {
      const double at = l.d[k] == 0 ? infinity : ((l.d[k] > 0 ? end[k] : begin[k]) - l.o[k]) * inverse[k];
      if (at < next) next = at, axis = k;
    }
    next = std::min(std::max(next, t), last);
    if (!skip && next > t && any(piece)) visit(piece, t, next);
    t = next;
    if (t >= last) return;
    for (int k = 0; skip && k < 3; ++k) place(k, begin[k], end[k] - 1);
    piece[axis] = l.d[axis] > 0 ? end[axis] : begin[axis] - 1;
    if (piece[axis] < 0 || piece[axis] >= pieces_[axis]) return;
  }
}

bool GridField::any(const glm::ivec3& piece) const {
  const float* const v = values_.data() + index(piece);
  const auto pair = [&](std::size_t i) { return v[i] != 0 || v[i + 1] != 0; };
  return pair(0) || pair(row_) || pair(slice_) || pair(slice_ + row_);
}

double GridField::depth(const glm::dvec3& from, const glm::dvec3& unit_direction, double length) const {
  const Line l = line(from, unit_direction);
  double sum = 0;
  walk(l, length, [&](const glm::ivec3& piece, double begin, double end) { sum += integral(l, piece, begin, end); });
  return sum;
}

GridOnLine::GridOnLine(const GridField& field, const glm::dvec3& from, const glm::dvec3& unit_direction, double length)
    : field_(field), line_(field.line(from, unit_direction)) {
  double sum = 0;
  field.walk(line_, length, [&](const glm::ivec3& piece, double begin, double end) {
    parts_.push_back({begin, end, sum, piece});
    sum += field.integral(line_, piece, begin, end);
  });
}

const GridOnLine::Part* GridOnLine::part_at(double t) const {
  const auto after = std::upper_bound(parts_.begin(), parts_.end(), t, [](double at, const Part& p) { return at < p.begin; });
  return after == parts_.begin() ? nullptr : &*std::prev(after);
}

double GridOnLine::depth(double t) const {
  const Part* const p = part_at(t);
  return p ? p->before + field_.integral(line_, p->piece, p->begin, std::min(t, p->end)) : 0;
}

double GridOnLine::extinction(double t) const {
  const Part* const p = part_at(t);
  return p && t <= p->end ? field_.extinction(line_, p->piece, t) : 0;
}

void GridOnLine::add_breaks(std::vector<double>& t) const {
  for (const Part& p : parts_) t.insert(t.end(), {p.begin, p.end});
}

}  // namespace airlight
