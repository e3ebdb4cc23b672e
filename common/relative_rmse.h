// The one measure of an image's error.
#pragma once

#include <cmath>
#include <limits>

namespace airlight {

// sqrt(mean((a - b)^2)) / |mean(b)| over all values added, b the truth.
class RelativeRmse {
 public:
  void add(double a, double b) {
    squares_ += (a - b) * (a - b);
    truth_ += b;
    count_ += 1;
  }
  double rmse() const { return count_ > 0 ? std::sqrt(squares_ / count_) : 0; }
  double mean_truth() const { return count_ > 0 ? truth_ / count_ : 0; }
  // 0 of nothing added; infinite where the truth's mean is 0 or a value was not finite.
  double value() const {
    if (!(count_ > 0)) return 0;
    const double relative = rmse() / std::fabs(mean_truth());
    return std::isfinite(relative) ? relative : std::numeric_limits<double>::infinity();
  }

 private:
  double squares_ = 0, truth_ = 0, count_ = 0;
};

}  // namespace airlight
