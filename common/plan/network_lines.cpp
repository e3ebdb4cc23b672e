// Bundles of lines of an illumination network: their directions, and the pixels of their windows.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/plan/network.h"
#include "common/random.h"

namespace airlight {

namespace {

// Even over the sphere (Marsaglia 1972): of a point in the unit disc, so that it takes no function of the C library but sqrt.
std::vector<glm::dvec3> random_directions(int count) {
  std::vector<glm::dvec3> directions;
  for (int l = 0; l < count; ++l) {
    Random random({0x6E657477, 0x6F726B73}, static_cast<std::uint64_t>(l));
    double x = 1, y = 1;
    while (x * x + y * y >= 1) x = 2 * random.next() - 1, y = 2 * random.next() - 1;
    const double squared = x * x + y * y, scale = 2 * std::sqrt(1 - squared);
    directions.emplace_back(scale * x, scale * y, 1 - 2 * squared);
  }
  return directions;
}

// Where particles are along an axis across a bundle: what of it pixels are to cover. Gaps that are wider than a pixel would be
// count as one, so that pixels of small clouds far apart are as small as those of one cloud.
class Occupied {
 public:
  void project(const std::vector<float>& particles, const std::int32_t* axis) {
    const std::size_t n = particles.size() / particle_planes;
    std::int32_t least = 1 << 30, most = -(1 << 30);
    places_.resize(n);
    for (std::size_t v = 0; v < n; ++v) {
      std::int32_t at = 0;
      for (std::size_t k = 0; k < 3; ++k) at += axis[k] * static_cast<std::int32_t>(particles[k * n + v]);
      places_[v] = at;
      least = std::min(least, at), most = std::max(most, at);
    }
    // Which units of the lattice any particle is in, first to last. Gaps too short for any pixel are left alone.
    begin_ = least, end_ = most + 1;
    std::vector<char> taken(static_cast<std::size_t>((most - least) / lattice_length) + 1, 0);
    for (const std::int32_t at : places_) taken[static_cast<std::size_t>((at - least) / lattice_length)] = 1;
    gaps_.clear();
    const std::size_t shortest = taken.size() / 1024;
    std::size_t after = 1;  // the last taken one
    for (std::size_t k = 1; k < taken.size(); ++k) {
      if (taken[k] == 0) continue;
      if (k > after + shortest)
        gaps_.push_back(
            {least + static_cast<std::int32_t>(after) * lattice_length, static_cast<std::int32_t>(k - after) * lattice_length});
      after = k + 1;
    }
  }

  // Of all `pixels`, where no gap counts more than one of them.
  double length(int pixels) const {
    const double all = static_cast<double>(end_) - begin_;
    double pixel = all / pixels;
    for (int k = 0; k < 8; ++k) pixel = (all - cut(pixel)) / pixels;
    return pixel * pixels;
  }

  // Edges of so many pixels.
  void divide(int pixels, std::int32_t* edges) const {
    const double pixel = length(pixels) / pixels;
    edges[0] = begin_;
    double cut_off = 0;
    std::size_t gap = 0;
    for (int i = 1; i < pixels; ++i) {
      const double covered = i * pixel;  // without what is cut off
      while (gap < gaps_.size() && gaps_[gap].begin + pixel - begin_ - cut_off <= covered) {
        cut_off += std::max(gaps_[gap].length - pixel, 0.0);
        ++gap;
      }
      edges[i] = std::max(edges[i - 1] + 1, static_cast<std::int32_t>(std::floor(begin_ + covered + cut_off + 0.5)));
    }
    edges[pixels] = std::max(edges[pixels - 1] + 1, end_);
  }

 private:
  struct Gap {
    std::int32_t begin, length;
  };
  double cut(double pixel) const {
    double sum = 0;
    for (const Gap& gap : gaps_) sum += std::max(gap.length - pixel, 0.0);
    return sum;
  }

  std::vector<std::int32_t> places_;
  std::vector<Gap> gaps_;
  std::int32_t begin_ = 0, end_ = 1;
};

// A vector of the lattice.
glm::ivec3 rounded(const glm::dvec3& v) { return glm::ivec3(glm::floor(v * static_cast<double>(lattice_length) + 0.5)); }

}  // namespace

std::vector<glm::dvec3> network_directions(int count, DirectionSet set) {
  if (set == DirectionSet::random) return random_directions(count);
  // Cosine and sine of the golden angle: turned on by it, without a cosine that the C library could round differently.
  constexpr double turn_c = -0.7373688780783197, turn_s = 0.6754902942615238;
  std::vector<glm::dvec3> directions;
  double c = 1, s = 0;
  for (int l = 0; l < count; ++l) {
    const double z = 1 - (l + 0.5) / count, r = std::sqrt(1 - z * z);
    directions.emplace_back(r * c, r * s, z);
    const double next_c = c * turn_c - s * turn_s;
    s = s * turn_c + c * turn_s;
    c = next_c;
  }
  return directions;
}

std::vector<std::int32_t> network_lines(const std::vector<float>& particles, int count, int window, DirectionSet set) {
  const std::size_t n = particles.size() / particle_planes;
  const NetworkShape shape{n, static_cast<std::size_t>(count),
                           static_cast<std::size_t>(window) * static_cast<std::size_t>(window)};
  std::vector<std::int32_t> lines(shape.line_integers(), 0);
  const std::vector<glm::dvec3> directions = network_directions(count, set);
  Occupied occupied[2];
  for (std::size_t l = 0; l < shape.lines; ++l) {
    const glm::dvec3& direction = directions[l];
    const glm::dvec3 up = std::fabs(direction.y) < 0.95 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(up, direction)), down = glm::cross(direction, across);
    std::int32_t* line = lines.data() + line_fields * l;
    const glm::ivec3 axes[3] = {rounded(direction), rounded(across), rounded(down)};
    for (int k = 0; k < 9; ++k) line[line_direction + k] = axes[k / 3][k % 3];
    for (int which = 0; which < 2; ++which) occupied[which].project(particles, line + (which == 0 ? line_across : line_down));
    // Pixels as square as may be.
    const int slots = window * window;
    int columns = window;
    for (int k = 0; k < 3; ++k) {
      const double wide = occupied[0].length(columns), high = occupied[1].length(std::max(slots / columns, 1));
      columns = std::clamp(static_cast<int>(std::floor(window * std::sqrt(wide / high) + 0.5)), 1, slots);
    }
    line[line_pixels] = columns, line[line_pixels + 1] = std::max(slots / columns, 1);
    std::int32_t* edges = lines.data() + shape.edges(l);
    occupied[0].divide(columns, edges);
    occupied[1].divide(line[line_pixels + 1], edges + columns + 1);
  }
  return lines;
}

}  // namespace airlight
