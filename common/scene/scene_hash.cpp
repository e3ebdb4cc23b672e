#include <fmt/format.h>

#include <algorithm>

#include "common/scene/parse.h"
#include "common/scene/sha256.h"

namespace airlight {

namespace {

// One line a value: a name and the shortest decimals that give the same double; nothing of it depends on the locale.
class Canonical {
 public:
  void add(std::string_view name, double v) { line(name, fmt::format("{}", v + 0.0)); }  // -0 is 0
  void add(std::string_view name, const glm::dvec3& v) { line(name, fmt::format("{} {} {}", v.x + 0.0, v.y + 0.0, v.z + 0.0)); }
  void line(std::string_view name, std::string_view text) {
    // With lengths, so that no text can look like another line.
    hash_.add(fmt::format("{} {}:{}\n", name, text.size(), text));
  }
  std::string hex() const { return hash_.hex(); }

 private:
  Sha256 hash_;
};

void add(Canonical& c, const Medium& m) {
  c.add("phase", static_cast<double>(m.phase.kind));
  c.add("g", m.phase.g);
  c.add("albedo", m.albedo);
  c.add("ambient", m.ambient);
  c.add("emission", m.emission);
  c.add("extinction", m.extinction);
  for (const Gaussian& g : m.gaussians) {
    c.add("center", g.center);
    c.add("radius", g.radius);
    c.add("extinction", g.extinction);
    c.add("albedo", g.albedo);
    c.add("emission", g.emission);
  }
  if (!(m.noise.amplitude > 0)) return;
  c.add("noise", m.noise.amplitude);
  c.add("scale", m.noise.scale);
  c.add("offset", m.noise.offset);
}

}  // namespace

std::string scene_hash(const Loading& loading) {
  const Scene& s = loading.scene;
  Canonical c;
  c.line("airlight scene", "1");
  c.add("position", s.camera.position);
  c.add("look_at", s.camera.look_at);
  c.add("up", s.camera.up);
  c.add("vertical_fov", s.camera.vertical_fov);
  c.add("width", s.camera.resolution.width);
  c.add("height", s.camera.resolution.height);
  c.add("sky_distance", s.sky_distance);
  c.add("background", s.background);
  add(c, s.medium);
  if (s.medium.grid) {
    c.line("grid", loading.grid_hash);
    c.line("grid name", loading.grid_name);
    for (int column = 0; column < 4; ++column) c.add("transform", glm::dvec3(s.medium.grid->transform[column]));
    c.add("scale", s.medium.grid->scale);
    c.add("albedo", s.medium.grid->albedo);
  }
  for (const LightSource& l : s.lights) {
    c.add("light", static_cast<double>(l.type));
    c.line("name", l.name);
    c.add("position", l.position);
    c.add("direction", l.direction);
    c.add("power", l.power);
    c.add("radius", l.radius);
  }
  if (s.environment) {
    c.line("environment", loading.environment_hash);
    c.add("radiance", s.environment->radiance);
    c.add("rotation", s.environment->rotation);
  }
  for (std::size_t i = 0; i < s.surfaces.size(); ++i) {
    const Surface& surface = s.surfaces[i];
    c.line("mesh", loading.surfaces[i].content_hash);
    c.add("flat", loading.surfaces[i].flat ? 1 : 0);
    if (loading.surfaces[i].part >= 0) c.add("part", loading.surfaces[i].part);
    for (int column = 0; column < 4; ++column) c.add("transform", glm::dvec3(surface.transform[column]));
    c.add("casts_shadow", surface.casts_shadow ? 1 : 0);
    if (surface.brdf) {  // the material is told by it
      c.line("brdf", loading.surfaces[i].brdf_hash);
      continue;
    }
    c.add("diffuse", surface.material.diffuse);
    c.add("specular", surface.material.specular);
    c.add("shininess", static_cast<double>(surface.material.shininess));
  }
  c.line("technique", s.technique);
  auto settings = s.settings;
  std::sort(settings.begin(), settings.end());
  for (const auto& [name, value] : settings) c.line("setting " + name, value);
  return c.hex();
}

}  // namespace airlight
