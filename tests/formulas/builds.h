// One formula in each of its builds, over arrays: float, every SIMD target, GLSL (double is called directly).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/algorithms/view.h"
#include "cpu/targets.h"

namespace airlight {

struct PointAirlightInputs {
  std::vector<float> extinction, foot, h, x0, x1;
  std::size_t size() const { return extinction.size(); }
};

// point_airlight() over the inputs, one phase function and its tables.
std::vector<float> point_airlight_float(Phase, std::span<const float> tables, const PointAirlightInputs&);
std::vector<float> point_airlight_simd(Phase, std::span<const float> tables, const PointAirlightInputs&, Simd);

// phase_value() at each mu.
std::vector<float> phase_value_simd(Phase, std::span<const float> mu, Simd);

// exp_ and log_ at each x.
std::vector<float> exp_simd(std::span<const float> x, Simd);
std::vector<float> log_simd(std::span<const float> x, Simd);

}  // namespace airlight
