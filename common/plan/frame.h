// What the plans of all techniques have in common: camera, lights and images, what each pixel sees, and the light that its
// surface sends. Between the two stands what a technique is about.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/algorithms/environment_airlight.h"
#include "common/algorithms/light_march.h"
#include "common/algorithms/shadow_planes.h"
#include "common/plan/brdf.h"
#include "common/plan/geometry.h"
#include "common/plan/hidden_environment.h"
#include "common/plan/lean_scene.h"
#include "common/plan/plan.h"
#include "common/scene/scene.h"

namespace airlight {

// `indirect`: unbounded | off | mean_density | psf, of FramePlan::shade().
Knob indirect_knob();
// `table_nodes`, of FramePlan::add_airlight_tables().
Knob table_nodes_knob();
// `environment_airlight`: on | published | off, of what the medium makes of an environment.
Knob environment_knob();
// `environment_shadows`: on | off, and `environment_rays`, of what surfaces hide of an environment from each other.
Knob environment_shadows_knob();
Knob environment_rays_knob();
// `environment_indirect`: off | on | published, of what of an environment the medium scatters onto surfaces.
Knob environment_indirect_knob();
// `environment_depth`: auto | pixel | lattice | object, `environment_cells` and `environment_blocks`, of the mean depths that
// attenuate it.
Knob environment_depth_knob();
Knob environment_cells_knob();
Knob environment_blocks_knob();
// `shadows`: on | off, of FramePlan::add_shadow_volumes().
Knob shadows_knob();

class FramePlan {
 public:
  // Begins the plan: its first step is SurfaceVisibility. Scene and request must outlive this object.
  FramePlan(const Scene& given, const FrameRequest&);

  // Handles of a technique's own images and buffers begin here.
  static constexpr std::uint32_t first_own_id = 64;

 private:
  LeanScene lean_;  // before `scene`, which it holds

 public:
  const Scene& scene;  // as given, but for Gaussians that change nothing: what a technique plans for
  const FrameRequest& request;
  View view;
  std::vector<std::size_t> light_index;  // position in the scene of each light below
  std::vector<Light> lights;             // without those of zero power
  float extinction = 0;                  // [1/m] of the homogeneous part
  float sky_distance = 0;                // [m], at most 1e30
  glm::vec3 ambient{0, 0, 0};            // [W/m^2/sr] source radiance; 0 without a medium
  Geometry geometry;
  SceneBrdfs brdfs;  // of the surfaces

  // A wanted image is kept, any other only handed on. The technique fills the second row.
  Image distance, normal, material;
  Image transmittance, optical_depth, airlight, per_light;  // optical_depth and per_light are absent unless wanted

  Plan plan;

  bool has_surfaces() const { return !scene.surfaces.empty(); }
  // What tells handles of the k-th of the lights from those of others: a light that goes out or away leaves these as they are.
  std::uint32_t slot_of(std::size_t k) const {
    return request.light_slots.empty() ? static_cast<std::uint32_t>(light_index[k]) : request.light_slots[light_index[k]];
  }
  // An image of this frame's extent that is only handed on.
  Image handed_on(std::uint32_t id, Format format, int layers) const { return {{id}, format, request.extent, layers, false}; }

  // The tables of HomogeneousAirlight. The technique has the knob table_nodes.
  Buffer add_airlight_tables();
  // The volumes of ShadowPlanes, under a handle of the technique's own; absent where the knob `shadows` is off or nothing throws
  // a shadow that can be seen, which the plan's skips tell.
  Buffer add_shadow_volumes(std::uint32_t id, ShadowOrder = ShadowOrder::exact);
  // Shades surfaces that are lit through Gaussians or a grid. `way`: what stands in the light's way and how it is taken; the rest
  // of its fields is filled in. Two handles of the technique's own, from `first_id` on.
  void shade_through(LightMarch way, Buffer volumes, std::uint32_t first_id);
  // Shades the surfaces, light scattered on its way to them included where the knob asks for it. light_transmittance as in
  // SurfaceShading, or absent. After the step that makes `transmittance`.
  void shade(Image light_transmittance);
  // For a technique that scatters the environment's light in Gaussians and grids itself: of the homogeneous part alone it is
  // added then. Before the step that makes `airlight`.
  void scatter_environment_in_fog_alone();
  // The step that adds the environment's airlight to `airlight`, for a technique that places it itself; else finish() does.
  // Absent where there is none. `airlight` is what it makes then.
  std::optional<EnvironmentAirlight> take_environment_airlight();
  // The step with all that those along the view ray have in common filled in.
  template <class Step>
  Step along_view_ray() const;
  // Ends the plan: composes the image from `surface` and `airlight`.
  Plan finish();

 private:
  void add_skips_of_the_scene();
  Image image(std::string_view name, Format);
  Image optional_image(std::string_view name, Format);
  Image per_light_image();
  Image add_indirect();
  glm::vec3 rest_albedo() const;
  bool rest_scatters() const;
  std::optional<std::string_view> lacks_environment_indirect() const;
  Image add_environment_indirect(Image scattered);
  Image mean_depth();
  Image add_environment();
  std::function<HiddenSizes()> hiding_sizes() const;
  void expect_environment_shadows();
  void add_environment_shadows();
  Buffer add_brdfs();
  void expect_environment_airlight();
  Image add_lit(Buffer volumes, std::uint32_t id);
  bool wanted(std::string_view name) const;

  std::uint32_t next_id_;
  std::shared_ptr<const Scene> hiding_;  // what transfer and hidden part are made of
  std::uint64_t transfer_key_ = 0;
  Image surface_, surface_direct_, surface_ambient_, beauty_;
  Image corners_, hidden_diffuse_, hidden_specular_;  // absent where surfaces hide nothing of an environment
  bool environment_in_fog_alone_ = false;
  Image depth_toward_light_;  // as LightMarch makes it, where what it stands for scatters onto surfaces; else absent
  Image mean_depth_;          // made once, for all that ask
  Image airlight_;            // with what the medium scatters of an environment; absent where that is nothing
};

template <class Step>
Step FramePlan::along_view_ray() const {
  Step s;
  s.distance = distance, s.lights = lights, s.view = view, s.phase = scene.medium.phase;
  s.extinction = extinction, s.sky_distance = sky_distance;
  s.albedo = scene.medium.albedo, s.ambient = ambient, s.emission = scene.medium.emission;
  s.airlight = airlight, s.per_light = per_light;
  if constexpr (requires { s.transmittance; }) s.transmittance = transmittance, s.optical_depth = optical_depth;
  return s;
}

}  // namespace airlight
