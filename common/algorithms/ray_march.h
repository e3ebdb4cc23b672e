#pragma once

#include <vector>

#include "common/algorithms/depth_volume.h"
#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

// Marches each pixel's ray through the medium from front to back: transmittance, light scattered once, ambient and emitted light.
// With shadow volumes, of each step and light only the parts count that the light reaches, cut where the ray crosses a plane.
// Each stretch in front of where the ray enters Gaussians and grid, inside and behind takes `steps`; one that is empty costs nothing.
// They grow with 1 + the optical depth that there would be were it everywhere as dense as where the stretch begins (graded_step()).
struct RayMarch {
  Image distance;              // r32f [m], 1e30 on a miss
  Buffer voxels;               // extinctions of the grid (common/algorithms/voxel_table.h); with a grid
  Buffer volumes;              // as ShadowPlanes'; optional: without, nothing throws a shadow
  std::vector<Buffer> depths;  // one a light, as OpticalDepthPropagation's; with LightDepth::volume
  Buffer sources;  // as SourceFunction's; optional: what there is besides for Gaussians and grid to scatter toward the camera
  std::vector<Light> lights;
  std::vector<DepthVolume> depth_volumes;  // where they stand, seen from the camera
  std::vector<GaussianDensity> gaussians;
  GridDensity grid;
  View view;
  Phase phase;
  float extinction = 0;         // [1/m] of the homogeneous part
  float sky_distance = 1e30F;   // [m]; 1e30 and above stand for infinity
  glm::vec3 albedo{1, 1, 1};    // of the homogeneous part, 0..1
  glm::vec3 ambient{0, 0, 0};   // [W/m^2/sr] source radiance L_a
  glm::vec3 emission{0, 0, 0};  // [W/m^3/sr] of the homogeneous part
  int steps = 64;               // > 0
  int light_steps = 16;         // > 0, of each sample's way to each light
  LightDepth light_depth = LightDepth::march;
  glm::vec3 source_first{0, 0, 0};    // [m] where the first node of `sources` is
  glm::vec3 source_spacing{1, 1, 1};  // [m]

  Image airlight;       // rgb32f
  Image per_light;      // rgb32f, a layer a light, without ambient and emission; optional
  Image transmittance;  // r32f, 0..1
  Image optical_depth;  // r32f, optional; 1e30 where it is infinite

  static constexpr std::string_view name = "ray_march";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("voxels", "1/m"), s.voxels);
    v(in("volumes"), s.volumes);
    v(in("depths"), s.depths);
    v(in("sources", "W/m^2/sr"), s.sources);
    v(knob("lights"), s.lights);
    v(knob("depth_volumes"), s.depth_volumes);
    v(knob("gaussians"), s.gaussians);
    v(knob("grid"), s.grid);
    v(knob("view"), s.view);
    v(knob("phase"), s.phase);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("sky_distance", "m"), s.sky_distance);
    v(knob("albedo"), s.albedo);
    v(knob("ambient", "W/m^2/sr"), s.ambient);
    v(knob("emission", "W/m^3/sr"), s.emission);
    v(knob("steps"), s.steps);
    v(knob("light_steps"), s.light_steps);
    v(knob("light_depth"), s.light_depth);
    v(knob("source_first", "m"), s.source_first);
    v(knob("source_spacing", "m"), s.source_spacing);
    v(out("airlight", "W/m^2/sr"), s.airlight);
    v(out("per_light", "W/m^2/sr"), s.per_light);
    v(out("transmittance"), s.transmittance);
    v(out("optical_depth"), s.optical_depth);
  }
};

}  // namespace airlight
