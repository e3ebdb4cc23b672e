// All algorithms. A backend visits the variant, so one that forgets an algorithm does not compile.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "common/algorithms/compose.h"
#include "common/algorithms/density_injection.h"
#include "common/algorithms/depth_aware_upsample.h"
#include "common/algorithms/environment_airlight.h"
#include "common/algorithms/environment_indirect.h"
#include "common/algorithms/environment_light.h"
#include "common/algorithms/fill_airlight.h"
#include "common/algorithms/gaussian_airlight.h"
#include "common/algorithms/hidden_environment.h"
#include "common/algorithms/homogeneous_airlight.h"
#include "common/algorithms/light_march.h"
#include "common/algorithms/mean_depth.h"
#include "common/algorithms/mean_depth_lattice.h"
#include "common/algorithms/network_iteration.h"
#include "common/algorithms/optical_depth_propagation.h"
#include "common/algorithms/particle_light.h"
#include "common/algorithms/particle_splats.h"
#include "common/algorithms/projected_gaussians.h"
#include "common/algorithms/ray_march.h"
#include "common/algorithms/shadow_planes.h"
#include "common/algorithms/source_function.h"
#include "common/algorithms/subsample.h"
#include "common/algorithms/surface_airlight.h"
#include "common/algorithms/surface_shading.h"
#include "common/algorithms/surface_visibility.h"
#include "common/algorithms/view_transmittance.h"
#include "common/algorithms/visibility_network.h"

namespace airlight {

using Algorithm = std::variant<SurfaceVisibility, ShadowPlanes, ViewTransmittance, SurfaceAirlight, MeanDepthLattice, MeanDepth,
                               EnvironmentLight, SurfaceShading, HomogeneousAirlight, DensityInjection, OpticalDepthPropagation,
                               VisibilityNetwork, ParticleLight, NetworkIteration, SourceFunction, RayMarch, ParticleSplats,
                               GaussianAirlight, ProjectedGaussians, LightMarch, Subsample, DepthAwareUpsample, FillAirlight,
                               EnvironmentAirlight, EnvironmentIndirect, HiddenEnvironment, Compose>;

struct Step {
  Algorithm what;
  std::string_view why;  // one phrase for --explain
};

std::string_view name_of(const Algorithm&);
Domain domain_of(const Algorithm&);
// Those that are present, in order of the fields.
std::vector<Handle> inputs_of(const Algorithm&);
std::vector<Image> outputs_of(const Algorithm&);
std::vector<Buffer> buffers_made_by(const Algorithm&);

}  // namespace airlight
