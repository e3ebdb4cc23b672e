#include <algorithm>
#include <array>
#include <glm/vec4.hpp>

#include "gpu/step_runner.h"

namespace airlight {

namespace {

constexpr const char* file = "gpu/surface_visibility.glsl";
constexpr std::size_t triangle_bytes = 4 * sizeof(std::uint32_t), index_bytes = 3 * sizeof(std::uint32_t);
// The screen is drawn in slabs of so many rows from the top, each by itself, also where a band of it is wanted alone: where a
// vertex is rounded to a sub-pixel must not depend on what is drawn with it.
constexpr int slab_rows = 1024;
constexpr std::size_t triangles_a_draw = 1 << 20;  // between two looks at progress

// The objects that drawing needs, for one step.
struct Target {
  const GlFunctions& gl;
  GLuint framebuffer = 0, vertices = 0;
  explicit Target(const GlFunctions& functions) : gl(functions) {
    gl.CreateFramebuffers(1, &framebuffer);
    gl.CreateVertexArrays(1, &vertices);
  }
  ~Target() {
    gl.Disable(GL_SCISSOR_TEST);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.BindVertexArray(0);
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteVertexArrays(1, &vertices);
  }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
};

// The vertices' three numbers of each triangle's four.
GLuint index_buffer(const SurfaceVisibility& a, StepRunner& r, std::size_t triangles) {
  return r.derived(a.triangles, triangles * index_bytes, [&](GLuint indices) {
    Program& program = r.compute(file, {"INDICES"});
    r.storage(0, a.triangles);
    r.gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, indices);
    program.set("items", static_cast<int>(triangles));
    r.each(program, triangles, 64);
  });
}

// The number of the nearest triangle plus one, 0 where there is none: of the slab that begins with row `top`, in these of its
// rows.
void draw(const SurfaceVisibility& a, StepRunner& r, Extent slab, int top, Rows rows, GLuint hits, const Progress& progress) {
  const GlFunctions& gl = r.gl();
  const std::size_t triangles = r.buffers.at(a.triangles).buffer->bytes() / triangle_bytes;
  const PooledTexture depth(r.pool(), {GL_DEPTH_COMPONENT32F, slab, 1});
  const Target target(gl);
  gl.NamedFramebufferTextureLayer(target.framebuffer, GL_COLOR_ATTACHMENT0, hits, 0, 0);
  gl.NamedFramebufferTextureLayer(target.framebuffer, GL_DEPTH_ATTACHMENT, depth.name(), 0, 0);
  gl.Enable(GL_SCISSOR_TEST);
  gl.Scissor(0, rows.first, slab.width, rows.count());
  const std::array<GLuint, 4> nothing{};
  const float infinitely_far = 0;
  gl.ClearNamedFramebufferuiv(target.framebuffer, GL_COLOR, 0, nothing.data());
  gl.ClearNamedFramebufferfv(target.framebuffer, GL_DEPTH, 0, &infinitely_far);
  if (triangles == 0) return;

  const GLuint indices = index_buffer(a, r, triangles);
  gl.VertexArrayVertexBuffer(target.vertices, 0, r.buffer_name(a.positions), 0, 3 * sizeof(float));
  gl.VertexArrayAttribFormat(target.vertices, 0, 3, GL_FLOAT, GL_FALSE, 0);
  gl.VertexArrayAttribBinding(target.vertices, 0, 0);
  gl.EnableVertexArrayAttrib(target.vertices, 0);
  gl.VertexArrayElementBuffer(target.vertices, indices);

  const Extent extent = a.view.extent;
  const auto width = static_cast<float>(extent.width), height = static_cast<float>(extent.height);
  // From the image's clip space to the slab's: the same where it is the image.
  const float slabs = height / static_cast<float>(slab.height);
  const float down = static_cast<float>(slab.height - extent.height + 2 * top) / static_cast<float>(slab.height);
  struct {
    glm::vec4 right, up, forward, shift;
  } const knobs{{a.view.right, height / (width * a.view.tan_half_fov)},
                {a.view.up, 1 / a.view.tan_half_fov * slabs},
                {a.view.forward, a.view.near_plane},
                {-2 * a.view.offset.x / width, 2 * a.view.offset.y / height * slabs + down, 0, 0}};
  Program& program = r.raster(file);
  r.block(knobs_binding, knobs);
  program.use();
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl.BindVertexArray(target.vertices);
  gl.Viewport(0, 0, slab.width, slab.height);
  gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);  // row 0 of the texture is the top row
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.Disable(GL_CULL_FACE);
  for (std::size_t first = 0; first < triangles; first += triangles_a_draw) {
    if (first > 0) {
      gl.Finish();
      progress.check();
    }
    program.set("first_triangle", static_cast<int>(first));
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * std::min(triangles - first, triangles_a_draw)), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(first * index_bytes));
  }
}

}  // namespace

void run(const SurfaceVisibility& a, StepRunner& r, const Progress& progress) {
  const Extent slab{a.view.extent.width, std::min(a.view.extent.height, slab_rows)};
  const PooledTexture hits(r.pool(), {GL_R32UI, slab, 1});
  Program& program = r.compute(file, {"RESOLVE", a.corners ? "WITH_CORNERS" : ""});
  for (int top = r.rows().first / slab_rows * slab_rows; top < r.rows().end; top += slab_rows) {
    const Rows rows{std::max(r.rows().first, top), std::min(r.rows().end, top + slab_rows)};
    draw(a, r, slab, top, {rows.first - top, rows.end - top}, hits.name(), progress);
    program.set("slab_row", top);
    r.gl().BindTextureUnit(0, hits.name());
    r.write(0, a.distance);
    r.write(1, a.normal);
    r.write(2, a.material);
    r.write(3, a.corners);
    r.storage(0, a.positions);
    r.storage(1, a.normals);
    r.storage(2, a.triangles);
    r.view(a.view);
    r.each_pixel(program, a.view.extent, progress, rows);
  }
}

}  // namespace airlight
