#include "app/view_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/relative_rmse.h"

namespace airlight {

ViewDifference difference_of(const HostImage& a, const HostImage& b) {
  RelativeRmse error;
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double x = static_cast<double>(a.values[i]), y = static_cast<double>(b.values[i]);
    error.add(x, y);
    largest = std::max(largest, std::fabs(x - y));
  }
  constexpr double gain = 10;
  const double mean = error.mean_truth() > 0 ? error.mean_truth() : 1;
  HostImage shown(a.extent, 3);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    shown.values[i] = static_cast<float>(gain / mean) * std::fabs(a.values[i] - b.values[i]);
  return {std::move(shown), fmt::format("relative RMSE {:.2g} %, at most {:.2g} % of the mean, shown {:.0f} times",
                                        100 * error.value(), 100 * largest / mean, gain)};
}

}  // namespace airlight
