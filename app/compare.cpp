#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/command.h"
#include "common/relative_rmse.h"

namespace airlight {

namespace {

const HostImage& image_named(const std::vector<NamedImage>& images, const std::string& path, const std::string& name) {
  const std::string layer = name == "beauty" ? "" : name;
  const auto found = std::find_if(images.begin(), images.end(), [&](const NamedImage& i) { return i.name == layer; });
  if (found == images.end()) throw InputError(path + ": has no image \"" + name + "\"");
  return found->image;
}

// Mean structural similarity (Wang et al. 2004) of the channels' mean, over windows of 8 x 8 pixels, half overlapping. The
// dynamic range is the second image's largest value. Images smaller than a window: one window.
double structural_similarity(const HostImage& a, const HostImage& b) {
  double range = 0;
  for (const float v : b.values) range = std::max(range, std::fabs(static_cast<double>(v)));
  if (range == 0) range = 1;
  const double c1 = 1e-4 * range * range, c2 = 9e-4 * range * range;
  const auto grey = [](const HostImage& i, int x, int y) {
    double sum = 0;
    for (int c = 0; c < i.channels; ++c) sum += static_cast<double>(i.at(x, y, c));
    return sum / i.channels;
  };
  constexpr int window = 8, stride = 4;
  double total = 0;
  std::size_t windows = 0;
  for (int y0 = 0; y0 == 0 || y0 + window <= a.extent.height; y0 += stride) {
    for (int x0 = 0; x0 == 0 || x0 + window <= a.extent.width; x0 += stride) {
      double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0, n = 0;
      for (int y = y0; y < std::min(y0 + window, a.extent.height); ++y) {
        for (int x = x0; x < std::min(x0 + window, a.extent.width); ++x, ++n) {
          const double u = grey(a, x, y), v = grey(b, x, y);
          sa += u, sb += v, saa += u * u, sbb += v * v, sab += u * v;
        }
      }
      const double ma = sa / n, mb = sb / n, va = saa / n - ma * ma, vb = sbb / n - mb * mb, cov = sab / n - ma * mb;
      total += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
      ++windows;
    }
  }
  return total / static_cast<double>(windows);
}

}  // namespace

int compare(const CompareCommand& c) {
  const std::string name = c.image.empty() ? "beauty" : c.image;
  const std::vector<NamedImage> images_a = read_images(c.a), images_b = read_images(c.b);
  const HostImage &a = image_named(images_a, c.a, name), &b = image_named(images_b, c.b, name);
  if (!(a.extent == b.extent) || a.channels != b.channels) {
    throw InputError(fmt::format("{}: {} x {} pixels, {} channels; expected those of {}: {} x {}, {}", c.a, a.extent.width,
                                 a.extent.height, a.channels, c.b, b.extent.width, b.extent.height, b.channels));
  }
  RelativeRmse error;
  double largest = 0;
  std::size_t at = 0, not_numbers = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double u = static_cast<double>(a.values[i]), v = static_cast<double>(b.values[i]), d = std::fabs(u - v);
    if (!std::isfinite(d)) {
      ++not_numbers;
      continue;
    }
    error.add(u, v);
    if (d > largest) largest = d, at = i;
  }
  const bool black = error.mean_truth() == 0;
  const double relative = black ? error.rmse() : error.value();
  const std::size_t pixel = at / static_cast<std::size_t>(a.channels), width = static_cast<std::size_t>(a.extent.width);
  fmt::print("relative RMSE {:.6g}{}\n", relative, !black ? "" : " (absolute: the second image's mean is 0)");
  fmt::print("largest difference {:.6g} at pixel {}, {}\n", largest, pixel % width, pixel / width);
  fmt::print("structural similarity {:.6f}\n", structural_similarity(a, b));
  if (not_numbers > 0) fmt::print("{} values are not finite\n", not_numbers);
  const bool good = not_numbers == 0 && relative <= c.tolerance;
  fmt::print("{} the tolerance of {:g}\n", good ? "within" : "beyond", c.tolerance);
  return good ? 0 : 1;
}

}  // namespace airlight
