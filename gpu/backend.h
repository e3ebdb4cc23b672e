// The OpenGL 4.5 backend: compute shaders on texture arrays, and the rasteriser.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/backend.h"

namespace airlight {

struct GlOptions {
  std::string context = "auto";     // auto | osmesa | egl. auto: EGL on the first hardware device where there is one, else OSMesa
  int device = 0;                   // which EGL device, in the order of its enumeration; other than 0 means EGL for auto
  std::optional<GlHost> host = {};  // in place of both
};

// Throws InputError for an unknown name, MachineError naming in one line what the machine lacks. Falls back nowhere but in
// `auto`. The backend makes its own context current in each call and restores the caller's afterwards; it may move between
// threads.
std::unique_ptr<Backend> make_gl_backend(const GlOptions&);

}  // namespace airlight
