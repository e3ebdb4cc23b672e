// Several samples a pixel: one pass over the image for each, averaged.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <vector>

#include "common/image.h"

namespace airlight {

// Centres of the n x n sub-pixels relative to the pixel's centre [pixel]; the one nearest to it comes first.
std::vector<glm::dvec2> subpixel_centres(int n);

// Sums the passes in double. Places and directions (depth, normal), which cannot be averaged, are those of the first pass;
// standard errors are of passes that are independent.
class Supersampler {
 public:
  void add(const std::string& name, const HostImage&);
  HostImage mean(const std::string& name) const;

 private:
  struct Sum {
    Extent extent;
    int channels = 0, passes = 0;
    std::vector<double> values;
  };
  std::map<std::string, Sum> sums_;
};

}  // namespace airlight
