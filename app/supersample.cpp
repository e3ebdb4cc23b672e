#include "app/supersample.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace airlight {

std::vector<glm::dvec2> subpixel_centres(int n) {
  std::vector<glm::dvec2> centres;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) centres.emplace_back((i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5);
  }
  const auto nearest = std::min_element(centres.begin(), centres.end(),
                                        [](const glm::dvec2& a, const glm::dvec2& b) { return glm::dot(a, a) < glm::dot(b, b); });
  std::iter_swap(centres.begin(), nearest);
  return centres;
}

void Supersampler::add(const std::string& name, const HostImage& image) {
  Sum& sum = sums_[name];
  const bool place = name == "depth" || name == "normal", squares = name == "standard_error";
  if (sum.passes++ == 0) {
    sum.extent = image.extent;
    sum.channels = image.channels;
    sum.values.assign(image.values.begin(), image.values.end());
    if (squares) {
      for (double& v : sum.values) v *= v;
    }
    return;
  }
  if (place) {
    sum.passes = 1;
    return;
  }
  for (std::size_t i = 0; i < sum.values.size(); ++i) {
    const auto value = static_cast<double>(image.values[i]);
    sum.values[i] += squares ? value * value : value;
  }
}

HostImage Supersampler::mean(const std::string& name) const {
  const Sum& sum = sums_.at(name);
  HostImage image(sum.extent, sum.channels);
  const bool squares = name == "standard_error";
  for (std::size_t i = 0; i < sum.values.size(); ++i) {
    image.values[i] = static_cast<float>((squares ? std::sqrt(sum.values[i]) : sum.values[i]) / sum.passes);
  }
  return image;
}

}  // namespace airlight
