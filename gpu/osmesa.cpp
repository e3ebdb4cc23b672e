// OSMesa: Mesa's off-screen software renderer.
#include <dlfcn.h>

#include <array>

#include "common/error.h"
#include "gpu/context.h"

namespace airlight {

namespace {

// From GL/osmesa.h, which cannot be included beside glcorearb.h.
constexpr int osmesa_format = 0x22, osmesa_type = 0x23, osmesa_profile = 0x33, osmesa_core_profile = 0x34;
constexpr int osmesa_major_version = 0x36, osmesa_minor_version = 0x37;
constexpr int osmesa_rgba = 0x1908;

struct Osmesa {
  void* (*create)(const int*, void*) = nullptr;
  void (*destroy)(void*) = nullptr;
  unsigned char (*make_current)(void*, void*, unsigned, int, int) = nullptr;
  void* (*current)() = nullptr;
  void (*integer)(int, int*) = nullptr;
  unsigned char (*color_buffer)(void*, int*, int*, int*, void**) = nullptr;
  void (*(*resolve)(const char*))() = nullptr;
};

// Never closed again: Mesa and LLVM keep threads and exit handlers of their own.
void* library(int flags) {
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
    if (void* found = dlopen(name, RTLD_LAZY | RTLD_LOCAL | flags)) return found;
  }
  return nullptr;
}

template <class F>
void symbol(void* from, const char* name, F& f) {
  f = reinterpret_cast<F>(dlsym(from, name));
  if (f == nullptr) throw MachineError(std::string("OSMesa: the library has no ") + name);
}

Osmesa entries(void* from) {
  Osmesa o;
  symbol(from, "OSMesaCreateContextAttribs", o.create);
  symbol(from, "OSMesaDestroyContext", o.destroy);
  symbol(from, "OSMesaMakeCurrent", o.make_current);
  symbol(from, "OSMesaGetCurrentContext", o.current);
  symbol(from, "OSMesaGetIntegerv", o.integer);
  symbol(from, "OSMesaGetColorBuffer", o.color_buffer);
  symbol(from, "OSMesaGetProcAddress", o.resolve);
  return o;
}

class OsmesaContext final : public GlContext {
 public:
  explicit OsmesaContext(const Osmesa& o) : osmesa_(o) {
    const int attributes[] = {
        osmesa_format, osmesa_rgba, osmesa_profile, osmesa_core_profile, osmesa_major_version, 4, osmesa_minor_version, 5, 0};
    context_ = osmesa_.create(attributes, nullptr);
    if (context_ == nullptr) throw MachineError("OSMesa: the library gives no OpenGL 4.5 core context");
    try {
      const Current current(*this);
      load(osmesa_.resolve, "OSMesa");
    } catch (...) {
      osmesa_.destroy(context_);
      throw;
    }
  }
  ~OsmesaContext() override { osmesa_.destroy(context_); }

 protected:
  void make_current() override {
    if (osmesa_.make_current(context_, pixels_.data(), GL_UNSIGNED_BYTE, side, side) == 0) {
      throw MachineError("OSMesa: the context cannot be made current");
    }
  }
  void release() override { osmesa_.make_current(nullptr, nullptr, 0, 0, 0); }

 private:
  static constexpr int side = 4;  // its own window, never drawn to
  Osmesa osmesa_;
  void* context_ = nullptr;
  alignas(16) std::array<unsigned char, 4 * side * side> pixels_{};
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context() {
  void* from = library(0);
  if (from == nullptr) throw MachineError("OSMesa: libOSMesa.so.8 is not there (Debian package libosmesa6)");
  return std::make_unique<OsmesaContext>(entries(from));
}

CurrentOsmesa::CurrentOsmesa() {
  void* from = library(RTLD_NOLOAD);
  if (from == nullptr) return;
  const Osmesa o = entries(from);
  dlclose(from);  // takes back this reference only
  context = o.current();
  if (context == nullptr) return;
  int format = 0;
  o.color_buffer(context, &width, &height, &format, &buffer);
  o.integer(osmesa_type, &type);
  o.make_current(nullptr, nullptr, 0, 0, 0);
}

CurrentOsmesa::~CurrentOsmesa() {
  if (context == nullptr) return;
  void* from = library(RTLD_NOLOAD);
  entries(from).make_current(context, buffer, static_cast<unsigned>(type), width, height);
  dlclose(from);
}

}  // namespace airlight
