// What is up to date. A step's key is the hash of its knobs and of its inputs' keys; an output that a backend already holds
// under the same key is not made again. Incremental rendering, statistics and their tests are this one rule.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "common/algorithms/algorithm.h"
#include "common/plan/plan.h"
#include "common/plan/rows.h"

namespace airlight {

// Which steps must run, and under which keys their results are held. Asked again for another frame it takes no new memory.
class StepRuns {
 public:
  // `key_of_upload` gives the key of an input that no earlier step writes. Throws std::logic_error (from it) where an input has
  // neither been written nor uploaded. `rows`: what rows_of() tells of each step; empty: whole images.
  void update(std::span<const Step>, const std::function<std::uint64_t(Handle)>& key_of_upload,
              const std::function<bool(Handle, std::uint64_t key)>& held, std::span<const StepRows> rows = {});

  const std::vector<std::uint64_t>& keys() const { return keys_; }
  // Those with a kept output that is not `held` under its key, and those that make what they read.
  const std::vector<bool>& run() const { return run_; }

 private:
  friend std::vector<std::uint64_t> step_keys(std::span<const Step>, const std::function<std::uint64_t(Handle)>&,
                                              std::span<const StepRows>);
  friend std::vector<bool> steps_to_run(std::span<const Step>, std::span<const std::uint64_t>,
                                        const std::function<bool(Handle, std::uint64_t)>&);
  void make_keys(std::span<const Step>, const std::function<std::uint64_t(Handle)>&, std::span<const StepRows>);
  void find_stale(std::span<const Step>, std::span<const std::uint64_t> keys, const std::function<bool(Handle, std::uint64_t)>&);

  std::vector<std::uint64_t> keys_;
  std::vector<bool> run_;
  std::vector<std::pair<Handle, std::uint64_t>> written_;  // the last one of a handle counts
  std::vector<Handle> needed_;                             // by a later step that runs
};

// The keys, one a step; and which must run, each by itself.
std::vector<std::uint64_t> step_keys(std::span<const Step>, const std::function<std::uint64_t(Handle)>& key_of_upload,
                                     std::span<const StepRows> rows = {});
std::vector<bool> steps_to_run(std::span<const Step>, std::span<const std::uint64_t> keys,
                               const std::function<bool(Handle, std::uint64_t key)>& held);

// The key of a step's output.
std::uint64_t output_key(std::uint64_t step_key, const Image& output);
std::uint64_t output_key(std::uint64_t step_key, const Buffer& output);

// Which steps of a plan must run, before anything is uploaded: an upload that is not held will be there.
std::vector<bool> steps_to_run(const Plan&, const std::function<bool(Handle, std::uint64_t key)>& held);

// Has images kept that steps hand on, where all of these take no more than so many bytes: those that are held, and those that
// have to be made anyway. What an edit does not change need not run again then. Costs memory, and writing it.
void keep_images(Plan&, const std::function<bool(Handle, std::uint64_t key)>& held, std::size_t most_bytes);

}  // namespace airlight
