// Two pictures beside each other: where and by how much they differ.
#pragma once

#include <string>

#include "common/image.h"

namespace airlight {

struct ViewDifference {
  HostImage shown;   // ten times the absolute difference beside the mean of the second
  std::string text;  // "relative RMSE 0.12 %, at most 3.4 % of the mean, 10 times as bright"
};

// Of one extent, three channels.
ViewDifference difference_of(const HostImage& a, const HostImage& b);

}  // namespace airlight
