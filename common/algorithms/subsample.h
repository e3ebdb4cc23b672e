#pragma once

#include "common/algorithms/field.h"
#include "common/image.h"

namespace airlight {

// Every `stride`-th pixel of every `stride`-th row of an image, the upper left one first: pixel (i, j) of `part` is pixel
// (stride i, stride j) of `whole`.
struct Subsample {
  Image whole;     // r32f
  int stride = 2;  // 2 or 4

  Image part;  // r32f, of the extent that subsampled() gives

  static constexpr std::string_view name = "subsample";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("whole"), s.whole);
    v(knob("stride"), s.stride);
    v(out("part"), s.part);
  }
};

// Of the pixels that Subsample takes. The last one of a row or column stands at the border or up to stride - 1 pixels before it.
constexpr Extent subsampled(Extent e, int stride) { return {(e.width - 1) / stride + 1, (e.height - 1) / stride + 1}; }

}  // namespace airlight
