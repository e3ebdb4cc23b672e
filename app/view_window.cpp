#include "app/view_window.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

// Debian's package keeps the backends beside the library.
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace airlight {

namespace {

std::string last_error;  // GLFW's callback has no place of its own

// OpenGL by GLFW, so that nothing else of the program needs its library.
struct Functions {
  decltype(&glGenTextures) gen_textures;
  decltype(&glDeleteTextures) delete_textures;
  decltype(&glBindTexture) bind_texture;
  decltype(&glTexParameteri) tex_parameter;
  decltype(&glTexImage2D) tex_image;
  decltype(&glPixelStorei) pixel_store;
  decltype(&glViewport) viewport;
  decltype(&glClearColor) clear_color;
  decltype(&glClear) clear;
  decltype(&glReadPixels) read_pixels;
  decltype(&glReadBuffer) read_buffer;
};

template <class F>
void load(F& function, const char* name) {
  function = reinterpret_cast<F>(glfwGetProcAddress(name));
  if (!function) throw MachineError(std::string("the window's OpenGL has no ") + name);
}

}  // namespace

struct ViewWindow::State {
  GLFWwindow* window = nullptr;
  bool imgui = false;
  Functions gl{};
  std::array<GLuint, 4> textures{};
  std::array<bool, 4> filled{};
  std::vector<ViewEvent> events;
  HostImage pixels;

  void keep();  // what is drawn, before it is shown

  static std::vector<ViewEvent>& of(GLFWwindow* w) { return static_cast<State*>(glfwGetWindowUserPointer(w))->events; }
  static glm::dvec2 mouse(GLFWwindow* w) {
    glm::dvec2 at;
    glfwGetCursorPos(w, &at.x, &at.y);
    return at;
  }
  static void on_key(GLFWwindow* w, int code, int, int action, int modifiers) {
    if (action != GLFW_REPEAT) of(w).push_back({ViewEvent::Kind::key, code, action == GLFW_PRESS, modifiers, mouse(w)});
  }
  static void on_button(GLFWwindow* w, int code, int action, int modifiers) {
    of(w).push_back({ViewEvent::Kind::button, code, action == GLFW_PRESS, modifiers, mouse(w)});
  }
  static void on_move(GLFWwindow* w, double x, double y) { of(w).push_back({ViewEvent::Kind::move, 0, false, 0, {x, y}}); }
  static void on_wheel(GLFWwindow* w, double x, double y) { of(w).push_back({ViewEvent::Kind::wheel, 0, false, 0, {x, y}}); }

  ~State() {
    if (imgui) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
    }
    if (window) glfwDestroyWindow(window);
    glfwTerminate();
  }
};

void ViewWindow::State::keep() {
  Extent extent;
  glfwGetFramebufferSize(window, &extent.width, &extent.height);
  HostImage image(extent, 3);
  std::vector<std::uint8_t> bytes(image.values.size());
  gl.pixel_store(GL_PACK_ALIGNMENT, 1);
  gl.read_buffer(GL_BACK);
  gl.read_pixels(0, 0, extent.width, extent.height, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
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
  glfwSetErrorCallback([](int, const char* text) { last_error = text; });
  if (glfwInit() != GLFW_TRUE) throw MachineError("no display for a window: " + last_error);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  GLFWwindow* w = glfwCreateWindow(extent.width, extent.height, title.c_str(), nullptr, nullptr);
  if (!w) throw MachineError("no window with OpenGL 3.2: " + last_error);
  State& s = *state_;
  s.window = w;
  glfwMakeContextCurrent(w);
  glfwSwapInterval(1);
  load(s.gl.gen_textures, "glGenTextures"), load(s.gl.delete_textures, "glDeleteTextures");
  load(s.gl.bind_texture, "glBindTexture"), load(s.gl.tex_parameter, "glTexParameteri");
  load(s.gl.tex_image, "glTexImage2D"), load(s.gl.pixel_store, "glPixelStorei");
  load(s.gl.viewport, "glViewport"), load(s.gl.clear_color, "glClearColor"), load(s.gl.clear, "glClear");
  load(s.gl.read_pixels, "glReadPixels"), load(s.gl.read_buffer, "glReadBuffer");

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
  s.gl.gen_textures(static_cast<GLsizei>(s.textures.size()), s.textures.data());
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

void ViewWindow::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void ViewWindow::end_frame(bool keeps) {
  State& s = *state_;
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(s.window, &width, &height);
  s.gl.viewport(0, 0, width, height);
  s.gl.clear_color(0.1F, 0.1F, 0.1F, 1);
  s.gl.clear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (keeps) s.keep();
  glfwSwapBuffers(s.window);
}

void ViewWindow::set_picture(int slot, Extent extent, const std::vector<std::uint8_t>& rgb) {
  State& s = *state_;
  const auto i = static_cast<std::size_t>(slot);
  s.gl.bind_texture(GL_TEXTURE_2D, s.textures.at(i));
  s.gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  s.gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  s.gl.pixel_store(GL_UNPACK_ALIGNMENT, 1);
  s.gl.tex_image(GL_TEXTURE_2D, 0, GL_RGB8, extent.width, extent.height, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
  s.filled.at(i) = true;
}

void* ViewWindow::picture(int slot) const {
  const auto i = static_cast<std::size_t>(slot);
  return state_->filled.at(i) ? reinterpret_cast<void*>(static_cast<std::uintptr_t>(state_->textures.at(i))) : nullptr;
}

const HostImage& ViewWindow::pixels() const { return state_->pixels; }

}  // namespace airlight
