#include "common/plan/light_slots.h"

#include <algorithm>
#include <optional>

namespace airlight {

namespace {

// All that optical depths toward it depend on.
bool stands_as(const LightSource& a, const LightSource& b) {
  if (a.type != b.type || a.radius != b.radius) return false;
  return a.type == LightType::directional ? a.direction == b.direction : a.position == b.position;
}

}  // namespace

LightSlots LightSlots::after(const std::vector<LightSource>& lights) const {
  std::vector<std::optional<std::uint32_t>> slots(lights.size());
  std::vector<bool> taken(known_.size(), false);
  const auto match = [&](std::size_t light, std::size_t before) {
    slots[light] = known_[before].slot;
    taken[before] = true;
  };
  // Of those that are left on both sides, each the first that fits; most stand where they stood in the list.
  const auto match_all = [&](auto&& fits) {
    for (std::size_t i = 0; i < std::min(lights.size(), known_.size()); ++i) {
      if (!slots[i] && !taken[i] && fits(lights[i], known_[i].light)) match(i, i);
    }
    for (std::size_t i = 0; i < lights.size(); ++i) {
      for (std::size_t k = 0; k < known_.size() && !slots[i]; ++k) {
        if (!taken[k] && fits(lights[i], known_[k].light)) match(i, k);
      }
    }
  };
  match_all([](const LightSource& a, const LightSource& b) { return !a.name.empty() && a.name == b.name; });
  match_all(stands_as);
  for (std::size_t i = 0; i < std::min(lights.size(), known_.size()); ++i) {
    if (!slots[i] && !taken[i]) match(i, i);
  }
  std::uint32_t next = 0;
  const auto is_used = [&](std::uint32_t slot) { return std::find(slots.begin(), slots.end(), slot) != slots.end(); };
  LightSlots all;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    while (!slots[i] && is_used(next)) ++next;
    if (!slots[i]) slots[i] = next;
    all.known_.push_back({lights[i], *slots[i]});
  }
  return all;
}

std::vector<std::uint32_t> LightSlots::numbers() const {
  std::vector<std::uint32_t> all;
  for (const Known& k : known_) all.push_back(k.slot);
  return all;
}

}  // namespace airlight
