#include "app/explained.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <type_traits>

#include "app/plan_tree.h"
#include "app/request.h"
#include "common/plan/even_airlight.h"
#include "common/plan/keys.h"
#include "common/plan/shadow_quads.h"
#include "cpu/tile.h"

namespace airlight {

namespace {

// What of the frame the CPU computes without asking for each pixel what the lights reach.
void add_tiles_without_planes(const Plan& plan, std::vector<SkipStats>& skips) {
  for (const Step& step : plan.steps) {
    const auto* planes = std::get_if<ShadowPlanes>(&step.what);
    if (!planes) continue;
    const auto upload = std::find_if(plan.uploads.begin(), plan.uploads.end(),
                                     [&](const Plan::Upload& u) { return u.buffer.id == planes->volumes.id; });
    if (upload == plan.uploads.end()) throw std::logic_error("shadow planes without volumes");
    const std::vector<std::byte> volumes = upload->make();
    const TileCount tiles = count_tiles(planes->view, {volumes, planes->lights.size()}, tile_side);
    if (tiles.without_planes == 0) return;
    char text[160];
    std::snprintf(text, sizeof text, "shadow planes in %zu of %zu tiles of %d x %d pixels (%.0f %%)", tiles.without_planes,
                  tiles.all, tile_side, tile_side,
                  100 * static_cast<double>(tiles.without_planes) / static_cast<double>(tiles.all));
    skips.push_back({std::string(name_of(Rule::tiles_without_planes)), text, "none touches them"});
    return;
  }
}

// What the CPU computes once for all rays of a length in a tile.
void add_even_airlight(const Plan& plan, std::vector<SkipStats>& skips) {
  const auto even = [](const auto& a) {
    using Step = std::remove_cvref_t<decltype(a)>;
    if constexpr (std::is_same_v<Step, RayMarch> || std::is_same_v<Step, HomogeneousAirlight>) return has_even_fog(a);
    return false;
  };
  if (std::any_of(plan.steps.begin(), plan.steps.end(), [&](const Step& step) { return std::visit(even, step.what); })) {
    skips.push_back({std::string(name_of(Rule::even_airlight)),
                     "airlight of rays through fog that are as long as others of a tile",
                     "on the CPU: nothing in it hangs on where they go"});
  }
}

}  // namespace

std::string explained(const Scene& scene, const RenderSettings& asked, const RendererOptions& options, const MakePlan& make_plan,
                      const Held& held) {
  const auto [settings, chosen] = chosen_for_goal(scene, asked, options);
  const Technique& technique = chosen_technique(scene, settings);
  const FrameRequest request = request_for(technique, scene, settings);
  std::string text = chosen.empty() ? "" : "chosen: " + chosen + "\n";
  text += std::string(technique.name) + ": " + std::string(technique.summary) + "\n";
  for (const auto& [name, value] : request.knobs.all()) text += "  " + name + " = " + value + "\n";
  if (!technique.plan) return text;
  const Plan plan = make_plan(technique, scene, request);
  Stats stats = planned_stats(plan, steps_to_run(plan, held));
  add_tiles_without_planes(plan, stats.skips);
  add_even_airlight(plan, stats.skips);
  text += "steps\n" + plan_tree(stats, false);
  if (!stats.skips.empty()) text += "left out\n" + left_out(stats);
  return text;
}

}  // namespace airlight
