// The window: GLFW's, its OpenGL context, Dear ImGui in it, and textures to show pictures by.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/airlight.h"
#include "app/view_input.h"

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

  void begin_frame();
  // Draws what ImGui was told and shows it; `keeps`: for pixels().
  void end_frame(bool keeps);

  // What ImGui draws as a picture: three bytes a pixel, rows from the top. `slot` is 0 to 3.
  void set_picture(int slot, Extent, const std::vector<std::uint8_t>&);
  void* picture(int slot) const;  // an ImTextureID; null before the first

  // The frame that was kept last, linear, for write_image().
  const HostImage& pixels() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
