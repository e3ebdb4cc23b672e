// Draws linear pictures in the window, by a shader that does what tone_mapped() does (common/scene/tonemap.h): exposure,
// clipping, the sRGB curve. One kind of picture for all: a texture, be it uploaded or a renderer's own.
#pragma once

#include <array>
#include <memory>

#include "app/airlight.h"
#include "app/view_gl.h"

namespace airlight {

// A rectangle of the window's framebuffer [pixel], from its lower left corner.
struct ViewRectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

// Everything in the thread of the window, its context current.
class ViewPainter {
 public:
  static constexpr int slots = 4;

  // Throws MachineError where the window's OpenGL does not take the shader.
  explicit ViewPainter(const WindowGl&);
  // What a slot shows from now on: three floats a pixel; a texture of the share group.
  void set(int slot, const HostImage&);
  void set(int slot, std::shared_ptr<GlTexture>);
  // Larger or smaller than it is: linear between the centres of its pixels. Nothing where there is none.
  void draw(int slot, const ViewRectangle&, float exposure) const;
  // Of a slot that shows something.
  HostImage read(int slot) const;

 private:
  const WindowGl& gl_;
  GLuint program_ = 0, array_ = 0;
  GLint gain_ = 0, corner_ = 0, scale_ = 0;
  std::array<std::shared_ptr<GlTexture>, slots> shown_;
  std::array<GLuint, slots> uploaded_{};
};

}  // namespace airlight
