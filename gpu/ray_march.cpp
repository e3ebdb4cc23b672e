#include <algorithm>
#include <glm/vec4.hpp>

#include "gpu/medium.h"
#include "gpu/shadow_runs.h"

namespace airlight {

void run(const RayMarch& a, StepRunner& r, const Progress& progress) {
  std::vector<std::string> defines = bind_medium(r, a.gaussians, a.grid, a.voxels, a.light_steps, a.light_depth);
  DepthTables depths(r, a.voxels, a.depths, a.depth_volumes, defines, a.sources);
  defines.push_back(r.lights(a.lights));
  if (a.per_light) defines.push_back("WITH_PER_LIGHT");
  if (a.optical_depth) defines.push_back("WITH_OPTICAL_DEPTH");
  const bool shadowed = a.volumes && !a.lights.empty();
  if (shadowed) defines.push_back("WITH_LIT");
  Program& program = r.compute("gpu/ray_march.glsl", defines);
  program.set("source_first", a.source_first);
  program.set("source_scale", 1.0F / a.source_spacing);
  r.read(0, a.distance);
  r.read_write(0, a.airlight);
  r.read_write(1, a.per_light);
  r.read_write(2, a.transmittance);
  r.write(3, a.optical_depth);
  r.view(a.view);
  struct {
    glm::vec4 albedo_extinction, ambient_sky_distance, emission_g;
    int phase_kind, steps, unused[2];
  } const knobs{{a.albedo, a.extinction},
                {a.ambient, a.sky_distance},
                {a.emission, static_cast<float>(a.phase.g)},
                static_cast<int>(a.phase.kind),
                a.steps,
                {}};
  r.block(knobs_binding, knobs);

  const auto all_lights = static_cast<int>(a.lights.size());
  const std::int64_t most = shadowed ? LoopBudget::most / 2 : LoopBudget::most;
  const bool lamps = std::any_of(a.lights.begin(), a.lights.end(), [](const Light& light) { return !light.directional; });
  const bool cuts = a.grid || !a.gaussians.empty() || a.phase.kind > PhaseKind::rayleigh;
  const int most_parts = lamps && cuts ? 8 : 1;  // step_parts()
  const LoopBudget budget =
      loop_budget(a.gaussians, a.grid, a.light_steps, a.light_depth, shadowed ? 1 : a.lights.size(), most, most_parts);
  const std::int64_t a_step = 2 + static_cast<std::int64_t>(a.gaussians.size()) + (a.sources ? 4 : 0) +
                              (budget.a_light + (shadowed ? 1 : 0)) * budget.lights;
  const int all_steps = 3 * a.steps;
  const int steps = static_cast<int>(std::clamp<std::int64_t>(most / a_step, 1, all_steps));
  const auto march = [&](int first_light, int end_light, bool last, auto&& dispatch) {
    program.set("first_light", first_light);
    program.set("end_light", end_light);
    for (int part = 0; part < most_parts; part += budget.parts) {
      program.set("first_part", part);
      program.set("end_part", part + budget.parts);
      program.set("last_light", last && part + budget.parts == most_parts ? 1 : 0);
      for (int first = 0; first < all_steps; first += steps) {
        program.set("first_step", first);
        program.set("end_step", std::min(first + steps, all_steps));
        dispatch();
      }
    }
  };
  if (!shadowed) {
    int first_light = 0;
    do {
      const int end_light = std::min(first_light + budget.lights, depths.hold(program, first_light, a.lights.size()));
      march(first_light, end_light, end_light == all_lights, [&] { r.each_pixel(program, a.airlight.extent, progress); });
      first_light = end_light;
    } while (first_light < all_lights);
    return;
  }
  each_lit_run(a.view, a.lights.size(), a.volumes, a.sky_distance, r, progress, [&](const ShadowRun& run) {
    depths.hold(program, run.light, a.lights.size());
    const int parts = LoopBudget::lit_parts(budget.a_light, run.most_lit);
    program.set("most_lit", parts);
    for (int first = 0; first == 0 || first < run.most_lit; first += parts) {
      program.set("first_lit", first);
      march(run.light, run.light + 1, run.light + 1 == all_lights && first + parts >= run.most_lit,
            [&] { dispatch_run(r, program, run); });
    }
  });
}

}  // namespace airlight
