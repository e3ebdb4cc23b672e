#pragma once

#include <vector>

#include "common/algorithms/depth_volume.h"
#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

// Single scattering along each pixel's ray in a sum of Gaussians and a homogeneous part, after Zhou et al. 2007. Optical depths
// of Gaussians are closed forms (their eq. 31), on the view ray and on the way to each light, where they may be looked up in a
// volume instead; what is left is integrated over panels (common/plan/gaussian_panels.h) with `samples` Gauss-Legendre nodes
// each. Where only the homogeneous part is and nothing shades it, the closed form of HomogeneousAirlight is taken. With shadow
// volumes, each light is integrated over the parts of the ray that it reaches, cut where the ray crosses a plane.
struct GaussianAirlight {
  Image distance;              // r32f [m], 1e30 on a miss
  Buffer tables;               // as in HomogeneousAirlight; needed by point lights where extinction > 0
  Buffer volumes;              // as ShadowPlanes'; optional: without, nothing throws a shadow
  std::vector<Buffer> depths;  // one a light, as OpticalDepthPropagation's; none: closed forms
  std::vector<Light> lights;
  std::vector<DepthVolume> depth_volumes;  // where they stand, seen from the camera
  std::vector<GaussianDensity> gaussians;
  View view;
  Phase phase;
  float extinction = 0;         // [1/m] of the homogeneous part
  float sky_distance = 1e30F;   // [m]; 1e30 and above stand for infinity
  glm::vec3 albedo{1, 1, 1};    // of the homogeneous part, 0..1
  glm::vec3 ambient{0, 0, 0};   // [W/m^2/sr] source radiance L_a
  glm::vec3 emission{0, 0, 0};  // [W/m^3/sr] of the homogeneous part
  int samples = 4;              // 1..most_samples
  Erf erf = Erf::accurate;
  RayNoise noise = {};  // with any, each Gaussian's reach is widened by what its rays may be bent by (common/plan/ray_noise.h)

  static constexpr int most_samples = 16;

  Image airlight;       // rgb32f
  Image per_light;      // rgb32f, a layer a light, without ambient and emission; optional
  Image transmittance;  // r32f, 0..1
  Image optical_depth;  // r32f, optional; 1e30 where it is infinite

  static constexpr std::string_view name = "gaussian_airlight";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("tables"), s.tables);
    v(in("volumes"), s.volumes);
    v(in("depths"), s.depths);
    v(knob("lights"), s.lights);
    v(knob("depth_volumes"), s.depth_volumes);
    v(knob("gaussians"), s.gaussians);
    v(knob("view"), s.view);
    v(knob("phase"), s.phase);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("sky_distance", "m"), s.sky_distance);
    v(knob("albedo"), s.albedo);
    v(knob("ambient", "W/m^2/sr"), s.ambient);
    v(knob("emission", "W/m^3/sr"), s.emission);
    v(knob("samples"), s.samples);
    v(knob("erf"), s.erf);
    v(knob("noise"), s.noise);
    v(out("airlight", "W/m^2/sr"), s.airlight);
    v(out("per_light", "W/m^2/sr"), s.per_light);
    v(out("transmittance"), s.transmittance);
    v(out("optical_depth"), s.optical_depth);
  }
};

}  // namespace airlight
