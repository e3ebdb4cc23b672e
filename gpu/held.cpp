#include "gpu/held.h"

#include <algorithm>
#include <stdexcept>

#include "common/error.h"
#include "gpu/context.h"

namespace airlight {

TextureShape shape_of(const Image& image, Rows rows) {
  return {static_cast<GLenum>(image.format == Format::r32f ? GL_R32F : GL_RGBA32F),
          {image.extent.width, within(rows, image.extent.height).count()},
          image.layers};
}

Texture::Texture(const GlFunctions& gl, const TextureShape& shape) : gl_(gl), shape_(shape) {
  GLint most_pixels = 0, most_layers = 0;
  gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most_pixels);
  gl_.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most_layers);
  if (shape.extent.width > most_pixels || shape.extent.height > most_pixels) {
    throw MachineError("this OpenGL holds images of at most " + std::to_string(most_pixels) + " pixels a side, not " +
                       std::to_string(shape.extent.width) + " x " + std::to_string(shape.extent.height));
  }
  if (shape.layers > most_layers) {
    throw MachineError("this OpenGL holds at most " + std::to_string(most_layers) + " layers (lights) an image, not " +
                       std::to_string(shape.layers));
  }
  gl_.CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name_);
  gl_.TextureStorage3D(name_, 1, shape.format, shape.extent.width, shape.extent.height, std::max(shape.layers, 1));
  gl_.TextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);  // integer and depth textures can be read in no other way
  gl_.TextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  try {
    check_gl(gl_, "an image");
  } catch (...) {
    gl_.DeleteTextures(1, &name_);
    throw;
  }
}

std::size_t bytes_of(const TextureShape& shape) {
  const std::size_t pixel = shape.format == GL_RGBA32F ? 4 * sizeof(float) : sizeof(float);  // all others have 32 bits
  return pixel * static_cast<std::size_t>(shape.extent.width) * static_cast<std::size_t>(shape.extent.height) *
         static_cast<std::size_t>(std::max(shape.layers, 1));
}

Texture::~Texture() { gl_.DeleteTextures(1, &name_); }

std::unique_ptr<Texture> TexturePool::take(const TextureShape& shape) {
  const auto found = std::find_if(free_.begin(), free_.end(), [&](const Free& f) { return f.texture->shape() == shape; });
  if (found == free_.end()) {
    auto made = std::make_unique<Texture>(gl_, shape);
    ++made_;
    return made;
  }
  std::unique_ptr<Texture> texture = std::move(found->texture);
  free_.erase(found);
  return texture;
}

void TexturePool::give(std::unique_ptr<Texture> texture) {
  if (texture) free_.push_back({std::move(texture), true});
}

std::size_t TexturePool::bytes() const {
  std::size_t sum = 0;
  for (const Free& f : free_) sum += bytes_of(f.texture->shape());
  return sum;
}

void TexturePool::trim() {
  std::erase_if(free_, [](const Free& f) { return !f.fresh; });
  for (Free& f : free_) f.fresh = false;
}

TakenTextures::~TakenTextures() { come_back(); }

std::shared_ptr<GlTexture> TakenTextures::take(std::unique_ptr<Texture> texture) {
  auto handed = std::make_unique<GlTexture>();
  handed->name = texture->name(), handed->extent = texture->shape().extent;
  taken_.push_back(std::move(texture));
  handed->made = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl_.Flush();  // without it, who waits for the fence may wait for ever
  return {handed.release(), [back = back_](GlTexture* t) {
            const std::lock_guard lock(back->mutex);
            back->textures.push_back(*t);
            delete t;
          }};
}

std::vector<std::unique_ptr<Texture>> TakenTextures::come_back() {
  std::vector<GlTexture> back;
  {
    const std::lock_guard lock(back_->mutex);
    back.swap(back_->textures);
  }
  std::vector<std::unique_ptr<Texture>> free;
  for (const GlTexture& t : back) {
    if (t.read != nullptr) gl_.WaitSync(static_cast<GLsync>(t.read), 0, GL_TIMEOUT_IGNORED);
    for (void* fence : {t.made, t.read}) gl_.DeleteSync(static_cast<GLsync>(fence));
    const auto found = std::find_if(taken_.begin(), taken_.end(), [&](const auto& mine) { return mine->name() == t.name; });
    free.push_back(std::move(*found));
    taken_.erase(found);
  }
  return free;
}

std::size_t TakenTextures::bytes() const {
  std::size_t sum = 0;
  for (const auto& texture : taken_) sum += bytes_of(texture->shape());
  return sum;
}

GlBuffer::GlBuffer(const GlFunctions& gl) : gl_(gl) { gl_.CreateBuffers(1, &name_); }

GlBuffer::~GlBuffer() { gl_.DeleteBuffers(1, &name_); }

void GlBuffer::fill(std::size_t bytes, const void* data) {
  const std::size_t needed = std::max<std::size_t>(bytes, 16);  // GL binds no empty buffer
  if (needed != allocated_) {
    GLint64 most = 0;
    gl_.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (needed > static_cast<std::size_t>(most)) {
      throw MachineError("this OpenGL holds buffers of at most " + std::to_string(most) + " bytes, not " +
                         std::to_string(needed));
    }
    allocated_ = bytes_ = 0;
    gl_.NamedBufferData(name_, static_cast<GLsizeiptr>(needed), nullptr, GL_DYNAMIC_DRAW);
    check_gl(gl_, "a buffer");
    allocated_ = needed;
  }
  if (data != nullptr && bytes > 0) gl_.NamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(bytes), data);
  bytes_ = bytes;
}

namespace {

GLenum host_format(const Image& image) { return image.format == Format::r32f ? GL_RED : GL_RGB; }

}  // namespace

void write_texture(const GlFunctions& gl, const Texture& texture, const Image& image, std::span<const float> values) {
  if (values.size() != image.floats()) throw std::logic_error("image upload: wrong number of floats");
  gl.TextureSubImage3D(texture.name(), 0, 0, 0, 0, image.extent.width, image.extent.height, image.layers, host_format(image),
                       GL_FLOAT, values.data());
  check_gl(gl, "image upload");
}

void read_texture(const GlFunctions& gl, const Texture& texture, const Image& image, Rows rows, std::span<float> values) {
  Image wanted = image;
  wanted.extent.height = rows.count();
  if (rows.end > texture.shape().extent.height || values.size() != wanted.floats())
    throw std::logic_error("image download: wrong number of floats");
  // A layer at a time: GL takes the size of what it may write as an int.
  const std::size_t layer_floats = values.size() / static_cast<std::size_t>(image.layers);
  for (int layer = 0; layer < image.layers; ++layer) {
    const std::span<float> part = values.subspan(static_cast<std::size_t>(layer) * layer_floats, layer_floats);
    gl.GetTextureSubImage(texture.name(), 0, 0, rows.first, layer, image.extent.width, rows.count(), 1, host_format(image),
                          GL_FLOAT, static_cast<GLsizei>(std::min<std::size_t>(part.size_bytes(), 0x7fffffff)), part.data());
  }
  check_gl(gl, "image download");
}

}  // namespace airlight
