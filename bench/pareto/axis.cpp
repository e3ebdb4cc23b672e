#include "bench/pareto/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace airlight {

double LogAxis::operator()(double v) const { return from + (to - from) * std::log(v / least) / std::log(most / least); }

LogAxis axis_over(const std::vector<double>& values, double from, double to) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double least = std::log10(*low), most = std::log10(*high);
  const double room = std::max(0.06 * (most - least), (0.5 - (most - least)) / 2);
  least -= std::max(room, 0.05), most += std::max(room, 0.05);
  return {std::pow(10, least), std::pow(10, most), from, to};
}

std::vector<Tick> ticks(const LogAxis& axis) {
  const double decades = std::log10(axis.most / axis.least);
  const std::string numbered = decades < 0.8 ? "12345678" : decades < 1.5 ? "12357" : decades < 3.5 ? "125" : "1";
  std::vector<Tick> all;
  for (int exponent = static_cast<int>(std::floor(std::log10(axis.least))); exponent <= std::ceil(std::log10(axis.most));
       ++exponent) {
    for (int digit = 1; digit < 10; ++digit) {
      // By division below 1: 3 / 1000 is the double that reads 0.003.
      const double value = exponent < 0 ? digit / std::pow(10, -exponent) : digit * std::pow(10, exponent);
      if (value < axis.least || value > axis.most || (digit > 1 && decades > 5)) continue;
      const bool has_number = numbered.find(static_cast<char>('0' + digit)) != std::string::npos;
      all.push_back({value, has_number ? fmt::format("{:g}", value) : std::string(), digit == 1});
    }
  }
  return all;
}

}  // namespace airlight
