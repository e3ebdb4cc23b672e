#include "gpu/context.h"

#include <cstring>

#include "common/error.h"

namespace airlight {

// In this order: Mesa's libraries share one slot for the current context, so OSMesa must not be asked while EGL's context is in
// it.
struct GlContext::Current::Saved {
  CurrentEgl egl;
  CurrentOsmesa osmesa;
};

GlContext::Current::Current(GlContext& context) : saved_(std::make_unique<Saved>()), context_(context) {
  context_.make_current();
}

GlContext::Current::~Current() { context_.release(); }

void GlContext::load(Resolve resolve, const std::string& kind) {
  const auto entry = [&](const char* name) {
    auto* found = resolve(name);
    if (found == nullptr) throw MachineError(kind + ": this OpenGL has no " + name);
    return found;
  };
#define AIRLIGHT_GL_LOAD(name, NAME) functions_.name = reinterpret_cast<PFNGL##NAME##PROC>(entry("gl" #name));
  AIRLIGHT_GL_FUNCTIONS(AIRLIGHT_GL_LOAD)
#undef AIRLIGHT_GL_LOAD
  GLint major = 0, minor = 0;
  functions_.GetIntegerv(GL_MAJOR_VERSION, &major);
  functions_.GetIntegerv(GL_MINOR_VERSION, &minor);
  const std::string version = std::to_string(major) + "." + std::to_string(minor);
  if (major < 4 || (major == 4 && minor < 5)) throw MachineError(kind + ": OpenGL 4.5 is needed, this is " + version);
  const auto told = [&](GLenum what) {
    const auto* text = reinterpret_cast<const char*>(functions_.GetString(what));
    return std::string(text != nullptr ? text : "unknown");
  };
  const std::string renderer = told(GL_RENDERER);
  for (const char* program : {"llvmpipe", "softpipe", "swrast", "SWR"}) {
    software_ = software_ || renderer.find(program) != std::string::npos;
  }
  description_ = renderer + ", " + told(GL_VENDOR) + ", OpenGL " + told(GL_VERSION) + ", " + kind;
}

namespace {

class HostContext final : public GlContext {
 public:
  explicit HostContext(const GlHost& host) : host_(host) {
    const Current current(*this);
    load(host_.resolve, "shared");
  }

 protected:
  void make_current() override { host_.make_current(); }
  void release() override { host_.release(); }

 private:
  GlHost host_;
};

}  // namespace

std::unique_ptr<GlContext> make_host_context(const GlHost& host) { return std::make_unique<HostContext>(host); }

std::unique_ptr<GlContext> make_context(const GlOptions& options) {
  if (options.host) return make_host_context(*options.host);
  if (options.context == "osmesa") {
    if (options.device != 0)
      throw MachineError("OSMesa has one device, number 0; device " + std::to_string(options.device) + " was asked for");
    return make_osmesa_context();
  }
  if (options.context == "egl") return make_egl_context(options.device, false);
  if (options.context != "auto") throw InputError("unknown GL context \"" + options.context + "\", expected auto, osmesa or egl");
  if (options.device != 0) return make_egl_context(options.device, false);
  if (auto hardware = make_egl_context(0, true)) return hardware;
  return make_osmesa_context();
}

void check_gl(const GlFunctions& gl, const char* what) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return;
  for (int i = 0; i < 8 && gl.GetError() != GL_NO_ERROR; ++i) {
  }
  if (error == GL_OUT_OF_MEMORY) throw MachineError(std::string(what) + ": OpenGL is out of memory");
  if (error == GL_CONTEXT_LOST) throw MachineError(std::string(what) + ": OpenGL's context is lost");
  throw MachineError(std::string(what) + ": OpenGL error " + std::to_string(error));
}

}  // namespace airlight
