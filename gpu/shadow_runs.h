// Shadow planes on GL: the screen is taken in runs of tiles, so that planes and the lists of crossings fit its storage buffers.
#pragma once

#include <functional>
#include <vector>

#include "common/plan/shadow_quads.h"
#include "gpu/step_runner.h"

namespace airlight {

// A run whose lists hold everything.
struct ShadowRun {
  int light;
  Extent extent;  // of its rectangle
  int most_lit;   // lit parts that a ray has
};

// Dispatches a shader of gpu/shadow_lists.glsl for each light and run of tiles, again with longer lists until no list is too
// short; then calls `draw`, if there is one. The shader's view and distance image are bound, and stay. Throws MachineError where
// a single tile is more than the storage buffers hold.
void each_shadow_run(const View&, std::size_t lights, const Buffer& volumes, float sky_distance, StepRunner&, Program& lists,
                     const Progress&, const std::function<void(const ShadowRun&)>& draw);

// The same for a shader that takes lit parts (gpu/lit_rays.glsl): `draw` is to bind its buffers 0 to 4 but 3 again.
void each_lit_run(const View&, std::size_t lights, const Buffer& volumes, float sky_distance, StepRunner&, const Progress&,
                  const std::function<void(const ShadowRun&)>& draw);

// Runs such a shader for the pixels of the run.
void dispatch_run(StepRunner&, Program&, const ShadowRun&);

}  // namespace airlight
