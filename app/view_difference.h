// Two pictures beside each other: where and by how much they differ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/image.h"

namespace airlight {

struct ViewDifference {
  std::vector<std::uint8_t> display;  // ten times the absolute difference beside the mean of the second, three bytes a pixel
  std::string text;                   // "relative RMSE 0.12 %, at most 3.4 % of the mean, 10 times as bright"
};

// Of one extent, three channels.
ViewDifference difference_of(const HostImage& a, const HostImage& b);

}  // namespace airlight
