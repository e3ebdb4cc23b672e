#pragma once

#include <vector>

#include "common/algorithms/depth_volume.h"
#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

// How much of each light comes through Gaussians and grid to the surface that each pixel shows; 1 where it shows none. The
// homogeneous part is SurfaceShading's.
struct LightMarch {
  Image distance;              // r32f [m], 1e30 on a miss
  Image lit;                   // as ShadowPlanes::light_transmittance, a factor; optional
  Buffer voxels;               // as RayMarch's
  std::vector<Buffer> depths;  // one a light, as OpticalDepthPropagation's; with LightDepth::volume
  std::vector<Light> lights;
  std::vector<DepthVolume> depth_volumes;  // where they stand, seen from the camera
  std::vector<GaussianDensity> gaussians;
  GridDensity grid;
  View view;
  int light_steps = 16;  // > 0
  LightDepth light_depth = LightDepth::march;
  Erf erf = Erf::accurate;  // of LightDepth::analytic

  Image light_transmittance;  // r32f, a layer a light, 0..1
  Image depth_toward_light;   // r32f, a layer a light: the depth that this comes of, 0 where nothing is hit; optional

  static constexpr std::string_view name = "light_march";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("lit"), s.lit);
    v(in("voxels", "1/m"), s.voxels);
    v(in("depths"), s.depths);
    v(knob("lights"), s.lights);
    v(knob("depth_volumes"), s.depth_volumes);
    v(knob("gaussians"), s.gaussians);
    v(knob("grid"), s.grid);
    v(knob("view"), s.view);
    v(knob("light_steps"), s.light_steps);
    v(knob("light_depth"), s.light_depth);
    v(knob("erf"), s.erf);
    v(out("light_transmittance"), s.light_transmittance);
    v(out("depth_toward_light"), s.depth_toward_light);
  }
};

}  // namespace airlight
