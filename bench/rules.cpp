// airlight-rules: what the rules gain by which plans leave out what a scene does not need: whole frames with what is left out
// beside frames where it has to be computed, in turn. A table for docs/RESULTS.md; of one rule where its name is given.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "app/airlight.h"
#include "common/plan/rules.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

constexpr Extent extent{400, 300};
constexpr int rounds = 9;

// A scene that renders over and over, changed a little each time.
struct Side {
  Scene scene;
  RenderSettings settings;
  std::function<void(Scene&, int)> change;
  std::size_t keep = 0;
  bool cold = false;  // a renderer a frame
};

void move_camera(Scene& scene, int i) { scene.camera.position.x += i % 2 == 0 ? 1e-4 : -1e-4; }
void nothing(Scene&, int) {}

Side side(const Scene& scene, const std::string& technique, std::vector<std::pair<std::string, std::string>> knobs = {}) {
  Side s;
  s.scene = scene;
  s.settings.technique = technique;
  s.settings.knobs = std::move(knobs);
  s.settings.resolution = extent;
  s.change = move_camera;
  return s;
}

class Timer {
 public:
  explicit Timer(const Side& s) : side_(s) {}
  void frame(int i) {
    if (!renderer_ || side_.cold) renderer_ = std::make_unique<Renderer>(RendererOptions{.keep = side_.keep});
    side_.change(side_.scene, i);
    const auto start = std::chrono::steady_clock::now();
    renderer_->render(side_.scene, side_.settings);
    const double ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (i >= 2) times_.push_back(ms);
  }
  double least() const { return *std::min_element(times_.begin(), times_.end()); }

 private:
  Side side_;
  std::unique_ptr<Renderer> renderer_;
  std::vector<double> times_;
};

std::string_view only;  // of this rule; empty: of all

void row(Rule rule, const char* what, const Side& without, const Side& with) {
  if (!only.empty() && only != name_of(rule)) return;
  Timer a(without), b(with);
  for (int i = 0; i < rounds + 2; ++i) a.frame(i), b.frame(i);
  fmt::print("| `{}` | {} | {:.2f} | {:.2f} | {:.2f} |\n", name_of(rule), what, a.least(), b.least(), b.least() / a.least());
}

// Blobs about the middle of the torus over a plane, as many as asked for.
Scene in_gaussians(int count) {
  Scene scene = test_scene(5000);
  scene.medium.extinction = 0;
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<std::uint32_t>(i);
    scene.medium.gaussians.push_back({.center = {4 * uniform(1, n) - 2, 2 * uniform(2, n), 4 * uniform(3, n) - 2},
                                      .radius = 0.3 + 0.3 * uniform(4, n),
                                      .extinction = 0.5});
  }
  return scene;
}

Scene dim(Scene scene, double power) {
  scene.lights.back().power = glm::dvec3(power);
  return scene;
}

void still_frames() {
  const Side fog = side(test_scene(100000), "shadow-planes"), blobs = side(in_gaussians(40), "opacity-propagation");
  for (const auto& [name, of] : {std::pair{"shadow planes", &fog}, std::pair{"opacity propagation", &blobs}}) {
    constexpr std::size_t enough = std::size_t{256} << 20U;
    const Side& base = *of;
    const auto edited = [&base](std::size_t keep, const std::function<void(Scene&, int)>& change) {
      Side s = base;
      s.keep = keep, s.change = change;
      return s;
    };
    const auto moved = [](Scene& scene, int i) { scene.lights[0].position.x += i % 2 == 0 ? 1e-4 : -1e-4; };
    const auto material = [](Scene& scene, int i) {
      scene.surfaces[0].material.diffuse.x = 0.5F + 0.01F * static_cast<float>(i);
    };
    const auto dims = [](Scene& scene, int i) { scene.lights[0].power *= 1 + 1e-3 * (i % 3 - 1) + 1e-6; };
    row(Rule::unchanged, fmt::format("{}: nothing changes, else the camera moves", name).c_str(), edited(0, nothing), *of);
    row(Rule::unchanged, fmt::format("{}: a material changes, all images kept, else none", name).c_str(),
        edited(enough, material), edited(0, material));
    row(Rule::unchanged, fmt::format("{}: a light dims, all images kept, else none", name).c_str(), edited(enough, dims),
        edited(0, dims));
    row(Rule::unchanged, fmt::format("{}: a light moves, all images kept, else none", name).c_str(), edited(enough, moved),
        edited(0, moved));
  }
}

void fog() {
  const Scene scene = test_scene(5000);
  row(Rule::dark_lights, "one of three lights without power, else 1e-30", side(dim(scene, 0), "shadow-planes"),
      side(dim(scene, 1e-30), "shadow-planes"));
  Scene black = scene, faint = scene;
  black.medium.albedo = glm::dvec3(0), faint.medium.albedo = glm::dvec3(1e-30);
  row(Rule::no_scattering, "albedo 0, else 1e-30", side(black, "shadow-planes"), side(faint, "shadow-planes"));
  Scene sun = scene;
  sun.lights = {sun.lights.front()};
  sun.lights[0].type = LightType::directional;
  sun.lights[0].direction = {0, -1, 0};
  Side without = side(sun, "shadow-planes", {{"indirect", "off"}});
  sun.lights.push_back(scene.lights.front());
  sun.lights[1].power = glm::dvec3(1e-30);
  Side with = side(sun, "shadow-planes", {{"indirect", "off"}});
  without.cold = with.cold = true;
  row(Rule::no_tables, "first frame: a sun alone, else a lamp of 1e-30 beside it", without, with);
  Scene open = scene;
  for (Surface& s : open.surfaces) s.casts_shadow = false;
  row(Rule::no_shadows, "nothing casts a shadow", side(open, "shadow-planes"), side(scene, "shadow-planes"));
  Scene far_away = scene, near_enough = scene;
  for (Scene* s : {&far_away, &near_enough}) {
    s->lights.resize(1);
    s->surfaces[1].transform[3] = {0, 0, -30, 1};
  }
  far_away.medium.extinction = 4, near_enough.medium.extinction = 1;
  row(Rule::casters_out_of_reach, "fog of 4 /m before casters, else 1 /m", side(far_away, "shadow-planes"),
      side(near_enough, "shadow-planes"));
  Scene aside = scene;
  aside.camera.look_at = aside.camera.position + (aside.camera.position - aside.camera.look_at) * glm::dvec3(1, 0, 1);
  row(Rule::tiles_without_planes, "planes out of view: the camera turned round", side(aside, "shadow-planes"),
      side(scene, "shadow-planes"));
  Scene deep = scene;
  deep.medium.extinction = 4;
  for (LightSource& light : deep.lights)
    light.type = LightType::point, light.position = deep.camera.position + glm::dvec3(0, 0, -20);
  Scene reached = deep;
  deep.lights[1].position.z -= 80, deep.lights[2].position.z -= 80;
  row(Rule::lamps_out_of_reach, "fog of 4 /m, two of three lamps 100 m away, else 20 m", side(deep, "shadow-planes"),
      side(reached, "shadow-planes"));
  Scene hidden = scene, seen = scene;
  hidden.medium.extinction = 60, seen.medium.extinction = 40;
  row(Rule::behind_fog, "surfaces 2 m behind fog of 60 /m, else 40 /m", side(hidden, "shadow-planes", {{"shadows", "off"}}),
      side(seen, "shadow-planes", {{"shadows", "off"}}));
  row(Rule::no_indirect, "albedo 0 and a black surface's share of it, else 1e-30",
      side(black, "shadow-planes", {{"shadows", "off"}}), side(faint, "shadow-planes", {{"shadows", "off"}}));
}

// The sky alone, whose pixels have the same airlight unless the angle to the sun matters.
void even_sky() {
  Scene sky = test_scene(5000);
  sky.surfaces.clear();
  sky.medium.extinction = 0.1;
  sky.medium.phase = {PhaseKind::isotropic, 0};
  sky.lights.resize(1);
  sky.lights[0].type = LightType::directional;
  sky.lights[0].direction = {0, -1, 0};
  Scene forward = sky;
  forward.medium.phase = {PhaseKind::henyey_greenstein, 1e-6};
  for (const char* technique : {"shadow-planes", "marching"})
    row(Rule::even_airlight, fmt::format("sky in fog and a sun, isotropic, else g = 1e-6, {}", technique).c_str(),
        side(sky, technique), side(forward, technique));
}

void environments() {
  Scene scene = test_scene(5000);
  scene.environment = Environment{nullptr, {0.3, 0.4, 0.5}, 0};
  scene.background = {0, 0, 0};
  Scene clear = scene, thin = scene;
  clear.medium.extinction = 0, thin.medium.extinction = 1e-9;
  row(Rule::environment_airlight, "no medium, else fog of 1e-9 /m", side(clear, "shadow-planes"), side(thin, "shadow-planes"));
  Scene open = scene;
  for (Surface& s : open.surfaces) s.casts_shadow = false;
  row(Rule::environment_shadows, "nothing hides the sky", side(open, "shadow-planes", {{"shadows", "off"}}),
      side(scene, "shadow-planes", {{"shadows", "off"}}));
  Scene black = scene, faint = scene;
  black.medium.albedo = glm::dvec3(0), faint.medium.albedo = glm::dvec3(1e-30);
  const std::vector<std::pair<std::string, std::string>> on{{"environment_indirect", "on"}, {"indirect", "off"}};
  row(Rule::environment_indirect, "albedo 0, else 1e-30", side(black, "shadow-planes", on), side(faint, "shadow-planes", on));
}

void gaussians() {
  const Scene scene = in_gaussians(40);
  Scene half = scene;
  for (std::size_t i = 0; i < half.medium.gaussians.size(); i += 2) half.medium.gaussians[i].extinction = 0;
  for (const char* technique : {"gaussian-airlight", "marching"})
    row(Rule::empty_gaussians, fmt::format("half of 40 Gaussians without extinction, {}", technique).c_str(),
        side(half, technique), side(scene, technique));
  Scene once = scene, twice = scene;
  for (Gaussian g : scene.medium.gaussians) {
    once.medium.gaussians.push_back(g);
    g.radius *= 1 + 1e-12;
    twice.medium.gaussians.push_back(g);
  }
  for (const char* technique : {"gaussian-airlight", "marching"})
    row(Rule::coincident_gaussians, fmt::format("40 Gaussians twice over, else a hair apart, {}", technique).c_str(),
        side(once, technique), side(twice, technique));
  Scene behind = scene;
  for (Gaussian& g : behind.medium.gaussians) g.center += 3.0 * (scene.camera.position - scene.camera.look_at);
  row(Rule::out_of_view, "40 Gaussians behind the camera, else before it", side(behind, "gaussian-airlight"),
      side(scene, "gaussian-airlight"));
  Scene noisy = scene;
  noisy.medium.noise = {0.5, 0.3, {0, 0, 0}};
  Scene none = noisy;
  none.medium.gaussians.clear();
  none.medium.extinction = noisy.medium.extinction = 0.05;
  row(Rule::no_noise, "noise and no Gaussians, else 40", side(none, "gaussian-airlight"), side(noisy, "gaussian-airlight"));
  Scene unlit = scene, faint = scene;
  unlit.lights.clear();
  faint.lights.resize(1);
  faint.lights[0].power = glm::dvec3(1e-30);
  row(Rule::no_nodes, "40 Gaussians and no light, else one of 1e-30", side(unlit, "gaussian-airlight"),
      side(faint, "gaussian-airlight"));
  const Scene few = in_gaussians(3);
  const auto moving = [&](const Scene& s, const char* technique, const char* knob, const char* value) {
    Side made = side(s, technique, {{knob, value}});
    made.change = [](Scene& changed, int i) { changed.medium.gaussians[0].center.x += i % 2 == 0 ? 1e-4 : -1e-4; };
    return made;
  };
  row(Rule::no_light_volumes, "three Gaussians that move: closed forms, else volumes",
      moving(few, "gaussian-airlight", "light_path", "auto"), moving(few, "gaussian-airlight", "light_path", "volume"));
  row(Rule::no_injection, "three Gaussians that move: closed forms, else a grid",
      moving(few, "opacity-propagation", "density", "auto"), moving(few, "opacity-propagation", "density", "volume"));
  Scene dark = scene, lit = scene;
  dark.lights.clear();
  for (LightSource& light : lit.lights) light.power = glm::dvec3(1e-30);
  row(Rule::no_light_march, "no light, else three of 1e-30", side(dark, "marching"), side(lit, "marching"));
  Scene fog = test_scene(5000);
  Side one = side(fog, "marching", {{"light_steps", "16"}}), other = one;
  fog.medium.gaussians.push_back({.center = {0, 0, 900}, .radius = 1, .extinction = 1e-6});
  other.scene = fog;
  row(Rule::homogeneous, "fog alone, else a Gaussian far away", one, other);
  Scene empty = scene;
  empty.medium.gaussians.clear();
  row(Rule::every_pixel, "airlight_resolution=half without a medium, else 40 Gaussians",
      side(empty, "marching", {{"airlight_resolution", "half"}}), side(scene, "marching", {{"airlight_resolution", "half"}}));
}

void network() {
  Scene scene = in_gaussians(5), foggy = scene;
  foggy.medium.extinction = 1e-9;
  const std::vector<std::pair<std::string, std::string>> small{{"particles", "512"}, {"directions", "64"}};
  auto splats = small;
  splats.emplace_back("image", "splats");
  row(Rule::no_fog, "splats without fog, else fog of 1e-9 /m", side(scene, "illumination-network", splats),
      side(foggy, "illumination-network", splats));
  Side source = side(scene, "illumination-network", small), seen = side(scene, "illumination-network", splats);
  source.change = seen.change = [](Scene& changed, int i) { changed.lights[0].power *= 1 + 1e-3 * (i % 3 - 1) + 1e-6; };
  row(Rule::splatted, "particles seen themselves, else their source function; a light dims", seen, source);
}

}  // namespace

}  // namespace airlight

int main(int count, char** arguments) {
  if (count > 1) airlight::only = arguments[1];
  try {
    fmt::print(
        "| rule | left out, and what it is measured beside | ms without it | ms with it | ratio |\n|---|---|---|---|---|\n");
    airlight::still_frames();
    airlight::fog();
    airlight::even_sky();
    airlight::environments();
    airlight::gaussians();
    airlight::network();
  } catch (const std::exception& error) {
    fmt::print(stderr, "airlight-rules: {}\n", error.what());
    return 1;
  }
  return 0;
}
