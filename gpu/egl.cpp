// EGL: hardware devices by enumeration, or Mesa's surfaceless platform.
#include <dlfcn.h>

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string_view>
#include <vector>

#include "common/error.h"
#include "gpu/context.h"

namespace airlight {

namespace {

// Never closed again, and no display is terminated: both are shared with everyone else in the process.
void* library(int flags) { return dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL | flags); }

struct Egl {
  PFNEGLGETPROCADDRESSPROC resolve = nullptr;
  PFNEGLQUERYSTRINGPROC query_string = nullptr;
  PFNEGLGETERRORPROC error = nullptr;
  PFNEGLINITIALIZEPROC initialize = nullptr;
  PFNEGLBINDAPIPROC bind_api = nullptr;
  PFNEGLQUERYAPIPROC query_api = nullptr;
  PFNEGLCHOOSECONFIGPROC choose_config = nullptr;
  PFNEGLCREATECONTEXTPROC create_context = nullptr;
  PFNEGLDESTROYCONTEXTPROC destroy_context = nullptr;
  PFNEGLMAKECURRENTPROC make_current = nullptr;
  PFNEGLGETCURRENTCONTEXTPROC current_context = nullptr;
  PFNEGLGETCURRENTDISPLAYPROC current_display = nullptr;
  PFNEGLGETCURRENTSURFACEPROC current_surface = nullptr;
};

template <class F>
void symbol(void* from, const char* name, F& f) {
  f = reinterpret_cast<F>(dlsym(from, name));
  if (f == nullptr) throw MachineError(std::string("EGL: libEGL.so.1 has no ") + name);
}

Egl entries(void* from) {
  Egl e;
  symbol(from, "eglGetProcAddress", e.resolve);
  symbol(from, "eglQueryString", e.query_string);
  symbol(from, "eglGetError", e.error);
  symbol(from, "eglInitialize", e.initialize);
  symbol(from, "eglBindAPI", e.bind_api);
  symbol(from, "eglQueryAPI", e.query_api);
  symbol(from, "eglChooseConfig", e.choose_config);
  symbol(from, "eglCreateContext", e.create_context);
  symbol(from, "eglDestroyContext", e.destroy_context);
  symbol(from, "eglMakeCurrent", e.make_current);
  symbol(from, "eglGetCurrentContext", e.current_context);
  symbol(from, "eglGetCurrentDisplay", e.current_display);
  symbol(from, "eglGetCurrentSurface", e.current_surface);
  return e;
}

bool has(const char* extensions, std::string_view name) {
  std::string_view rest = extensions != nullptr ? extensions : "";
  while (!rest.empty()) {
    const std::size_t end = rest.find(' ');
    if (rest.substr(0, end) == name) return true;
    if (end == std::string_view::npos) return false;
    rest.remove_prefix(end + 1);
  }
  return false;
}

template <class F>
F extension(const Egl& e, const char* name) {
  auto* found = reinterpret_cast<F>(e.resolve(name));
  if (found == nullptr) throw MachineError(std::string("EGL: there is no ") + name);
  return found;
}

class EglContext final : public GlContext {
 public:
  EglContext(const Egl& e, EGLDisplay display, const std::string& kind) : egl_(e), display_(display) {
    if (display == EGL_NO_DISPLAY || egl_.initialize(display, nullptr, nullptr) == EGL_FALSE) fail(kind, "no display");
    const char* extensions = egl_.query_string(display, EGL_EXTENSIONS);
    if (!has(extensions, "EGL_KHR_surfaceless_context")) fail(kind, "no EGL_KHR_surfaceless_context");
    const unsigned callers_api = egl_.query_api();
    if (egl_.bind_api(EGL_OPENGL_API) == EGL_FALSE) fail(kind, "no OpenGL");
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!has(extensions, "EGL_KHR_no_config_context")) {
      const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
      EGLint found = 0;
      if (egl_.choose_config(display, wanted, &config, 1, &found) == EGL_FALSE || found == 0)
        fail(kind, "no configuration for OpenGL");
    }
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = egl_.create_context(display, config, EGL_NO_CONTEXT, attributes);
    egl_.bind_api(callers_api);
    if (context_ == EGL_NO_CONTEXT) fail(kind, "no OpenGL 4.5 core context");
    try {
      const Current current(*this);
      load(egl_.resolve, kind);
    } catch (...) {
      egl_.destroy_context(display_, context_);
      throw;
    }
  }
  ~EglContext() override { egl_.destroy_context(display_, context_); }

 protected:
  void make_current() override {
    egl_.bind_api(EGL_OPENGL_API);
    if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      fail("EGL", "the context cannot be made current");
    }
  }
  void release() override { egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

 private:
  [[noreturn]] void fail(const std::string& kind, const char* what) const {
    throw MachineError(kind + ": " + what + " (EGL error " + std::to_string(egl_.error()) + ")");
  }

  Egl egl_;
  EGLDisplay display_;
  ::EGLContext context_ = EGL_NO_CONTEXT;
};

// Every device with its extensions; empty where devices cannot be enumerated.
struct Device {
  EGLDeviceEXT device;
  bool software;
};
std::vector<Device> devices(const Egl& e) {
  const char* client = e.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool enumerates = has(client, "EGL_EXT_device_enumeration") || has(client, "EGL_EXT_device_base");
  if (!enumerates || !has(client, "EGL_EXT_platform_device")) return {};
  const auto query_devices = extension<PFNEGLQUERYDEVICESEXTPROC>(e, "eglQueryDevicesEXT");
  const auto query_string = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>(e, "eglQueryDeviceStringEXT");
  EGLint n = 0;
  if (query_devices(0, nullptr, &n) == EGL_FALSE || n <= 0) return {};
  std::vector<EGLDeviceEXT> found(static_cast<std::size_t>(n));
  query_devices(n, found.data(), &n);
  std::vector<Device> result;
  for (int i = 0; i < n; ++i) {
    EGLDeviceEXT device = found[static_cast<std::size_t>(i)];
    result.push_back({device, has(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")});
  }
  return result;
}

}  // namespace

std::unique_ptr<GlContext> make_egl_context(int device, bool hardware_only) {
  void* from = library(0);
  if (from == nullptr) {
    if (hardware_only) return nullptr;
    throw MachineError("EGL: libEGL.so.1 is not there (Debian package libegl1)");
  }
  const Egl e = entries(from);
  const auto display = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>(e, "eglGetPlatformDisplayEXT");
  const std::vector<Device> all = devices(e);
  if (hardware_only) {
    // A device of which no context can be had (a display controller, no access) is no reason to fail: the next one may do.
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].software) continue;
      try {
        auto context = std::make_unique<EglContext>(e, display(EGL_PLATFORM_DEVICE_EXT, all[i].device, nullptr),
                                                    "EGL device " + std::to_string(i));
        if (!context->software()) return context;
      } catch (const MachineError&) {
      }
    }
    return nullptr;
  }
  const std::size_t known = all.empty() ? 1 : all.size();
  if (device < 0 || static_cast<std::size_t>(device) >= known) {
    throw MachineError("EGL: there is no device " + std::to_string(device) + "; devices are numbered 0 to " +
                       std::to_string(known - 1));
  }
  if (!all.empty()) {
    return std::make_unique<EglContext>(e,
                                        display(EGL_PLATFORM_DEVICE_EXT, all[static_cast<std::size_t>(device)].device, nullptr),
                                        "EGL device " + std::to_string(device));
  }
  if (!has(e.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless")) {
    throw MachineError("EGL: neither devices (EGL_EXT_platform_device) nor EGL_MESA_platform_surfaceless");
  }
  return std::make_unique<EglContext>(e, display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "EGL surfaceless");
}

CurrentEgl::CurrentEgl() {
  void* from = library(RTLD_NOLOAD);
  if (from == nullptr) return;
  const Egl e = entries(from);
  dlclose(from);  // takes back this reference only
  api = e.query_api();
  display = e.current_display();
  context = e.current_context();
  draw = e.current_surface(EGL_DRAW);
  read = e.current_surface(EGL_READ);
  if (context != EGL_NO_CONTEXT) e.make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

CurrentEgl::~CurrentEgl() {
  if (api == 0) return;
  void* from = library(RTLD_NOLOAD);
  const Egl e = entries(from);
  dlclose(from);
  e.bind_api(api);
  if (context != EGL_NO_CONTEXT) e.make_current(display, draw, read, context);
}

}  // namespace airlight
