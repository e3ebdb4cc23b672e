// What the steps of an illumination network share: where particles and lines stand in their buffers.
#pragma once

#include <cstddef>

namespace airlight {

// Particles stand on a lattice about the medium's middle, so that which of them a line meets, and in what order, is integer
// arithmetic on every machine: coordinates are -lattice_side..lattice_side times `unit` of the step. A plane of floats each:
// three coordinates, albedo, emission over extinction [W/m^2/sr] (rgb), extinction [1/m], mass beside the mean of all.
// Mass is extinction integrated over the space that a particle stands for.
constexpr int lattice_side = 8191;
constexpr int lattice_length = 8192;  // of the vectors of a line
enum ParticlePlane : int {
  particle_place = 0,
  particle_albedo = 3,
  particle_glow = 6,
  particle_extinction = 9,
  particle_mass = 10,
  particle_planes = 11
};

// A bundle of parallel lines, each of which light takes both ways: int32[12]. Direction, and two vectors across it; how many
// pixels its window has across and down. Behind all bundles the edges of the pixels of each, in lattice units times
// lattice_length: those across, one more than there are, then those down.
enum LineField : int { line_direction = 0, line_across = 3, line_down = 6, line_pixels = 9, line_fields = 12 };

// Links, a line after another. First, for all lines, where the list of each pixel begins, counted in particles, slots + 1 numbers
// a line; then for each line five planes of particles + slots records. Pixel c's list of n particles has n + 1 records from
// begin[c] + c on: a particle, and the link before it along the line; the last one is the link behind all.
enum LinkPlane : int { link_particle = 0, link_depth, link_lost, link_given, link_kept, link_planes };

struct NetworkShape {
  std::size_t particles = 0, lines = 0;
  std::size_t slots = 0;  // pixels of a line's window at most

  // Where a line's edges begin among the integers of all lines, and how many of these there are.
  std::size_t edges(std::size_t line) const { return line_fields * lines + (slots + 3) * line; }
  std::size_t line_integers() const { return edges(lines); }
  std::size_t begins() const { return lines * (slots + 1); }
  std::size_t records() const { return particles + slots; }
  std::size_t record(std::size_t line, int plane) const {
    return begins() + (line * link_planes + static_cast<std::size_t>(plane)) * records();
  }
  std::size_t links() const { return record(lines, 0); }
};

}  // namespace airlight
