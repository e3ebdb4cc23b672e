#include "common/plan/lean_scene.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace airlight {

namespace {

bool same_place(const Gaussian& a, const Gaussian& b) { return a.center == b.center && a.radius == b.radius; }

std::uint64_t place_key(const Gaussian& g) {
  std::uint64_t key = 0;
  for (const double v : {g.center.x, g.center.y, g.center.z, g.radius})
    key = (key ^ std::bit_cast<std::uint64_t>(v + 0.0)) * 0x9e3779b97f4a7c15U, key ^= key >> 32U;
  return key;
}

// The place in a list of the first Gaussian like each that is asked for: a table of open addresses, as plans are made for each
// frame and most scenes have none that coincide.
class Places {
 public:
  explicit Places(const std::vector<Gaussian>& all) : all_(all), firsts_(std::bit_ceil(2 * all.size() + 1), none) {}

  // `i` itself where none before it is like it.
  std::size_t first_like(std::size_t i) {
    const std::size_t mask = firsts_.size() - 1;
    for (std::size_t at = place_key(all_[i]) & mask;; at = (at + 1) & mask) {
      if (firsts_[at] == none) return firsts_[at] = static_cast<std::uint32_t>(i);
      if (same_place(all_[firsts_[at]], all_[i])) return firsts_[at];
    }
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const std::vector<Gaussian>& all_;
  std::vector<std::uint32_t> firsts_;
};

void add(Gaussian& to, const Gaussian& from) {
  const double both = to.extinction + from.extinction;
  to.albedo = (to.extinction * to.albedo + from.extinction * from.albedo) / both;
  to.extinction = both;
  to.emission += from.emission;
}

}  // namespace

LeanScene lean_scene(const Scene& scene) {
  const std::vector<Gaussian>& all = scene.medium.gaussians;
  LeanScene lean;
  Places places(all);
  std::vector<std::uint32_t> first(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    first[i] = static_cast<std::uint32_t>(i);
    if (!(all[i].extinction > 0)) {
      ++lean.empty;
      continue;
    }
    first[i] = static_cast<std::uint32_t>(places.first_like(i));
    if (first[i] != i) ++lean.coincident;
  }
  if (lean.empty + lean.coincident == 0) {
    lean.scene = std::shared_ptr<const Scene>(std::shared_ptr<const Scene>(), &scene);
    return lean;
  }
  const auto made = std::make_shared<Scene>(scene);
  std::vector<Gaussian>& kept = made->medium.gaussians;
  kept.clear();
  std::vector<std::size_t> place(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!(all[i].extinction > 0)) continue;
    if (first[i] == i) {
      place[i] = kept.size();
      kept.push_back(all[i]);
    } else {
      add(kept[place[first[i]]], all[i]);
    }
  }
  lean.scene = made;
  return lean;
}

}  // namespace airlight
