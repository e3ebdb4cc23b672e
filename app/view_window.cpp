#include "app/view_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

// Debian's package keeps the backends beside the library.
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <optional>
#include <utility>

namespace airlight {

namespace {

// GLFW's last in this thread.
std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason told";
}

WindowGl loaded() {
  const auto entry = [](const char* name) {
    const GLFWglproc found = glfwGetProcAddress(name);
    if (found == nullptr) throw MachineError(std::string("the window's OpenGL has no ") + name);
    return found;
  };
  WindowGl gl;
#define AIRLIGHT_WINDOW_GL_LOAD(name, NAME) gl.name = reinterpret_cast<PFNGL##NAME##PROC>(entry("gl" #name));
  AIRLIGHT_WINDOW_GL(AIRLIGHT_WINDOW_GL_LOAD)
#undef AIRLIGHT_WINDOW_GL_LOAD
  return gl;
}

void ask_for_core(int major, int minor) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
}

}  // namespace

struct ViewWindow::State {
  GLFWwindow *window = nullptr, *renders = nullptr;  // the second is never seen
  bool imgui = false;
  WindowGl gl;
  std::optional<ViewPainter> painter;
  std::vector<ViewEvent> events;
  HostImage pixels;

  void keep();  // what is drawn, before it is shown

  glm::dvec2 place{0, 0};  // of the mouse as of the last event; GLFW would tell where it is by now

  static std::vector<ViewEvent>& of(GLFWwindow* w) { return static_cast<State*>(glfwGetWindowUserPointer(w))->events; }
  static glm::dvec2& mouse(GLFWwindow* w) { return static_cast<State*>(glfwGetWindowUserPointer(w))->place; }
  static void on_key(GLFWwindow* w, int code, int, int action, int modifiers) {
    if (action != GLFW_REPEAT) of(w).push_back({ViewEvent::Kind::key, code, action == GLFW_PRESS, modifiers, mouse(w)});
  }
  static void on_button(GLFWwindow* w, int code, int action, int modifiers) {
    of(w).push_back({ViewEvent::Kind::button, code, action == GLFW_PRESS, modifiers, mouse(w)});
  }
  static void on_move(GLFWwindow* w, double x, double y) {
    of(w).push_back({ViewEvent::Kind::move, 0, false, 0, mouse(w) = {x, y}});
  }
  static void on_wheel(GLFWwindow* w, double x, double y) { of(w).push_back({ViewEvent::Kind::wheel, 0, false, 0, {x, y}}); }

  ~State() {
    if (imgui) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
    }
    glfwTerminate();  // all windows with it
  }
};

void ViewWindow::State::keep() {
  Extent extent;
  glfwGetFramebufferSize(window, &extent.width, &extent.height);
  HostImage image(extent, 3);
  std::vector<std::uint8_t> bytes(image.values.size());
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadBuffer(GL_BACK);
  gl.ReadPixels(0, 0, extent.width, extent.height, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double v = bytes[image.index(x, extent.height - 1 - y, c)] / 255.0;
        image.at(x, y, c) = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
      }
    }
  }
  pixels = std::move(image);
}

ViewWindow::ViewWindow(const std::string& title, Extent extent) : state_(std::make_unique<State>()) {
  if (glfwInit() != GLFW_TRUE) throw MachineError("no display for a window: " + last_error());
  ask_for_core(3, 2);
  GLFWwindow* w = glfwCreateWindow(extent.width, extent.height, title.c_str(), nullptr, nullptr);
  if (!w) throw MachineError("no window with OpenGL 3.2: " + last_error());
  State& s = *state_;
  s.window = w;
  glfwMakeContextCurrent(w);
  glfwSwapInterval(1);
  s.gl = loaded();
  s.painter.emplace(s.gl);

  // Before ImGui's, which hand on to these.
  glfwSetWindowUserPointer(w, &s);
  glfwSetKeyCallback(w, State::on_key);
  glfwSetMouseButtonCallback(w, State::on_button);
  glfwSetCursorPosCallback(w, State::on_move);
  glfwSetScrollCallback(w, State::on_wheel);

  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // nothing is left behind
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 0;
  ImGui_ImplGlfw_InitForOpenGL(w, true);
  ImGui_ImplOpenGL3_Init("#version 150");
  s.imgui = true;
}

ViewWindow::~ViewWindow() = default;

std::vector<ViewEvent> ViewWindow::wait(double seconds) {
  state_->events.clear();
  glfwWaitEventsTimeout(seconds);
  return state_->events;
}

void ViewWindow::wake() { glfwPostEmptyEvent(); }
bool ViewWindow::closed() const { return glfwWindowShouldClose(state_->window) == GLFW_TRUE; }

Extent ViewWindow::extent() const {
  Extent e;
  glfwGetWindowSize(state_->window, &e.width, &e.height);
  return e;
}

void ViewWindow::title(const std::string& text) { glfwSetWindowTitle(state_->window, text.c_str()); }
void ViewWindow::copy(const std::string& text) { glfwSetClipboardString(state_->window, text.c_str()); }

GlHost ViewWindow::render_context() {
  State& s = *state_;
  if (!s.renders) {
    ask_for_core(4, 5);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    s.renders = glfwCreateWindow(1, 1, "", nullptr, s.window);
    if (!s.renders)
      throw MachineError("the window system has no OpenGL 4.5 core context (" + last_error() +
                         "); --gl-context auto renders in another");
  }
  const auto make_current = [w = s.renders] {
    glfwMakeContextCurrent(w);
    if (glfwGetCurrentContext() != w) throw MachineError("the window system's OpenGL 4.5 cannot be used: " + last_error());
  };
  return {make_current, [] { glfwMakeContextCurrent(nullptr); }, glfwGetProcAddress};
}

ViewPainter& ViewWindow::painter() { return *state_->painter; }

void ViewWindow::begin_frame() {
  const State& s = *state_;
  s.gl.ClearColor(0.1F, 0.1F, 0.1F, 1);
  s.gl.Clear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void ViewWindow::draw_picture(int slot, const ViewPane& pane, float exposure) {
  const State& s = *state_;
  Extent pixels;
  glfwGetFramebufferSize(s.window, &pixels.width, &pixels.height);
  const Extent size = extent();
  const glm::dvec2 scale(static_cast<double>(pixels.width) / std::max(size.width, 1),
                         static_cast<double>(pixels.height) / std::max(size.height, 1));
  const glm::ivec2 low(glm::round(scale * pane.low)), high(glm::round(scale * (pane.low + pane.size)));
  s.painter->draw(slot, {low.x, pixels.height - high.y, high.x - low.x, high.y - low.y}, exposure);
}

void ViewWindow::end_frame(bool keeps) {
  State& s = *state_;
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());  // in all of the window
  if (keeps) s.keep();
  glfwSwapBuffers(s.window);
}

const HostImage& ViewWindow::pixels() const { return state_->pixels; }

}  // namespace airlight
