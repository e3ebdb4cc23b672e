#include "gpu/step_runner.h"

#include <algorithm>
#include <glm/vec4.hpp>
#include <stdexcept>

namespace airlight {

namespace {

constexpr int tile_width = 16, tile_height = 4;   // a work group, as in gpu/screen.glsl
constexpr std::int64_t band_pixels = 512 * 1024;  // a band takes llvmpipe less than the 0.2 s in which a stop is promised
constexpr std::size_t block_lights = 256;         // 8 KiB; GL promises 16
constexpr std::size_t groups_a_dispatch = 65535;  // what GL promises

struct LightBlock {
  glm::ivec4 count;
  glm::vec4 lights[2 * block_lights];
};

}  // namespace

StepRunner::StepRunner(GlContext& context) : gl_(context.gl()), pool_(gl_) {}

StepRunner::~StepRunner() = default;

Program& StepRunner::compute(const char* file, const std::vector<std::string>& defines) {
  std::string key = file;
  std::vector<std::string> given;
  for (const std::string& define : defines) {
    if (define.empty()) continue;
    key += " " + define;
    given.push_back(define);
  }
  std::unique_ptr<Program>& program = programs_[key];
  if (!program) program = std::make_unique<Program>(gl_, Program::Stages{{GL_COMPUTE_SHADER, shader_text(file, given)}});
  return *program;
}

Program& StepRunner::raster(const char* file) {
  std::unique_ptr<Program>& program = programs_[std::string("raster ") + file];
  if (!program) {
    program = std::make_unique<Program>(gl_, Program::Stages{{GL_VERTEX_SHADER, shader_text(file, {"VERTEX"})},
                                                             {GL_FRAGMENT_SHADER, shader_text(file, {"FRAGMENT"})}});
  }
  return *program;
}

const Texture& StepRunner::texture(const Image& image) const {
  const auto held = images.find(image);
  if (held == images.end() || !held->second.texture)
    throw std::logic_error("a step reads an image that was neither made nor uploaded");
  if (!(within(held->second.rows, image.extent.height) == held_rows(image.extent)))
    throw std::logic_error("a step reads an image of other rows than it makes");
  return *held->second.texture;
}

void StepRunner::read(GLuint unit, const Image& image) { gl_.BindTextureUnit(unit, texture(image).name()); }

void StepRunner::write(GLuint unit, const Image& image) { bind_image(unit, image, GL_WRITE_ONLY); }
void StepRunner::read_write(GLuint unit, const Image& image) { bind_image(unit, image, GL_READ_WRITE); }

void StepRunner::bind_image(GLuint unit, const Image& image, GLenum access) {
  if (!image) return;
  const Texture& t = texture(image);
  gl_.BindImageTexture(unit, t.name(), 0, GL_TRUE, 0, access, t.shape().format);
}

GLuint StepRunner::buffer_name(const Buffer& buffer) const {
  const auto held = buffers.find(buffer);
  if (held == buffers.end()) throw std::logic_error("a step reads a buffer that was not uploaded");
  return held->second.buffer->name();
}

void StepRunner::storage(GLuint binding, const Buffer& buffer) {
  gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer_name(buffer));
}

void StepRunner::storage(GLuint binding, std::span<const std::byte> bytes) {
  fill(binding, bytes);
  bind(binding, binding);
}

void StepRunner::fill(GLuint number, std::span<const std::byte> bytes) {
  small_.try_emplace(number, gl_).first->second.fill(bytes.size(), bytes.data());
}

void StepRunner::bind(GLuint binding, GLuint number) {
  gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, small_.at(number).name());
}

std::vector<std::byte> StepRunner::content(const Buffer& buffer) const {
  const auto held = buffers.find(buffer);
  if (held == buffers.end()) throw std::logic_error("a step reads a buffer that was not uploaded");
  std::vector<std::byte> bytes(held->second.buffer->bytes());
  gl_.GetNamedBufferSubData(held->second.buffer->name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
  return bytes;
}

void StepRunner::reserve(GLuint number, std::size_t bytes) {
  GlBuffer& buffer = small_.try_emplace(number, gl_).first->second;
  if (buffer.bytes() < bytes) buffer.fill(bytes, nullptr);
}

void StepRunner::read_storage(GLuint number, std::span<std::byte> bytes) {
  gl_.GetNamedBufferSubData(small_.at(number).name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void StepRunner::write_storage(GLuint number, std::size_t at, std::span<const std::byte> bytes) {
  gl_.NamedBufferSubData(small_.at(number).name(), static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes.size()),
                         bytes.data());
}

void StepRunner::copy(GLuint from, GLuint number, std::size_t at, std::size_t bytes) {
  gl_.CopyNamedBufferSubData(from, small_.at(number).name(), 0, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes));
}

void StepRunner::copy_back(GLuint number, GLuint to, std::size_t bytes) {
  gl_.CopyNamedBufferSubData(small_.at(number).name(), to, 0, 0, static_cast<GLsizeiptr>(bytes));
}

std::size_t StepRunner::storage_limit() const {
  GLint64 bytes = 0;
  gl_.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  return static_cast<std::size_t>(std::max<GLint64>(bytes, 1 << 24));  // GL promises 2^24
}

void StepRunner::block_bytes(GLuint binding, std::span<const std::byte> bytes) {
  GlBuffer& buffer = blocks_.try_emplace(binding, gl_).first->second;
  buffer.fill(bytes.size(), bytes.data());
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, binding, buffer.name());
}

void StepRunner::begin_run(std::span<const Step> steps, std::span<const StepRows> rows) {
  held_.clear();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const Image& image : outputs_of(steps[i].what)) held_[{image.extent.width, image.extent.height}] = rows[i].held;
  }
}

Rows StepRunner::held_rows(Extent extent) const {
  const auto found = held_.find({extent.width, extent.height});
  return within(found == held_.end() ? Rows{} : found->second, extent.height);
}

void StepRunner::view(const View& v) {
  const Rows held = held_rows(v.extent);
  struct {
    glm::vec4 right, up, forward, offset;
  } const values{{v.right, v.extent.width},
                 {v.up, v.extent.height},
                 {v.forward, v.tan_half_fov},
                 {v.offset, held.first, rows_.end - held.first}};
  block(view_binding, values);
}

std::string StepRunner::lights(std::span<const Light> lights) {
  std::vector<glm::vec4> values;
  for (const Light& l : lights) {
    values.emplace_back(l.vector, l.radius);
    values.emplace_back(l.power, l.directional ? 1.0F : 0.0F);
  }
  LightBlock few{};
  few.count.x = static_cast<int>(lights.size());
  if (lights.size() <= block_lights) std::copy(values.begin(), values.end(), few.lights);
  block(lights_binding, few);
  if (lights.size() <= block_lights) return "MOST_LIGHTS " + std::to_string(block_lights);
  storage(many_lights_binding, std::as_bytes(std::span(values)));
  return "MANY_LIGHTS";
}

GLuint StepRunner::derived(const Buffer& from, std::size_t bytes, const std::function<void(GLuint)>& make) {
  const auto source = buffers.find(from);
  if (source == buffers.end()) throw std::logic_error("a step reads a buffer that was not uploaded");
  HeldStorage& made = derived_[from];
  if (made.key == source->second.key && made.buffer && made.buffer->bytes() == bytes) return made.buffer->name();
  if (!made.buffer) made.buffer = std::make_unique<GlBuffer>(gl_);
  made.key = 0;
  made.buffer->fill(bytes, nullptr);
  make(made.buffer->name());
  made.key = source->second.key;
  return made.buffer->name();
}

void StepRunner::each_pixel(Program& program, Extent extent, const Progress& progress, Rows part) {
  program.use();
  const std::int64_t rows_a_band = std::max<std::int64_t>(band_pixels / extent.width / tile_height, 1) * tile_height;
  const auto columns = static_cast<GLuint>((extent.width + tile_width - 1) / tile_width);
  const int held = held_rows(extent).first, begin = std::max(rows_.first, part.first) - held;
  const int end = std::min(rows_.end, part.end) - held;
  for (std::int64_t first = begin; first < end; first += rows_a_band) {
    if (first > begin) {
      gl_.Finish();
      progress.check();
    }
    const std::int64_t rows = std::min(rows_a_band, end - first);
    program.set("first_row", static_cast<int>(first));
    gl_.DispatchCompute(columns, static_cast<GLuint>((rows + tile_height - 1) / tile_height), 1);
  }
  gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void StepRunner::each(Program& program, std::size_t items, std::size_t group) {
  program.use();
  const std::size_t groups = (items + group - 1) / group;
  for (std::size_t first = 0; first < groups; first += groups_a_dispatch) {
    program.set("first_item", static_cast<int>(first * group));
    gl_.DispatchCompute(static_cast<GLuint>(std::min(groups - first, groups_a_dispatch)), 1, 1);
  }
  gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace airlight
