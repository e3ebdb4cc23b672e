#include "common/plan/indirect.h"

#include "common/plan/geometry.h"
#include "common/plan/hash.h"
#include "common/plan/surface_airlight_tables.h"

namespace airlight {

Knob indirect_knob() {
  return {.name = "indirect",
          .kind = Knob::Kind::choice,
          .standard = "unbounded",
          .least = 0,
          .most = 0,
          .choices = {"unbounded", "off"},
          .meaning = "light scattered once on its way to surfaces, as of an unbounded homogeneous medium without shadows",
          .sweep = {}};
}

Image add_indirect(const Scene& scene, const FrameRequest& request, SurfaceAirlight given, std::uint32_t tables_id,
                   Images& images, Plan& plan) {
  const Medium& medium = scene.medium;
  const bool scatters = medium.extinction > 0 && medium.albedo != glm::dvec3(0);
  if (!scatters || given.lights.empty() || scene.surfaces.empty() || request.knobs.choice("indirect") == "off") {
    const bool off = scatters && !given.lights.empty() && !scene.surfaces.empty();
    plan.skips.push_back({"indirect single scattering", off ? "indirect = off" : "no light, no surface or nothing scatters"});
    return {};
  }
  given.materials = materials_of(scene);
  const std::vector<float> shininess = shininess_of(given.materials);
  Hash key;
  key.add(std::string_view("surface airlight"));
  key.add(medium.phase);
  key.add(shininess);
  given.tables = {{tables_id}, 0};
  plan.uploads.push_back({given.tables, key.value(), [phase = medium.phase, shininess] {
                            const std::vector<float> values = surface_airlight_tables(phase, shininess);
                            const auto bytes = std::as_bytes(std::span(values));
                            return std::vector<std::byte>(bytes.begin(), bytes.end());
                          }});
  given.extinction = static_cast<float>(medium.extinction);
  given.albedo = medium.albedo;
  given.indirect = images.make("surface.indirect", Format::rgb32f);
  plan.steps.push_back({given, "light scattered once on its way to the surfaces"});
  return given.indirect;
}

}  // namespace airlight
