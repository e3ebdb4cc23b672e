// The CPU backend: Highway kernels on tiles of 64 x 64 pixels, spread over threads.
#pragma once

#include <memory>

#include "common/backend.h"
#include "cpu/targets.h"

namespace airlight {

struct CpuOptions {
  Simd simd = available_simd().back();
  int threads = 0;   // 0: as many as the machine has
  bool fuse = true;  // run consecutive per-pixel steps tile by tile; the image is the same without
};

class CpuBackend final : public Backend {
 public:
  // Throws MachineError where the SIMD target is not available.
  explicit CpuBackend(const CpuOptions&);
  ~CpuBackend() override;

  std::string describe() const override;
  void upload(Buffer, std::span<const std::byte>, std::uint64_t key) override;
  bool holds(Handle, std::uint64_t key) const override;
  void upload(const Image&, std::span<const float>, std::uint64_t key) override;
  using Backend::download;
  using Backend::run;
  void run(std::span<const Step>, Rows wanted, Stats&, Progress&) override;
  void download(const Image&, Rows, std::span<float>) override;
  void download(const Buffer&, std::span<std::byte>) override;
  std::uint64_t bytes_for(std::span<const Step>, Rows wanted) const override;
  std::uint64_t held_bytes() const override;

  // For proofs: the target that the kernels really ran on, and how many different threads the last run() used.
  Simd simd_that_ran() const;
  int threads_that_ran() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
