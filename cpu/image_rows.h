// Images on their way out of tiles.
#pragma once

#include <span>

#include "cpu/held_images.h"
#include "cpu/parallel.h"

namespace airlight {

// HeldImage::to_rows() by all workers; of an image of several layers, whose rows do not lie behind each other, by one.
void take_rows(const HeldImage&, Rows wanted, std::span<float> rows, Workers&);

}  // namespace airlight
