#include "app/view_input.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "app/view_camera.h"

namespace airlight {

namespace {

std::string name_of(const std::vector<LightSource>& lights, std::size_t i) {
  return lights[i].name.empty() ? std::to_string(i) : lights[i].name;
}

}  // namespace

DesignPlane ViewInput::plane() const {
  const Camera& c = session_.scene().camera;
  if (state_.level_plane) return {{0, static_cast<double>(state_.plane_height), 0}, {0, 1, 0}};
  return {c.look_at, -Screen(c).forward()};
}

void ViewInput::attempt(const Edit& edit) {
  try {
    session_.attempt(edit);
  } catch (const InputError& e) {
    state_.status = e.what();
  }
}

void ViewInput::apply(const Edit& edit) {
  try {
    session_.apply(edit);
    state_.status.clear();
  } catch (const InputError& e) {
    state_.status = e.what();
  }
}

void ViewInput::stop() {
  release();
  playing_ = false;
  session_.commit();
}

void ViewInput::handle(const ViewEvent& e, const std::vector<ViewPane>& panes, bool keys_are_typed) {
  if (drag_ == Drag::none && !panes.empty()) pane_ = panes.front();
  if (e.kind == ViewEvent::Kind::key) return key(e, keys_are_typed);
  if (e.kind == ViewEvent::Kind::wheel) {
    if (mouse_ && !draws()) session_.look(dollied(session_.scene().camera, std::pow(0.9, e.at.y)));
    return;
  }
  const auto pane = std::find_if(panes.begin(), panes.end(), [&](const ViewPane& p) { return p.holds(e.at); });
  if (e.kind == ViewEvent::Kind::button) {
    if (!e.down) return release();
    if (pane != panes.end() && drag_ == Drag::none) press(e, *pane);
    return;
  }
  mouse_.reset();
  if (pane != panes.end()) mouse_ = pane->screen(e.at);
  if (drag_ != Drag::none) drag(e.at);
}

void ViewInput::key(const ViewEvent& e, bool typed) {
  constexpr int flight[] = {GLFW_KEY_W, GLFW_KEY_A, GLFW_KEY_S, GLFW_KEY_D, GLFW_KEY_Q, GLFW_KEY_E};
  const bool flies = std::find(std::begin(flight), std::end(flight), e.code) != std::end(flight);
  const bool control = (e.modifiers & GLFW_MOD_CONTROL) != 0, shift = (e.modifiers & GLFW_MOD_SHIFT) != 0;
  if (!e.down) {
    held_.erase(e.code);
    return;
  }
  if (typed) return;
  if (control) {
    if (e.code == GLFW_KEY_Z || e.code == GLFW_KEY_Y) {
      stop();
      return e.code == GLFW_KEY_Y || shift ? apply(RedoEdit{}) : apply(UndoEdit{});
    }
    if (e.code == GLFW_KEY_S) state_.save_wanted = true;
    if (e.code == GLFW_KEY_C && state_.selected) {
      apply(CopyEdit{state_.selection});
      state_.status = std::to_string(session_.copied().size()) + " Gaussians copied";
    }
    if (e.code == GLFW_KEY_V) paste();
    return;
  }
  if (flies) held_.insert(e.code);
  if (e.code >= GLFW_KEY_1 && e.code < GLFW_KEY_1 + static_cast<int>(view_tool_names.size())) {
    stop();
    state_.tool = static_cast<ViewTool>(e.code - GLFW_KEY_1);
    state_.selected = false;
  }
  switch (e.code) {
    case GLFW_KEY_B:
      state_.source = state_.source == ViewSource::cpu ? ViewSource::gl : ViewSource::cpu;
      break;
    case GLFW_KEY_R:
      state_.source = ViewSource::reference;
      break;
    case GLFW_KEY_F:
      frame();
      break;
    case GLFW_KEY_HOME:
      session_.look_from_start();
      break;
    case GLFW_KEY_V:
      state_.split = !state_.split;
      break;
    case GLFW_KEY_P:
      (shift ? state_.window_wanted : state_.picture_wanted) = true;
      break;
    case GLFW_KEY_TAB:
      state_.panel = !state_.panel;
      break;
    case GLFW_KEY_ESCAPE:
      drag_ = Drag::none, playing_ = false;
      session_.abandon();
      break;
    default:
      break;
  }
}

std::optional<std::size_t> ViewInput::light_at(const glm::dvec2& window, const ViewPane& pane) const {
  const Screen screen(session_.scene().camera);
  const std::vector<LightSource>& lights = session_.scene().lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const auto seen = lights[i].type == LightType::point ? screen.seen(lights[i].position) : std::nullopt;
    if (seen && glm::distance(pane.window(seen->at), window) < handle_radius) return i;
  }
  return {};
}

void ViewInput::press(const ViewEvent& e, const ViewPane& pane) {
  pane_ = pane, last_ = e.at;
  mouse_ = pane.screen(e.at);
  if (e.code == GLFW_MOUSE_BUTTON_RIGHT) return void(drag_ = Drag::orbit);
  if (e.code == GLFW_MOUSE_BUTTON_MIDDLE) return void(drag_ = Drag::pan);
  const bool was_playing = playing_;
  stop();
  if (const auto light = light_at(e.at, pane)) {
    light_ = *light;
    return void(drag_ = Drag::light);
  }
  stroke_ = {*mouse_};
  time_ = 0;
  switch (state_.tool) {
    case ViewTool::look:
      drag_ = Drag::orbit;
      break;
    case ViewTool::paint:
      seed_of_drag_ = session_.next_seed();
      [[fallthrough]];
    case ViewTool::erase:
      drag_ = Drag::stroke;
      try_stroke();
      break;
    case ViewTool::airbrush:
      seed_of_drag_ = session_.next_seed();
      drag_ = Drag::spray;
      break;
    case ViewTool::emit:
      if (was_playing) break;  // this press has stopped it
      seed_of_drag_ = session_.next_seed();
      if (const auto at = Screen(session_.scene().camera).on_plane(*mouse_, plane())) {
        state_.emitter.position = *at;
        playing_ = true;
      } else {
        state_.status = "the plane is not seen there";
      }
      break;
    case ViewTool::select:
      drag_ = Drag::rectangle;
      state_.selection = {*mouse_, *mouse_};
      break;
  }
}

void ViewInput::drag(const glm::dvec2& at) {
  const glm::dvec2 here = pane_.screen(at), step = here - pane_.screen(last_);
  const Camera& camera = session_.scene().camera;
  const Screen screen(camera);
  switch (drag_) {
    case Drag::orbit: {
      // A half height of the screen turns about one's own place by what is seen there, about another by a radian and a half.
      const double scale = state_.fly ? std::atan(screen.half_height()) : 1.5;
      session_.look(state_.fly ? turned(camera, scale * step) : orbited(camera, -scale * step));
      break;
    }
    case Drag::pan:
      session_.look(panned(camera, -step));
      break;
    case Drag::light: {
      const LightSource& light = session_.scene().lights[light_];
      if (const auto to = screen.on_plane(here, {light.position, screen.forward()}))
        attempt(LightEdit{name_of(session_.scene().lights, light_), *to, {}, {}});
      break;
    }
    case Drag::stroke:
    case Drag::spray:
      if (glm::distance(here, stroke_.back()) * pane_.size.y < 4) return;  // two pixels
      stroke_.push_back(here);
      if (drag_ == Drag::stroke) try_stroke();
      break;
    case Drag::rectangle:
      state_.selection.to = here;
      break;
    case Drag::none:
      break;
  }
  last_ = at;
}

void ViewInput::try_stroke() {
  Stroke stroke;
  stroke.screen = stroke_;
  const bool erases = state_.tool == ViewTool::erase;
  if (!erases || !state_.erase_through) {
    stroke.plane = plane();
    const Screen screen(session_.scene().camera);
    std::erase_if(stroke.screen, [&](const glm::dvec2& p) { return !screen.on_plane(p, *stroke.plane); });
    if (stroke.screen.empty()) {
      state_.status = "the plane is not seen there";
      return;
    }
  }
  if (erases) {
    attempt(EraseEdit{stroke, static_cast<double>(state_.eraser_radius), static_cast<double>(state_.eraser_amount)});
  } else {
    attempt(PaintEdit{stroke, state_.puff, {}, {}, seed_of_drag_});
  }
}

void ViewInput::try_spray() {
  AirbrushEdit e = state_.airbrush;
  const Screen screen(session_.scene().camera);
  for (const glm::dvec2& p : stroke_) {
    if (const auto at = screen.on_plane(p, plane())) e.points.push_back(*at);
  }
  if (e.points.empty()) return;
  e.puff = state_.puff, e.seconds = time_, e.seed = seed_of_drag_;
  attempt(e);
}

void ViewInput::release() {
  if (drag_ == Drag::spray && time_ > 0) try_spray();
  if (drag_ == Drag::stroke || drag_ == Drag::spray || drag_ == Drag::light) session_.commit();
  if (drag_ == Drag::rectangle) state_.selected = state_.selection.from != state_.selection.to;
  drag_ = Drag::none;
}

void ViewInput::frame() { session_.look(framing(session_.scene(), pane_.size.x / pane_.size.y)); }

void ViewInput::paste() {
  const std::vector<Gaussian>& copied = session_.copied();
  if (copied.empty()) return void(state_.status = "nothing was copied");
  glm::dvec3 middle{0};
  for (const Gaussian& g : copied) middle += g.center / static_cast<double>(copied.size());
  // To where the mouse is, on the plane through the middle of what was copied that faces the camera.
  const Screen screen(session_.scene().camera);
  const auto to = screen.on_plane(mouse_.value_or(glm::dvec2(0)), {middle, screen.forward()});
  if (!to) return void(state_.status = "what was copied is behind the camera");
  apply(PasteEdit{*to - middle});
}

void ViewInput::tick(double seconds, bool drawn) {
  if (!held_.empty() && !draws()) {
    const auto axis = [&](int plus, int minus) {
      return static_cast<double>(held_.count(plus)) - static_cast<double>(held_.count(minus));
    };
    const Camera& c = session_.scene().camera;
    const double speed = 0.5 * glm::distance(c.position, c.look_at) * std::min(seconds, 0.1);
    session_.look(
        moved(c, speed * glm::dvec3(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S))));
  }
  if (drag_ == Drag::spray) {
    time_ += seconds;
    if (drawn) try_spray();
  }
  if (playing_) {
    time_ += seconds;
    if (!drawn) return;
    EmitEdit e = state_.emitter;
    e.puff = state_.puff, e.time = time_, e.seed = seed_of_drag_;
    attempt(e);
  }
}

}  // namespace airlight
