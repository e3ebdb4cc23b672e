// Keys and mouse on the picture, into edits and camera moves.
#pragma once

#include <chrono>
#include <glm/vec2.hpp>
#include <optional>
#include <set>
#include <vector>

#include "app/view_session.h"
#include "app/view_state.h"
#include "common/design/screen.h"

namespace airlight {

// As GLFW tells it, kept in order: what is pressed and let go between two frames is not lost.
struct ViewEvent {
  enum class Kind { key, button, move, wheel } kind = Kind::move;
  int code = 0;  // of the key or button
  bool down = false;
  int modifiers = 0;
  glm::dvec2 at{0, 0};  // [pixel] of the mouse in the window; of a wheel its movement
};

// Where a picture stands in the window [pixel].
struct ViewPane {
  glm::dvec2 low{0, 0}, size{1, 1};
  bool holds(const glm::dvec2& p) const { return p.x >= low.x && p.y >= low.y && p.x < low.x + size.x && p.y < low.y + size.y; }
  glm::dvec2 screen(const glm::dvec2& p) const {  // as in common/design/edits.h
    return {(2 * (p.x - low.x) - size.x) / size.y, 1 - 2 * (p.y - low.y) / size.y};
  }
  glm::dvec2 window(const glm::dvec2& at) const {
    return {low.x + (at.x * size.y + size.x) / 2, low.y + (1 - at.y) * size.y / 2};
  }
};

class ViewInput {
 public:
  ViewInput(ViewSession& session, ViewState& state) : session_(session), state_(state) {}

  // `panes`: where the scene is seen. Errors of edits go to the status line.
  void handle(const ViewEvent&, const std::vector<ViewPane>& panes, bool keys_are_typed);
  // What goes on while nothing happens: held keys, airbrush and emitter. `drawn`: the last change is on the screen.
  void tick(double seconds, bool drawn);
  // A drag, a held key or an emitter keeps the picture moving.
  bool moving() const { return drag_ != Drag::none || !held_.empty() || playing_; }

  void frame();  // all that matters, in the first pane
  void paste();
  void stop();                               // emitter and drags, which are committed
  bool playing() const { return playing_; }  // the emitter

  std::optional<glm::dvec2> mouse_on_screen() const { return mouse_; }
  DesignPlane plane() const;
  static constexpr double handle_radius = 9;  // [pixel]

 private:
  enum class Drag { none, orbit, pan, stroke, spray, light, rectangle };
  void key(const ViewEvent&, bool typed);
  void press(const ViewEvent&, const ViewPane&);
  void drag(const glm::dvec2& at);
  void release();
  bool draws() const { return drag_ == Drag::stroke || drag_ == Drag::spray; }
  void try_stroke();
  void try_spray();
  void attempt(const Edit&);
  void apply(const Edit&);
  std::optional<std::size_t> light_at(const glm::dvec2& window, const ViewPane&) const;

  ViewSession& session_;
  ViewState& state_;
  Drag drag_ = Drag::none;
  ViewPane pane_;
  glm::dvec2 last_{0, 0};
  std::optional<glm::dvec2> mouse_;
  std::vector<glm::dvec2> stroke_;
  std::size_t light_ = 0;
  std::int64_t seed_of_drag_ = 0;
  std::set<int> held_;  // keys of flight
  bool playing_ = false;
  double time_ = 0;  // of the airbrush or emitter [s]
};

}  // namespace airlight
