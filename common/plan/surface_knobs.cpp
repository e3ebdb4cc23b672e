#include "common/plan/surface_knobs.h"

#include "common/plan/sampled_airlight.h"

namespace airlight {

std::vector<Knob> with_surface_knobs(std::vector<Knob> own, const Knob& environment) {
  const Knob shared[] = {shadows_knob(),
                         airlight_resolution_knob(),
                         indirect_knob(),
                         environment,
                         environment_indirect_knob(),
                         environment_shadows_knob(),
                         environment_rays_knob(),
                         environment_depth_knob(),
                         environment_cells_knob(),
                         environment_blocks_knob()};
  own.insert(own.end(), std::begin(shared), std::end(shared));
  return own;
}

}  // namespace airlight
