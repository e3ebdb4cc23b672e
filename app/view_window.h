// The window: GLFW's, its OpenGL context, Dear ImGui in it, and pictures below that.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/airlight.h"
#include "app/view_input.h"
#include "app/view_painter.h"

struct GLFWwindow;

namespace airlight {

class ViewWindow {
 public:
  // Throws MachineError in one line where there is no display or no OpenGL 3.2.
  ViewWindow(const std::string& title, Extent);
  ~ViewWindow();
  ViewWindow(const ViewWindow&) = delete;
  ViewWindow& operator=(const ViewWindow&) = delete;

  // Waits for something to happen, at most so long [s], and returns what did.
  std::vector<ViewEvent> wait(double seconds);
  // Ends wait(), from any thread.
  static void wake();
  bool closed() const;
  Extent extent() const;
  void title(const std::string&);
  void copy(const std::string& text);

  // An OpenGL 4.5 core context that shares objects with the window's, for one renderer in any thread; it lives as long as the
  // window. Throws MachineError in one line where the window system has none.
  GlHost render_context();
  // What it makes and what is on the host; only between frames.
  ViewPainter& painter();

  void begin_frame();
  void draw_picture(int slot, const ViewPane&, float exposure);
  // Draws what ImGui was told and shows all that; `keeps`: for pixels().
  void end_frame(bool keeps);

  // The frame that was kept last, linear, for write_image().
  const HostImage& pixels() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
