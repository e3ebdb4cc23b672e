// The one interface of all backends.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "common/algorithms/algorithm.h"
#include "common/progress.h"
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

  // Whether the buffer's content is held under this key, so that it need not be made or uploaded again.
  virtual bool holds(Buffer, std::uint64_t key) const = 0;

  // Gives an image its content, as an input of a step (parity cases do this).
  virtual void upload(const Image&, std::span<const float>, std::uint64_t key) = 0;

  // Runs the steps in order. A step whose wanted outputs are already held under the same key (step_keys() in
  // common/plan/keys.h) is not run again.
  virtual void run(std::span<const Step>, Stats&, Progress&) = 0;

  // Copies a kept image back (layout: Image). Throws std::logic_error for one that no step has
  // written.
  virtual void download(const Image&, std::span<float>) = 0;

  // Copies a buffer back that a step has made.
  virtual void download(const Buffer&, std::span<std::byte>) = 0;
};

}  // namespace airlight
