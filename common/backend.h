// The one interface of all backends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "common/algorithms/algorithm.h"
#include "common/gl_host.h"
#include "common/progress.h"
#include "common/rows.h"
#include "common/stats.h"

namespace airlight {

// Not thread-safe; two backends in two threads are independent. A failed call throws and leaves the backend usable.
class Backend {
 public:
  virtual ~Backend() = default;

  // One line, for example "cpu, AVX-512, 2 threads" or "gl, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5, OSMesa".
  virtual std::string describe() const = 0;

  // Gives a buffer its content; `key` names the content (not 0).
  virtual void upload(Buffer, std::span<const std::byte>, std::uint64_t key) = 0;

  // Whether the content of an image or a buffer is held under this key, so that it need not be made or uploaded again.
  virtual bool holds(Handle, std::uint64_t key) const = 0;

  // Gives an image its content, as an input of a step (parity cases do this).
  virtual void upload(const Image&, std::span<const float>, std::uint64_t key) = 0;

  // Runs the steps in order, so far as the wanted rows of kept images need it: they have the bits that they have in the whole
  // images. A step whose wanted outputs are already held under the same key (step_keys() in common/plan/keys.h) is not run again.
  virtual void run(std::span<const Step>, Rows wanted, Stats&, Progress&) = 0;
  void run(std::span<const Step> steps, Stats& stats, Progress& progress) { run(steps, Rows{}, stats, progress); }

  // Copies rows of a kept image back (layout: Image, of these rows alone). Throws std::logic_error where no step has written
  // them.
  virtual void download(const Image&, Rows, std::span<float>) = 0;
  void download(const Image& image, std::span<float> values) { download(image, Rows{}, values); }

  // Copies a buffer back that a step has made.
  virtual void download(const Buffer&, std::span<std::byte>) = 0;

  // Hands a kept image of all rows over to the GlHost, and holds it no more. Throws std::logic_error where there is no such
  // texture.
  virtual std::shared_ptr<GlTexture> take(const Image&) { throw std::logic_error("only OpenGL has textures"); }

  // [byte] at most of the images, and of the buffers made by steps, that run() will hold; nothing is allocated.
  virtual std::uint64_t bytes_for(std::span<const Step>, Rows wanted) const = 0;

  // [byte] of all images and buffers that are held.
  virtual std::uint64_t held_bytes() const = 0;
};

}  // namespace airlight
