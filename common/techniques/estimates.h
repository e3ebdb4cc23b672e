// What each technique's frame is expected to be like: a few formulas with numbers fitted to the sweeps of docs/RESULTS.md, on the
// safe side in the error, rough in time. A technique whose errors change needs its numbers looked at.
#pragma once

#include "common/techniques/technique.h"

namespace airlight {

Estimate estimate_shadow_planes(const Scene&, Extent, const KnobValues&, int threads);
Estimate estimate_marching(const Scene&, Extent, const KnobValues&, int threads);
Estimate estimate_gaussian_airlight(const Scene&, Extent, const KnobValues&, int threads);
Estimate estimate_opacity_propagation(const Scene&, Extent, const KnobValues&, int threads);
Estimate estimate_illumination_network(const Scene&, Extent, const KnobValues&, int threads);

}  // namespace airlight
