#include "app/view_painter.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace airlight {

namespace {

constexpr const char* vertex_shader = R"(#version 150
void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }
)";

constexpr const char* fragment_shader = R"(#version 150
uniform sampler2DArray picture;
uniform vec2 corner, scale;  // of the rectangle; pixels of the picture by pixels of the window
uniform float gain;
out vec4 colour;

// Comparisons fail for what is no number.
float displayed(float v) { return v * gain > 0.0 ? min(v * gain, 1.0) : 0.0; }
vec3 pixel(ivec2 p, ivec2 size) {
  vec3 v = texelFetch(picture, ivec3(clamp(p, ivec2(0), size - 1), 0), 0).rgb;
  return vec3(displayed(v.r), displayed(v.g), displayed(v.b));
}
float curve(float v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1.0 / 2.4) - 0.055; }

void main() {
  ivec2 size = textureSize(picture, 0).xy;
  vec2 at = (gl_FragCoord.xy - corner) * scale;
  at = vec2(at.x, float(size.y) - at.y) - 0.5;
  ivec2 p = ivec2(floor(at));
  vec2 f = at - floor(at);
  vec3 v = pixel(p, size);
  if (f != vec2(0)) {
    vec3 lower = mix(pixel(p + ivec2(0, 1), size), pixel(p + ivec2(1, 1), size), f.x);
    v = mix(mix(v, pixel(p + ivec2(1, 0), size), f.x), lower, f.y);
  }
  colour = vec4(curve(v.r), curve(v.g), curve(v.b), 1);
}
)";

}  // namespace

ViewPainter::ViewPainter(const WindowGl& gl) : gl_(gl), program_(gl.CreateProgram()) {
  for (const auto& [kind, text] : {std::pair(GL_VERTEX_SHADER, vertex_shader), std::pair(GL_FRAGMENT_SHADER, fragment_shader)}) {
    const GLuint shader = gl_.CreateShader(static_cast<GLenum>(kind));
    gl_.ShaderSource(shader, 1, &text, nullptr);
    gl_.CompileShader(shader);
    gl_.AttachShader(program_, shader);
  }
  gl_.LinkProgram(program_);
  GLint good = 0;
  gl_.GetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good == 0) throw MachineError("the window's OpenGL does not take the shader that draws pictures");
  gain_ = gl_.GetUniformLocation(program_, "gain");
  corner_ = gl_.GetUniformLocation(program_, "corner");
  scale_ = gl_.GetUniformLocation(program_, "scale");
  gl_.GenVertexArrays(1, &array_);
  gl_.GenTextures(slots, uploaded_.data());
}

void ViewPainter::set(int slot, const HostImage& image) {
  const auto i = static_cast<std::size_t>(slot);
  gl_.BindTexture(GL_TEXTURE_2D_ARRAY, uploaded_.at(i));
  gl_.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGB32F, image.extent.width, image.extent.height, 1, 0, GL_RGB, GL_FLOAT,
                 image.values.data());
  shown_.at(i) = std::make_shared<GlTexture>(GlTexture{uploaded_.at(i), image.extent});
}

void ViewPainter::set(int slot, std::shared_ptr<GlTexture> texture) {
  shown_.at(static_cast<std::size_t>(slot)) = std::move(texture);
}

void ViewPainter::draw(int slot, const ViewRectangle& r, float exposure) const {
  GlTexture* texture = shown_.at(static_cast<std::size_t>(slot)).get();
  if (texture == nullptr) return;
  const bool shared = texture->made != nullptr;
  if (shared) gl_.WaitSync(static_cast<GLsync>(texture->made), 0, GL_TIMEOUT_IGNORED);
  gl_.Viewport(r.x, r.y, r.width, r.height);
  gl_.UseProgram(program_);
  gl_.BindVertexArray(array_);
  gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture->name);
  gl_.Uniform1f(gain_, std::exp2(exposure));
  gl_.Uniform2f(corner_, static_cast<float>(r.x), static_cast<float>(r.y));
  gl_.Uniform2f(scale_, static_cast<float>(texture->extent.width) / static_cast<float>(r.width),
                static_cast<float>(texture->extent.height) / static_cast<float>(r.height));
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  if (!shared) return;
  gl_.DeleteSync(static_cast<GLsync>(texture->read));               // null is passed over
  texture->read = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);  // showing the window flushes it
}

HostImage ViewPainter::read(int slot) const {
  const GlTexture& texture = *shown_.at(static_cast<std::size_t>(slot));
  if (texture.made != nullptr) gl_.WaitSync(static_cast<GLsync>(texture.made), 0, GL_TIMEOUT_IGNORED);
  HostImage image(texture.extent, 3);
  gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture.name);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.GetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGB, GL_FLOAT, image.values.data());
  return image;
}

}  // namespace airlight
