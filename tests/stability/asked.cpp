// Which technique renders a hostile scene, and how.
#include <algorithm>

#include "common/techniques/technique.h"
#include "tests/stability/draw.h"
#include "tests/stability/trial.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 0x40000000;  // beside those of the scenes

Settings settings_of(const std::string& technique, const Scene& scene, Draw& draw) {
  Settings s;
  const auto set = [&](const char* name, const char* value) { s.emplace_back(name, value); };
  const bool homogeneous = scene.medium.gaussians.empty() && !scene.medium.grid;
  if (technique == "shadow-planes") {
    if (draw.chance(0.1)) set("shadows", "published");
    if (draw.chance(0.1)) set("table_nodes", "32");
  }
  if (technique == "gaussian-airlight") {
    set("samples", draw.of(std::array{"1", "4", "4", "8", "8"}));
    if (draw.chance(0.3)) set("light_path", draw.of(std::array{"exact", "volume", "published"}));
    if (draw.chance(0.1)) set("erf", "fast");
    if (draw.chance(0.1)) set("lost_depth", "1e-3");
  }
  if (technique == "marching") {
    set("steps", draw.of(std::array{"1", "32", "128"}));
    if (scene.medium.grid) set("light_steps", draw.of(std::array{"4", "16", "32"}));
    if (draw.chance(0.1) && !scene.medium.gaussians.empty()) set("shadow", "march");
  }
  if (technique == "opacity-propagation") {
    set("resolution", draw.of(std::array{"2", "24", "48"}));
    set("steps", draw.of(std::array{"64", "128"}));
    if (draw.chance(0.2))
      set("storage", "half");
    else if (draw.chance(0.2))
      set("scheme", draw.of(std::array{"upwind", "published"}));
    if (draw.chance(0.2)) set("density", "exact");
  }
  if (technique == "illumination-network") {
    set("particles", draw.of(std::array{"1", "30", "300"}));
    set("directions", draw.of(std::array{"1", "6", "20"}));
    set("iterations", draw.of(std::array{"1", "40"}));
    set("resolution", draw.of(std::array{"2", "6", "12"}));
    set("steps", "16");
    if (draw.chance(0.25)) set("image", "splats");
    if (draw.chance(0.1)) set("direction_set", "random");
  }
  if (technique != "shadow-planes" && technique != "illumination-network" && draw.chance(0.1))
    set("airlight_resolution", draw.of(std::array{"half", "quarter"}));
  if (draw.chance(0.1)) set("shadows", "off");
  if (draw.chance(0.2))
    set("indirect", "off");
  else if (!homogeneous && draw.chance(0.2))
    set("indirect", scene.medium.phase.kind == PhaseKind::isotropic && draw.chance(0.5) ? "psf" : "mean_density");
  if (scene.environment) {
    set("environment_rays", "16");
    if (draw.chance(0.2)) set("environment_airlight", draw.of(std::array{"off", "published"}));
  }
  if (technique == "illumination-network" && !scene.medium.grid && draw.chance(0.2)) set("particle_set", "gaussians");
  // The last one said wins: only one is, so that what is drawn is what is told.
  Settings once;
  for (const auto& [name, value] : s) {
    if (std::none_of(once.begin(), once.end(), [&n = name](const auto& o) { return o.first == n; }))
      once.emplace_back(name, value);
  }
  return once;
}

}  // namespace

std::string Asked::text() const {
  std::string all = technique;
  for (const auto& [name, value] : settings) all += " " + name + "=" + value;
  return all;
}

Asked asked_of(const Scene& scene, std::uint32_t number) {
  Draw draw(stream + number);
  std::vector<std::string> can;
  for (const Technique& t : techniques()) {
    if (t.plan && !t.refuses(scene)) can.emplace_back(t.name);
  }
  if (can.empty()) return {};  // an environment, a grid and surfaces
  Asked asked;
  asked.technique = can[static_cast<std::size_t>(draw.whole(0, static_cast<int>(can.size()) - 1))];
  asked.settings = settings_of(asked.technique, scene, draw);
  asked.images = image_names(scene);
  const bool splats =
      std::count(asked.settings.begin(), asked.settings.end(), std::pair<std::string, std::string>("image", "splats"));
  std::erase_if(asked.images, [&](const std::string& name) {
    const bool of_a_light = name.starts_with("airlight.");
    return of_a_light && (splats || scene.lights.size() > 3);
  });
  return asked;
}

}  // namespace airlight
