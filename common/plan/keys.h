// What is up to date. A step's key is the hash of its knobs and of its inputs' keys; an output that a backend already holds
// under the same key is not made again. Incremental rendering, statistics and their tests are this one rule.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/algorithms/algorithm.h"
#include "common/plan/rows.h"

namespace airlight {

// One key a step. `key_of_upload` gives the key of an input that no earlier step writes. Throws std::logic_error (from it) where
// an input has neither been written nor uploaded. `rows`: what rows_of() tells of each step; empty: whole images.
std::vector<std::uint64_t> step_keys(std::span<const Step>, const std::function<std::uint64_t(Handle)>& key_of_upload,
                                     std::span<const StepRows> rows = {});

// The key of a step's output.
std::uint64_t output_key(std::uint64_t step_key, const Image& output);
std::uint64_t output_key(std::uint64_t step_key, const Buffer& output);

// Which steps must run: those with a kept output that is not `held` under its key, and those that make what they read.
std::vector<bool> steps_to_run(std::span<const Step>, std::span<const std::uint64_t> keys,
                               const std::function<bool(Handle, std::uint64_t key)>& held);

}  // namespace airlight
