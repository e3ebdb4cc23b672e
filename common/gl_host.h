// What a program that draws by OpenGL itself and a renderer of backend gl share: contexts, and textures that are drawn where they
// were made.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/image.h"

namespace airlight {

// An OpenGL 4.5 core context of the caller's, for one renderer and nobody else. What the renderer makes in it is there in all
// contexts that share objects with it.
struct GlHost {
  // Called at the beginning and at the end of each call of the renderer, in the thread of that call.
  std::function<void()> make_current, release;
  void (*(*resolve)(const char* name))() = nullptr;  // entry points of OpenGL
};

// A texture that a renderer has handed over: it is not written to as long as this lives, and it lives as long as the renderer.
struct GlTexture {
  unsigned name = 0;  // GL_TEXTURE_2D_ARRAY of one layer; linear floats, the upper row first
  Extent extent;
  void* made = nullptr;  // GLsync, the renderer's: glWaitSync() for it, then bind the texture
  void* read = nullptr;  // GLsync, the reader's, flushed: after what it drew last. The renderer deletes it in the end; null: it
                         // drew nothing
};

struct NamedTexture {
  std::string name;
  std::shared_ptr<GlTexture> texture;
};

}  // namespace airlight
