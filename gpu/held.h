// What the GL backend holds between and during runs: textures, a pool of them, and buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/gl_host.h"
#include "common/image.h"
#include "common/rows.h"
#include "gpu/functions.h"

namespace airlight {

// What a texture looks like to GL: two of the same shape are interchangeable. rgb32f is held as GL_RGBA32F.
struct TextureShape {
  GLenum format = 0;
  Extent extent;
  int layers = 1;
  friend bool operator==(const TextureShape&, const TextureShape&) = default;
};
// Of a texture for these rows of the image.
TextureShape shape_of(const Image&, Rows);
std::size_t bytes_of(const TextureShape&);

// A two-dimensional texture array with one mipmap level.
class Texture {
 public:
  Texture(const GlFunctions&, const TextureShape&);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;
  const TextureShape& shape() const { return shape_; }
  GLuint name() const { return name_; }

 private:
  const GlFunctions& gl_;
  TextureShape shape_;
  GLuint name_ = 0;
};

// Textures whose content is no longer needed, for the next of the same shape: warm frames allocate nothing.
class TexturePool {
 public:
  explicit TexturePool(const GlFunctions& gl) : gl_(gl) {}
  // Throws MachineError where it is larger than this OpenGL can hold.
  std::unique_ptr<Texture> take(const TextureShape&);
  void give(std::unique_ptr<Texture>);
  // Frees what has not been taken since the last call.
  void trim();
  std::size_t bytes() const;          // of those that wait
  int made() const { return made_; }  // how many textures were ever allocated

 private:
  struct Free {
    std::unique_ptr<Texture> texture;
    bool fresh;  // given since the last trim()
  };
  const GlFunctions& gl_;
  std::vector<Free> free_;
  int made_ = 0;
};

// A texture out of the pool for as long as this lives.
class PooledTexture {
 public:
  PooledTexture(TexturePool& pool, const TextureShape& shape) : pool_(pool), texture_(pool.take(shape)) {}
  ~PooledTexture() { pool_.give(std::move(texture_)); }
  PooledTexture(const PooledTexture&) = delete;
  PooledTexture& operator=(const PooledTexture&) = delete;
  GLuint name() const { return texture_->name(); }

 private:
  TexturePool& pool_;
  std::unique_ptr<Texture> texture_;
};

// Textures that the host reads. They stay this one's; the host may let go of them in any thread, and when this is gone.
class TakenTextures {
 public:
  explicit TakenTextures(const GlFunctions& gl) : gl_(gl) {}
  ~TakenTextures();
  TakenTextures(const TakenTextures&) = delete;
  TakenTextures& operator=(const TakenTextures&) = delete;
  std::shared_ptr<GlTexture> take(std::unique_ptr<Texture>);
  // Those that the host has let go of; what is done to them is done after the host has read them.
  std::vector<std::unique_ptr<Texture>> come_back();
  std::size_t bytes() const;

 private:
  struct Back {
    std::mutex mutex;
    std::vector<GlTexture> textures;
  };
  const GlFunctions& gl_;
  std::shared_ptr<Back> back_ = std::make_shared<Back>();
  std::vector<std::unique_ptr<Texture>> taken_;
};

class GlBuffer {
 public:
  explicit GlBuffer(const GlFunctions&);
  ~GlBuffer();
  GlBuffer(const GlBuffer&) = delete;
  GlBuffer& operator=(const GlBuffer&) = delete;
  // Replaces the content; null data leaves it undefined. Memory is allocated anew only where the size changes.
  void fill(std::size_t bytes, const void* data);
  GLuint name() const { return name_; }
  std::size_t bytes() const { return bytes_; }

 private:
  const GlFunctions& gl_;
  GLuint name_ = 0;
  std::size_t bytes_ = 0, allocated_ = 0;
};

// Rows from the top, channels interleaved, layer by layer, as Image tells. Of what is read, the rows of the texture are told.
void write_texture(const GlFunctions&, const Texture&, const Image&, std::span<const float>);
void read_texture(const GlFunctions&, const Texture&, const Image&, Rows, std::span<float>);

}  // namespace airlight
