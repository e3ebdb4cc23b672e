// Extinction of a voxel grid on lines, in double and exact but for rounding: between the planes through the cells' centres the
// trilinear field is a cubic polynomial along a line, which two nodes of Gauss integrate exactly.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

class GridOnLine;

// A grid with its ring of zeros. A piece is the cube between eight neighbouring centres; those without extinction are skipped.
class GridField {
 public:
  explicit GridField(const GridMedium&);

  // Optical depth from a point over `length` [m] (may be infinite) along a unit direction.
  double depth(const glm::dvec3& from, const glm::dvec3& unit_direction, double length) const;

  const glm::dvec3& albedo() const { return albedo_; }
  const glm::ivec3& pieces() const { return pieces_; }                 // along each axis
  const std::vector<glm::dvec3>& corners() const { return corners_; }  // the eight of the box outside of which it is 0 [m]

 private:
  friend class GridOnLine;

  // A line o + t d in units of pieces.
  struct Line {
    glm::dvec3 o, d;
  };
  Line line(const glm::dvec3& from, const glm::dvec3& unit_direction) const;
  // visit(piece, begin, end) for each piece that is not empty and that the line crosses within 0..length, in order.
  template <class Visit>
  void walk(const Line&, double length, Visit&&) const;
  double extinction(const Line&, const glm::ivec3& piece, double t) const;  // [1/m] at t, which is in the piece
  double integral(const Line&, const glm::ivec3& piece, double begin, double end) const;
  std::size_t index(const glm::ivec3& piece) const {
    return static_cast<std::size_t>(piece.x) + row_ * static_cast<std::size_t>(piece.y) +
           slice_ * static_cast<std::size_t>(piece.z);
  }
  bool any(const glm::ivec3& piece) const;  // whether it has extinction
  std::size_t block(const glm::ivec3& piece) const;

  glm::dmat4 to_pieces_{1.0};
  glm::ivec3 pieces_{0}, blocks_{0};
  std::size_t row_ = 0, slice_ = 0;
  std::vector<float> values_;       // pieces + 1 along each axis, the outermost 0
  std::vector<std::uint8_t> full_;  // whether a block of 8^3 pieces has extinction anywhere
  double scale_ = 1;
  glm::dvec3 albedo_{1};
  std::vector<glm::dvec3> corners_;
};

// The grid along a ray, for many questions about it.
class GridOnLine {
 public:
  // `field` must outlive this; unit direction; length [m], may be infinite.
  GridOnLine(const GridField& field, const glm::dvec3& from, const glm::dvec3& unit_direction, double length);

  bool empty() const { return parts_.empty(); }
  double begin() const { return parts_.front().begin; }  // [m] of what is not empty
  double end() const { return parts_.back().end; }
  double depth(double t) const;       // optical depth over 0..t
  double extinction(double t) const;  // [1/m] at t
  const glm::dvec3& albedo() const { return field_.albedo(); }
  void add_breaks(std::vector<double>&) const;  // where its polynomials begin and end

 private:
  struct Part {
    double begin, end;  // [m]
    double before;      // optical depth over 0..begin
    glm::ivec3 piece;
  };
  const Part* part_at(double t) const;  // the last that begins no later; null before the first

  const GridField& field_;
  GridField::Line line_;
  std::vector<Part> parts_;
};

}  // namespace airlight
