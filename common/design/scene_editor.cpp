#include "common/design/scene_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "common/design/screen.h"
#include "common/design/tools.h"
#include "common/error.h"
#include "common/scene/limits.h"

namespace airlight {

void check_count(double gaussians, const char* what) {
  if (gaussians < static_cast<double>(most_gaussians)) return;
  throw InputError(fmt::format("{} would place {:.4g} Gaussians, expected fewer than {}", what, gaussians, most_gaussians));
}

Gaussian gaussian_of(const Puff& puff, const glm::dvec3& center, const Medium& medium) {
  return {center, puff.radius, puff.extinction, puff.albedo.value_or(medium.albedo), puff.emission.value_or(medium.emission)};
}

namespace {

template <class T>
std::shared_ptr<const T> shared(T value) {
  return std::make_shared<const T>(std::move(value));
}

LightSource& light_named(std::vector<LightSource>& lights, const std::string& name) {
  for (LightSource& l : lights) {
    if (!l.name.empty() && l.name == name) return l;
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc() && end == name.data() + name.size() && number < lights.size()) return lights[number];
  throw InputError(fmt::format("no light \"{}\", expected its name or a number below {}", name, lights.size()));
}

}  // namespace

SceneEditor::SceneEditor(Scene scene, double later) : scene_(std::move(scene)), later_(later) {
  states_.push_back({shared(scene_.medium.gaussians), shared(scene_.lights), scene_.medium.extinction});
}

void SceneEditor::apply(const Edit& edit) {
  std::visit([&](const auto& e) { carry_out(e); }, edit);
  scene_.hash.clear();
}

void SceneEditor::show() {
  scene_.medium.gaussians = *states_[now_].gaussians;
  scene_.lights = *states_[now_].lights;
  scene_.medium.extinction = states_[now_].extinction;
}

void SceneEditor::push(State state) {
  states_.resize(now_ + 1);
  states_.push_back(std::move(state));
  ++now_;
  show();
}

void SceneEditor::set_gaussians(std::vector<Gaussian> gaussians) {
  if (gaussians.size() > most_gaussians) check_count(static_cast<double>(gaussians.size()), "the scene");
  for (const Gaussian& g : gaussians) {
    const glm::dvec3 c = glm::abs(g.center);
    if (std::max({c.x, c.y, c.z}) <= limits::farthest) continue;
    throw InputError(fmt::format("a Gaussian would come to ({}, {}, {}), expected coordinates up to {} m", g.center.x, g.center.y,
                                 g.center.z, limits::farthest));
  }
  State state = states_[now_];
  state.gaussians = shared(std::move(gaussians));
  push(std::move(state));
}

void SceneEditor::add(std::vector<Gaussian> more) {
  std::vector<Gaussian> all = scene_.medium.gaussians;
  all.insert(all.end(), more.begin(), more.end());
  set_gaussians(std::move(all));
}

void SceneEditor::carry_out(const PaintEdit& e) { add(painted(e, Screen(scene_.camera), scene_.medium)); }

void SceneEditor::carry_out(const AirbrushEdit& e) {
  if (!collisions_) collisions_ = std::make_unique<Collisions>(scene_);
  add(airbrushed(e, *collisions_, scene_.medium));
}

void SceneEditor::carry_out(const EmitEdit& e) { add(emitted(e, later_, scene_.medium)); }

void SceneEditor::carry_out(const EraseEdit& e) {
  std::vector<Gaussian> left = scene_.medium.gaussians;
  erase(e, Screen(scene_.camera), left);
  set_gaussians(std::move(left));
}

void SceneEditor::carry_out(const CopyEdit& e) {
  const Screen screen(scene_.camera);
  copied_.clear();
  for (const Gaussian& g : scene_.medium.gaussians) {
    if (covers(e.rectangle, screen, g.center)) copied_.push_back(g);
  }
}

void SceneEditor::carry_out(const PasteEdit& e) {
  std::vector<Gaussian> more = copied_;
  for (Gaussian& g : more) g.center += e.offset;
  add(std::move(more));
}

void SceneEditor::carry_out(const MoveEdit& e) {
  const Screen screen(scene_.camera);
  std::vector<Gaussian> all = scene_.medium.gaussians;
  for (Gaussian& g : all) {
    if (covers(e.rectangle, screen, g.center)) g.center += e.offset;
  }
  set_gaussians(std::move(all));
}

void SceneEditor::carry_out(const LightEdit& e) {
  std::vector<LightSource> lights = scene_.lights;
  LightSource& light = light_named(lights, e.light);
  if (e.position && light.type != LightType::point)
    throw InputError("\"position\" of a directional light, expected \"direction\"");
  if (e.direction && light.type != LightType::directional)
    throw InputError("\"direction\" of a point light, expected \"position\"");
  if (e.position) light.position = *e.position;
  if (e.direction) {
    if (glm::length(*e.direction) < 1e-9) throw InputError("\"direction\": a zero vector, expected a direction");
    // Once more, so that loading what is saved changes no bit.
    light.direction = glm::normalize(glm::normalize(glm::normalize(*e.direction)));
  }
  if (e.power) light.power = *e.power;
  State state = states_[now_];
  state.lights = shared(std::move(lights));
  push(std::move(state));
}

void SceneEditor::carry_out(const FogEdit& e) {
  State state = states_[now_];
  state.extinction = e.extinction;
  push(std::move(state));
}

void SceneEditor::carry_out(const CameraEdit& e) {
  Camera c = scene_.camera;
  c.position = e.position.value_or(c.position);
  c.look_at = e.look_at.value_or(c.look_at);
  c.up = e.up.value_or(c.up);
  c.vertical_fov = e.vertical_fov.value_or(c.vertical_fov);
  // As loading asks it.
  const glm::dvec3 view = c.look_at - c.position;
  if (!(glm::length(view) > 1e-9 * (1 + glm::length(c.position)))) throw InputError("the camera looks at its own position");
  const double sine = glm::length(c.up) < 1e-9 ? 0 : glm::length(glm::cross(glm::normalize(view), glm::normalize(c.up)));
  if (!(sine > 1e-6)) throw InputError("the camera looks along its up direction");
  scene_.camera = c;
}

void SceneEditor::carry_out(const TechniqueEdit& e) {
  scene_.technique = e.name;
  scene_.settings = e.settings;
}

void SceneEditor::carry_out(const UndoEdit&) {
  if (!can_undo()) throw InputError("nothing to undo");
  --now_;
  show();
}

void SceneEditor::take_back() {
  apply(UndoEdit{});
  states_.resize(now_ + 1);
}

void SceneEditor::carry_out(const RedoEdit&) {
  if (!can_redo()) throw InputError("nothing to redo");
  ++now_;
  show();
}

}  // namespace airlight
