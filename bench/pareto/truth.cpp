#include "bench/pareto/truth.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "bench/pareto/sweep.h"
#include "common/reference/reference.h"
#include "common/scene/image_file.h"

namespace airlight {

Truth truth_of(const Scene& scene, Extent extent, const std::string& folder, int threads, Progress& progress) {
  namespace fs = std::filesystem;
  const std::string name = fmt::format("{}/{}-{}x{}", folder, scene.hash.substr(0, 32), extent.width, extent.height);
  if (!fs::exists(name + ".pfm") || !fs::exists(name + ".edges.pfm")) {
    fs::create_directories(folder);
    FrameRequest request;
    request.extent = extent;
    request.images = {"beauty", "edge"};
    const Technique& reference = technique("reference");
    // A grid's interpolation has kinks at every cell; 1e-5 is far below what is measured here.
    request.knobs = KnobValues(reference.knobs, Settings{{"tolerance", scene.medium.grid ? "1e-5" : "1e-6"}});
    Stats stats;
    const std::map<std::string, HostImage> images = render_reference(scene, request, threads, stats, progress);
    write_image(name + ".edges.pfm", images.at("edge"), {});
    write_image(name + ".pfm", images.at("beauty"), {});
  }
  Truth truth{read_image(name + ".pfm"), {}};
  for (const float edge : read_image(name + ".edges.pfm").values) truth.edges.push_back(edge > 0);
  return truth;
}

RelativeError relative_error(const HostImage& image, const Truth& truth) {
  double squares[2] = {}, sums[2] = {}, counts[2] = {};
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const double b = static_cast<double>(truth.beauty.values[i]), apart = static_cast<double>(image.values[i]) - b;
    for (int off_edges = 0; off_edges < (truth.edges[i / 3] ? 1 : 2); ++off_edges) {
      squares[off_edges] += apart * apart;
      sums[off_edges] += b;
      counts[off_edges] += 1;
    }
  }
  const auto relative = [&](int which) {
    if (counts[which] == 0) return 0.0;
    const double rmse = std::sqrt(squares[which] / counts[which]), mean = sums[which] / counts[which];
    return mean > 0 ? rmse / mean : rmse;
  };
  return {relative(0), relative(1)};
}

}  // namespace airlight
