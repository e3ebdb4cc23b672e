// What one would write without this project: marching through homogeneous fog with a shadow ray from each sample to each light,
// by Embree in packets. A baseline of the benchmarks.
#pragma once

#include <memory>

#include "common/image.h"
#include "common/scene/scene.h"

namespace airlight {

class BruteForce {
 public:
  // Builds Embree's trees. The scene must be homogeneous; it must outlive this object. `threads` > 0.
  BruteForce(const Scene&, int threads);
  ~BruteForce();

  // `beauty`: single scattering in `steps` equal steps (midpoints) of each ray, direct light on surfaces, ambient light; no
  // indirect light. A ray without an end is as long as the fog lets it be seen: optical depth 12 beyond the farthest lamp.
  HostImage render(Extent, int steps) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
