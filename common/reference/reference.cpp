#include "common/reference/reference.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace airlight {

namespace {

// body(row) for every row, on `threads` threads; the first exception is rethrown when all have stopped.
void each_row(int rows, int threads, Progress& progress, const std::function<void(int)>& body) {
  std::atomic<int> next{0};
  std::mutex lock;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (int row = next++; row < rows; row = next++) {
        body(row);
        progress.report("reference", static_cast<double>(row + 1) / rows);
      }
    } catch (...) {
      const std::lock_guard guard(lock);
      if (!failure) failure = std::current_exception();
      next = rows;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

bool wanted(const FrameRequest& request, std::string_view prefix) {
  return std::any_of(request.images.begin(), request.images.end(),
                     [&](const std::string& name) { return name == "beauty" || name.starts_with(prefix); });
}

void put(HostImage& image, int x, int y, const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(v[c]);
}

// One pixel's values into every image.
void put_all(std::map<std::string, HostImage>& images, const Scene& scene, int x, int y, const ReferencePixel& p) {
  for (auto& [name, image] : images) {
    if (name == "surface")
      put(image, x, y, p.surface);
    else if (name == "surface.direct")
      put(image, x, y, p.surface_direct);
    else if (name == "surface.indirect")
      put(image, x, y, p.surface_indirect);
    else if (name == "surface.ambient")
      put(image, x, y, p.surface_ambient);
    else if (name == "surface.environment")
      put(image, x, y, p.surface_environment);
    else if (name == "airlight")
      put(image, x, y, p.airlight);
    else if (name == "standard_error")
      put(image, x, y, p.standard_error);
    else if (name == "normal")
      put(image, x, y, p.normal);
    else if (name == "depth")
      image.at(x, y) = static_cast<float>(p.depth);
    else if (name == "transmittance")
      image.at(x, y) = static_cast<float>(p.transmittance);
    else if (name == "optical_depth")
      image.at(x, y) = static_cast<float>(p.optical_depth);
    else if (name == "beauty") {
      // The sum of the stored floats, as every technique composes it.
      const glm::vec3 surface(p.surface), airlight(p.airlight);
      put(image, x, y, glm::dvec3(surface + airlight));
    }
  }
  for (std::size_t i = 0; i < p.airlight_of_light.size(); ++i) {
    const auto found = images.find(light_image_name(scene, i));
    if (found != images.end()) put(found->second, x, y, p.airlight_of_light[i]);
  }
}

Indirect indirect_of(std::string_view choice) {
  if (choice == "off") return Indirect::off;
  return choice == "exact" ? Indirect::exact : Indirect::unbounded;
}

}  // namespace

double ReferenceFrame::edge_share() const {
  if (edges.empty()) return 0;
  return static_cast<double>(std::count(edges.begin(), edges.end(), true)) / static_cast<double>(edges.size());
}

ReferenceFrame reference_frame(const Scene& scene, Extent extent, const ReferenceSettings& settings, bool with_edges, int threads,
                               Progress& progress) {
  const Reference reference(scene, settings);
  const auto width = static_cast<std::size_t>(extent.width), height = static_cast<std::size_t>(extent.height);
  ReferenceFrame frame;
  frame.extent = extent;
  frame.pixels.resize(width * height);
  std::vector<char> edges(with_edges ? width * height : 0);  // bytes: threads write neighbouring ones
  each_row(extent.height, threads, progress, [&](int y) {
    for (int x = 0; x < extent.width; ++x) {
      if (x % 32 == 0 || settings.indirect == Indirect::exact) progress.check();
      const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      const glm::dvec2 at(x + 0.5, y + 0.5);
      frame.pixels[i] = reference.pixel(at, extent, {}, &progress);
      if (with_edges) edges[i] = reference.edge(at, extent);
    }
  });
  frame.edges.assign(edges.begin(), edges.end());
  for (const ReferencePixel& p : frame.pixels) frame.error = std::max(frame.error, p.error);
  return frame;
}

std::map<std::string, HostImage> render_reference(const Scene& scene, const FrameRequest& request, Rows band, int threads,
                                                  Stats& stats, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  ReferenceSettings settings{request.knobs.number("tolerance"), request.knobs.choice("shadows") == "on",
                             indirect_of(request.knobs.choice("indirect")), request.knobs.number("indirect_tolerance")};
  settings.environment_shadows = request.knobs.choice("environment_shadows") == "on";
  settings.max_bounces = static_cast<int>(request.knobs.number("max_bounces"));
  settings.paths = static_cast<int>(request.knobs.number("paths"));
  settings.single_by_paths = request.knobs.choice("single_scattering") == "paths";
  settings.seed = static_cast<std::uint32_t>(request.knobs.number("seed"));
  const Reference reference(scene, settings);
  const ReferenceParts parts{wanted(request, "surface"),
                             wanted(request, "airlight") || request.images.contains("standard_error")};
  const Rows rows = within(band, request.extent.height);
  const Extent extent{request.extent.width, rows.count()};
  std::map<std::string, HostImage> images;
  for (const std::string& name : request.images) {
    images.emplace(name, HostImage(extent, name == "edge" ? 1 : image_channels(name)));
  }
  const auto edge = images.find("edge");
  each_row(extent.height, threads, progress, [&](int y) {
    for (int x = 0; x < request.extent.width; ++x) {
      if (x % 32 == 0 || settings.indirect == Indirect::exact) progress.check();
      const glm::dvec2 at(x + 0.5 + request.offset.x, rows.first + y + 0.5 + request.offset.y);
      put_all(images, scene, x, y, reference.pixel(at, request.extent, parts, &progress));
      if (edge != images.end()) edge->second.at(x, y) = reference.edge(at, request.extent) ? 1.0F : 0.0F;
    }
  });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  stats.seconds += seconds.count();
  stats.steps.push_back({"reference", seconds.count(),
                         static_cast<std::uint64_t>(extent.width) * static_cast<std::uint64_t>(extent.height), false});
  return images;
}

}  // namespace airlight
