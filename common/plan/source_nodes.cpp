#include "common/plan/source_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "common/plan/depth_volumes.h"
#include "common/plan/geometry.h"

namespace airlight {

namespace {

constexpr int brick_cells = 4;             // along an edge: of larger bricks, more nodes are where nothing is
constexpr double most_bricks = 1U << 21U;  // with nodes or without
// What stays outside of the box is as at its sides, and loses a hundredth of a beam at most: cells are finer than with all of the
// medium. Outside of bricks is nothing.
constexpr double lost_beside_box = 0.01, lost_beside_bricks = 1e-3;

// A Gaussian as far as it matters, on the lattice.
struct Ball {
  glm::dvec3 center;
  double radius;
};

std::vector<Ball> balls_of(const Scene& scene, const NetworkFrame& frame) {
  std::vector<Ball> balls;
  for (const Gaussian& g : scene.medium.gaussians) {
    if (!(g.extinction > 0)) continue;
    const auto reach = static_cast<double>(gaussian_reach(g, lost_beside_bricks));
    balls.push_back({(g.center - frame.middle) / frame.unit, reach / frame.unit});
  }
  return balls;
}

// [m] Half of the mass is in Gaussians that are wider, or as wide.
double middle_radius(const std::vector<Gaussian>& gaussians) {
  struct Width {
    double radius, mass;
  };
  std::vector<Width> widths;
  double all = 0;
  for (const Gaussian& g : gaussians) {
    widths.push_back({g.radius, g.extinction * g.radius * g.radius * g.radius});
    all += widths.back().mass;
  }
  std::sort(widths.begin(), widths.end(), [](const Width& a, const Width& b) { return a.radius < b.radius; });
  double narrow = 0;
  for (const Width& w : widths) {
    narrow += w.mass;
    if (narrow > 0.5 * all) return w.radius;
  }
  return widths.empty() ? 0 : widths.back().radius;
}

// Numbers in ascending order, each once; as many as `most`.
class Numbers {
 public:
  explicit Numbers(std::size_t most) : most_(most) {}
  bool add(std::int32_t number) {
    numbers_.push_back(number);
    return numbers_.size() < 2 * most_ + 64 || fits();
  }
  bool fits() {
    std::sort(numbers_.begin(), numbers_.end());
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
    return numbers_.size() <= most_;
  }
  const std::vector<std::int32_t>& all() const { return numbers_; }

 private:
  std::size_t most_;
  std::vector<std::int32_t> numbers_;
};

// Absent where there would be more bricks.
std::optional<SourceNodes> laid(const std::vector<Ball>& balls, int stride, std::size_t most_filled) {
  const double edge = static_cast<double>(stride) * brick_cells;
  glm::dvec3 least(1e300), most(-1e300);
  for (const Ball& ball : balls)
    least = glm::min(least, ball.center - ball.radius), most = glm::max(most, ball.center + ball.radius);
  least = glm::floor(least);
  const glm::dvec3 count = glm::max(glm::ceil((most - least) / edge), 1.0);
  if (count.x * count.y * count.z > most_bricks) return std::nullopt;
  SourceNodes made;
  made.first = least, made.stride = stride;
  made.nodes = glm::ivec3(brick_cells + 1), made.bricks = count;
  Numbers filled(most_filled);
  for (const Ball& ball : balls) {
    const glm::dvec3 center = (ball.center - least) / edge;
    const double radius = ball.radius / edge;
    const glm::ivec3 begin = glm::clamp(glm::floor(center - radius), glm::dvec3(0), count - 1.0),
                     last = glm::clamp(glm::floor(center + radius), glm::dvec3(0), count - 1.0);
    for (int k = begin.z; k <= last.z; ++k) {
      for (int j = begin.y; j <= last.y; ++j) {
        for (int i = begin.x; i <= last.x; ++i) {
          const glm::dvec3 brick(i, j, k), away = center - glm::clamp(center, brick, brick + 1.0);
          if (away.x * away.x + away.y * away.y + away.z * away.z > radius * radius) continue;
          if (!filled.add(i + made.bricks.x * (j + made.bricks.y * k))) return std::nullopt;
        }
      }
    }
  }
  if (!filled.fits()) return std::nullopt;
  made.filled = filled.all();
  return made;
}

std::int64_t nodes_of(const glm::ivec3& cells) { return std::int64_t{cells.x + 1} * (cells.y + 1) * (cells.z + 1); }

// One box; of cells smaller than asked for where most of the medium is narrower, as long as there are no more than `most` nodes.
MediumBox box_of(const Scene& scene, double radius, int resolution, std::int64_t most) {
  MediumBox box = medium_box(scene, resolution, lost_beside_box);
  if (scene.medium.grid || radius >= box.cell) return box;
  for (int finer = resolution; radius < 2 * box.cell;) {
    finer += (finer + 7) / 8;
    const MediumBox next = medium_box(scene, finer, lost_beside_box);
    if (nodes_of(next.cells) > most) break;
    box = next;
  }
  return box;
}

}  // namespace

SourceNodes source_nodes(const Scene& scene, const NetworkFrame& frame, int resolution) {
  const double radius = middle_radius(scene.medium.gaussians);
  const std::int64_t most_nodes = nodes_of(glm::ivec3(resolution));
  const MediumBox box = box_of(scene, radius, resolution, most_nodes);
  SourceNodes made;
  made.first = glm::floor((box.corner - frame.middle) / frame.unit);
  made.stride = static_cast<int>(std::ceil(box.cell / frame.unit));
  made.nodes = box.cells + 1;
  if (scene.medium.grid) return made;
  // From an eighth of a radius on, as a cloud of that size alone has them by default. Nodes side by side are in both bricks:
  // cells that are not much finer are not worth that.
  const auto most = static_cast<std::size_t>(most_nodes / nodes_of(glm::ivec3(brick_cells)));
  const int finest = std::max(static_cast<int>(std::min(radius / 8, box.cell) / frame.unit), 1);
  const auto finer = [&, than = made.stride](int stride) { return 3 * stride <= 2 * than; };
  const std::vector<Ball> balls = finer(finest) ? balls_of(scene, frame) : std::vector<Ball>();
  for (int stride = finest; finer(stride); stride += (stride + 7) / 8) {
    if (std::optional<SourceNodes> bricks = laid(balls, stride, most)) {
      made = std::move(*bricks);
      break;
    }
  }
  made.too_coarse = radius < made.stride * frame.unit;
  return made;
}

}  // namespace airlight
