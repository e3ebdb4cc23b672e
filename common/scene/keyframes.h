// A number over time, known at some frames.
#pragma once

#include <span>

namespace airlight {

// smooth: cubic between two keys, with continuous velocity, at rest at the first and the last key and where the direction turns.
enum class Interpolation { linear, smooth };

// The value at `frame`. `frames` rise strictly, one value each, at least one. At a key it is the key's value in every bit;
// between two keys it never leaves the range of both; before the first and after the last key it holds. Smooth: M. Steffen, A
// simple method for monotonic interpolation in one dimension, Astronomy and Astrophysics 239, 1990.
double interpolated(std::span<const int> frames, std::span<const double> values, Interpolation, int frame);

}  // namespace airlight
