// An OpenGL 4.5 core context without a window or a display, or the host's.
#pragma once

#include <memory>
#include <string>

#include "gpu/backend.h"
#include "gpu/functions.h"

namespace airlight {

class GlContext {
 public:
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  // Renderer, vendor, version, kind: "llvmpipe (LLVM 15.0.6, 256 bits), Mesa/X.org, OpenGL 4.5 (Core Profile) Mesa 22.3.6,
  // OSMesa"
  const std::string& describe() const { return description_; }
  // Valid while a Current of this context lives.
  const GlFunctions& gl() const { return functions_; }
  // Whether a program stands for the hardware.
  bool software() const { return software_; }

  // Makes the context current in this thread while it lives, then restores what was current before, be it of EGL or of OSMesa.
  class Current {
   public:
    explicit Current(GlContext&);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

   private:
    struct Saved;
    std::unique_ptr<Saved> saved_;
    GlContext& context_;
  };

 protected:
  GlContext() = default;
  virtual void make_current() = 0;
  virtual void release() = 0;
  using Resolve = void (*(*)(const char*))();
  // Fills the table and the description; the context must be current. Throws MachineError for OpenGL below 4.5.
  void load(Resolve, const std::string& kind);

 private:
  GlFunctions functions_;
  std::string description_;
  bool software_ = false;
};

// Throws InputError for an unknown name, MachineError naming in one line what is missing. Falls back nowhere but in `auto`.
std::unique_ptr<GlContext> make_context(const GlOptions&);

// Throws MachineError if GL has recorded an error since the last call; `what` names the work.
void check_gl(const GlFunctions&, const char* what);

// The makers behind make_context().
std::unique_ptr<GlContext> make_host_context(const GlHost&);
std::unique_ptr<GlContext> make_osmesa_context();
// hardware_only: the first device that is hardware, or null where there is none; `device` is not looked at then.
std::unique_ptr<GlContext> make_egl_context(int device, bool hardware_only);

// What was current in the calling thread; one for each library. The constructor notes it and lets it go, the destructor makes it
// current again. Nothing happens where the library is not loaded.
struct CurrentEgl {
  void *display = nullptr, *context = nullptr, *draw = nullptr, *read = nullptr;
  unsigned api = 0;
  CurrentEgl();
  ~CurrentEgl();
  CurrentEgl(const CurrentEgl&) = delete;
  CurrentEgl& operator=(const CurrentEgl&) = delete;
};
struct CurrentOsmesa {
  void *context = nullptr, *buffer = nullptr;
  int type = 0, width = 0, height = 0;
  CurrentOsmesa();
  ~CurrentOsmesa();
  CurrentOsmesa(const CurrentOsmesa&) = delete;
  CurrentOsmesa& operator=(const CurrentOsmesa&) = delete;
};

}  // namespace airlight
