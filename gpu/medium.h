// Gaussians and grid for the shaders that include gpu/medium.glsl.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "common/algorithms/depth_volume.h"
#include "common/algorithms/medium.h"
#include "gpu/step_runner.h"

namespace airlight {

// Binds them, and returns the defines under which the shader finds them.
std::vector<std::string> bind_medium(StepRunner&, const std::vector<GaussianDensity>&, const GridDensity&, const Buffer& voxels,
                                     int light_steps, LightDepth, Erf = Erf::accurate);
// With the volumes of LightDepth::volume or a source volume, for which `tables` (what else the shader reads as one, or absent),
// the sources and the depths of as many lights as there is room for are copied into one buffer: its first element stays the
// tables'. After bind_medium(), whose defines it adds to.
class DepthTables {
 public:
  DepthTables(StepRunner&, const Buffer& tables, const std::vector<Buffer>& depths, const std::vector<DepthVolume>&,
              std::vector<std::string>& defines, const Buffer& sources = {});

  // Makes them those of a light and of some after it, unless that is what they are. Throws MachineError where one does not fit.
  // Returns the end of the lights that the shader may ask for, of `lights` in all.
  int hold(Program&, int light, std::size_t lights);

 private:
  void make(int first);

  StepRunner& r_;
  Buffer tables_, sources_;
  const std::vector<Buffer>& depths_;
  const std::vector<DepthVolume>& volumes_;
  bool made_ = false;
  int first_ = 0, end_ = 0;                    // lights
  std::size_t sources_at_ = 0, heads_at_ = 0;  // [byte]
};

// Mesa's llvmpipe leaves all loops of a shader once it has gone round 65535 times, without a word: what a dispatch may ask of an
// invocation.
struct LoopBudget {
  static constexpr std::int64_t most = 50000;
  // Of loops over lit parts: it runs so many rays as one at most, and they go round where one of them does.
  static constexpr std::int64_t rays_at_once = 16;
  std::int64_t a_light;  // rounds for one step and one light
  int lights;            // how many lights fit, at least 1
  int parts;             // how many of a step's parts fit, at least 1

  // How many of a ray's lit parts a dispatch may take where half of its rounds are left for them, and each costs so many. Of one
  // part no loop goes round more often than without.
  static int lit_parts(std::int64_t rounds, int all) {
    return static_cast<int>(std::clamp<std::int64_t>(most / 2 / (rays_at_once * (rounds + 3)), 1, std::max(all, 1)));
  }
};
// Of `most` rounds; parts: into how many a light may cut a step. Throws MachineError where one light alone does not fit.
LoopBudget loop_budget(const std::vector<GaussianDensity>&, const GridDensity&, int light_steps, LightDepth, std::size_t lights,
                       std::int64_t most = LoopBudget::most, int parts = 1);

}  // namespace airlight
