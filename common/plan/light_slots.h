// Which light of a scene is which of the frame before, so that what belongs to one keeps its handle where others come and go.
#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

// A slot is a number by which handles are told apart, one a light.
class LightSlots {
 public:
  // After a frame with these lights, in their order. A light is the one of the same name; else one that stands as it stood,
  // whatever its power; else the one that had its place in the list. Others have the least numbers that are free.
  LightSlots after(const std::vector<LightSource>&) const;

  // Of each light.
  std::vector<std::uint32_t> numbers() const;

 private:
  struct Known {
    LightSource light;
    std::uint32_t slot = 0;
  };
  std::vector<Known> known_;
};

}  // namespace airlight
