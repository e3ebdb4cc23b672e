#include "common/techniques/gaussian_airlight.h"
#include "common/techniques/marching.h"
#include "common/techniques/opacity_propagation.h"
#include "common/techniques/shadow_planes.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

using Set = std::vector<std::pair<std::string, std::string>>;

Case frame(const Scene& scene, Extent extent, const Technique& technique = shadow_planes(), const Set& set = {}) {
  FrameRequest request;
  request.extent = extent;
  request.images = {"beauty", "surface", "airlight", "depth"};
  request.knobs = KnobValues(technique.knobs, set);
  const Plan plan = technique.plan(scene, request);
  Case c;
  for (const Plan::Upload& upload : plan.uploads) c.buffers.emplace_back(upload.buffer, upload.make());
  c.steps = plan.steps;
  for (const Plan::Output& output : plan.outputs) c.results.emplace_back(output.name, output.image);
  return c;
}

Case torus_in_fog(Extent e) { return frame(test_scene(20000), e); }
Case torus_in_clear_air(Extent e) {
  Scene scene = test_scene(20000);
  scene.medium.extinction = 0;
  return frame(scene, e);
}
Case empty_fog(Extent e) {
  Scene scene = test_scene(600);
  scene.surfaces.clear();
  return frame(scene, e);
}

// Gaussians around the torus, which throws its shadow through them.
Scene torus_among_gaussians() {
  Scene scene = test_scene(2000);
  scene.medium.extinction = 0.03;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const glm::dvec3 center(2 * uniform(71, 4 * i) - 1, uniform(71, 4 * i + 1), 2 * uniform(71, 4 * i + 2) - 1);
    scene.medium.gaussians.push_back({.center = center, .radius = 0.4 + 0.5 * uniform(71, 4 * i + 3), .extinction = 0.8});
  }
  return scene;
}
Case shadows_in_gaussians(Extent e) { return frame(torus_among_gaussians(), e, gaussian_airlight(), {{"samples", "3"}}); }
Case looked_up_lights(Extent e) {
  return frame(torus_among_gaussians(), e, gaussian_airlight(),
               {{"samples", "2"}, {"light_path", "volume"}, {"light_cells", "1"}});
}
Case propagated(Extent e, const char* density, const char* scheme, const char* storage = "float") {
  const Set set{{"resolution", "12"}, {"steps", "6"}, {"density", density}, {"scheme", scheme}, {"storage", storage}};
  return frame(torus_among_gaussians(), e, opacity_propagation(), set);
}
Case sampled(Extent e, const Technique& technique, const char* resolution, Set set) {
  set.emplace_back("airlight_resolution", resolution);
  return frame(torus_among_gaussians(), e, technique, set);
}
Case marched_shadows(Extent e) { return frame(torus_among_gaussians(), e, marching(), {{"steps", "6"}}); }

}  // namespace

std::span<const NamedCase> frame_cases() {
  static constexpr NamedCase cases[] = {
      {"frame/torus_in_fog", torus_in_fog},
      {"frame/torus_in_clear_air", torus_in_clear_air},
      {"frame/empty_fog", empty_fog},
      {"frame/shadows_in_gaussians", shadows_in_gaussians},
      {"frame/looked_up_lights", looked_up_lights},
      {"frame/marched_shadows", marched_shadows},
      {"frame/half_airlight",
       [](Extent e) {
         return sampled(e, gaussian_airlight(), "half", {{"samples", "2"}});
       }},
      {"frame/quarter_of_a_march",
       [](Extent e) {
         return sampled(e, marching(), "quarter", {{"steps", "6"}, {"shadows", "off"}});
       }},
      {"frame/propagated", [](Extent e) { return propagated(e, "exact", "rays"); }},
      {"frame/propagated_in_halves", [](Extent e) { return propagated(e, "volume", "rays", "half"); }},
      {"frame/propagated_in_cells", [](Extent e) { return propagated(e, "volume", "upwind"); }}};
  return cases;
}

}  // namespace airlight
