#include "bench/pareto/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "common/reference/reference.h"
#include "common/relative_rmse.h"
#include "common/scene/content_hash.h"
#include "common/scene/image_file.h"
#include "common/scene/sha256.h"

namespace airlight {

namespace {

using Images = std::map<std::string, HostImage>;

Images rendered(const Scene& scene, Extent extent, const KnobValues& knobs, std::set<std::string> images, int threads,
                Progress& progress) {
  FrameRequest request;
  request.extent = extent;
  request.images = std::move(images);
  request.knobs = knobs;
  Stats stats;
  return render_reference(scene, request, {}, threads, stats, progress);
}

std::string key_of(const Scene& scene, Extent extent, const KnobValues& knobs) {
  Sha256 key;
  key.add(fmt::format("truth 1 {} {} {}\n", content_hash(scene), extent.width, extent.height));
  for (const auto& [name, value] : knobs.all()) key.add(fmt::format("{} {}\n", name, value));
  return key.hex().substr(0, 32);
}

// A few pixels of it in place of all.
Extent probe_extent(Extent e) { return {std::max(1, e.width / 20), std::max(1, e.height / 20)}; }

// The same image made twice by one reference, as compilers' rounding may have it.
bool same(const HostImage& a, const HostImage& b) {
  if (!(a.extent == b.extent) || a.channels != b.channels) return false;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const auto u = static_cast<double>(a.values[i]), v = static_cast<double>(b.values[i]);
    if (!(std::fabs(u - v) <= 1e-4 * std::fabs(v) + 1e-12)) return false;
  }
  return true;
}

// Nothing where a file is missing, damaged, or of another shape.
std::optional<Truth> kept(const std::string& name, Extent extent, const HostImage& probe) {
  if (!std::filesystem::exists(name + ".exr") || !std::filesystem::exists(name + ".probe.pfm")) return std::nullopt;
  try {
    if (!same(read_image(name + ".probe.pfm"), probe)) return std::nullopt;
    Truth truth;
    for (NamedImage& i : read_images(name + ".exr")) {
      if (!(i.image.extent == extent)) return std::nullopt;
      if (i.name == "edge" && i.image.channels == 1) {
        for (const float edge : i.image.values) truth.edges.push_back(edge > 0);
      } else if (i.name.empty() && i.image.channels == 3) {
        truth.beauty = std::move(i.image);
      }
    }
    if (truth.beauty.values.empty() || truth.edges.empty()) return std::nullopt;
    truth.kept = true;
    return truth;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

bool Truth::black() const {
  return std::all_of(beauty.values.begin(), beauty.values.end(), [](float v) { return v == 0; });
}

KnobValues truth_knobs(const Scene& scene, const Settings& set) {
  const Technique& reference = technique("reference");
  // Far below the errors measured here; a grid's interpolation has kinks at every cell, where more would take minutes.
  Settings all{{"tolerance", scene.medium.grid ? "1e-5" : "1e-6"}};
  if (scene.technique == reference.name) all.insert(all.end(), scene.settings.begin(), scene.settings.end());
  all.insert(all.end(), set.begin(), set.end());
  return KnobValues(reference.knobs, all);
}

Truth truth_of(const Scene& scene, Extent extent, const KnobValues& knobs, const std::string& folder, int threads,
               Progress& progress) {
  const HostImage probe = rendered(scene, probe_extent(extent), knobs, {"beauty"}, threads, progress).at("beauty");
  const std::string name = fmt::format("{}/{}-{}x{}", folder, key_of(scene, extent, knobs), extent.width, extent.height);
  if (std::optional<Truth> found = kept(name, extent, probe)) return *std::move(found);

  Images images = rendered(scene, extent, knobs, {"beauty", "edge"}, threads, progress);
  std::filesystem::create_directories(folder);
  const std::vector<NamedImage> both{{"beauty", images.at("beauty")}, {"edge", images.at("edge")}};
  write_images(name + ".exr", both, {});
  write_image(name + ".probe.pfm", probe, {});
  Truth truth{std::move(images.at("beauty")), {}};
  for (const float edge : images.at("edge").values) truth.edges.push_back(edge > 0);
  return truth;
}

RelativeError relative_error(const HostImage& image, const Truth& truth) {
  RelativeRmse everywhere, off_edges;
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const auto value = static_cast<double>(image.values[i]), expected = static_cast<double>(truth.beauty.values[i]);
    everywhere.add(value, expected);
    if (!truth.edges[i / 3]) off_edges.add(value, expected);
  }
  return {everywhere.value(), off_edges.value()};
}

}  // namespace airlight
