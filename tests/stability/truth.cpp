#include "tests/stability/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/reference/pixel.h"
#include "common/relative_rmse.h"
#include "common/techniques/technique.h"
#include "tests/stability/draw.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

constexpr std::uint32_t stream = 0x80000000;  // beside those of scenes and settings

class Deadline final : public Progress {
 public:
  explicit Deadline(double seconds) : seconds_(seconds) {}
  void report(std::string_view, double) override {}
  bool stop_requested() const override {
    return seconds_ > 0 && std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > seconds_;
  }

 private:
  double seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Distance of a place from a triangle.
double distance_from(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto to_edge = [&](const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    const double length = glm::dot(way, way), t = length > 0 ? std::clamp(glm::dot(p - from, way) / length, 0.0, 1.0) : 0;
    return glm::distance(p, from + t * way);
  };
  const double edges = std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
  const glm::dvec3 n = glm::cross(b - a, c - a);
  if (!(glm::length(n) > 0)) return edges;
  const glm::dvec3 foot = p - glm::dot(p - a, n) / glm::dot(n, n) * n;
  const auto left = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, foot - from), n) >= 0;
  };
  return left(a, b) && left(b, c) && left(c, a) ? glm::distance(p, foot) : edges;
}

// Whether a place lies in a surface, so that its last bit decides which side it is on.
bool touches(const Scene& scene, const glm::dvec3& place, bool casters_alone) {
  for (const Surface& s : scene.surfaces) {
    if (casters_alone && !s.casts_shadow) continue;
    const auto corner = [&](unsigned i) { return glm::dvec3(s.transform * glm::dvec4(glm::dvec3(s.mesh->positions[i]), 1)); };
    for (const glm::uvec3& t : s.mesh->triangles) {
      const glm::dvec3 a = corner(t.x), b = corner(t.y), c = corner(t.z);
      if (distance_from(place, a, b, c) < 1e-5 * (glm::distance(a, b) + glm::distance(a, c)) + 1e-9) return true;
    }
  }
  return false;
}

bool on_a_surface(const Scene& scene) {
  return touches(scene, scene.camera.position, false) ||
         std::any_of(scene.lights.begin(), scene.lights.end(),
                     [&](const LightSource& l) { return l.type == LightType::point && touches(scene, l.position, true); });
}

// About how long the truth of a pixel takes, where there is no clock to ask.
double work_of(const Scene& scene) {
  const double cells = scene.medium.grid ? 3.0 * scene.medium.grid->voxels->size.x + 3 : 0;
  return static_cast<double>(scene.lights.size() + 1) * (1 + static_cast<double>(scene.medium.gaussians.size()) + cells);
}

// What the relative RMSE may be by what the technique tells of itself; infinite: nothing is promised.
double promise_of(const Scene& scene, const Asked& asked) {
  const Technique& t = technique(asked.technique);
  Settings settings = asked.settings;
  double more = 0;
  for (auto& [name, value] : settings) {
    if (name == "steps" && value == "1") return HUGE_VAL;             // no goal takes so few
    if (name == "airlight_resolution") value = "full", more += 0.01;  // by pixel
  }
  // A cell that nothing shines through is no smooth grid: one step is in it, or none.
  if (const auto& grid = scene.medium.grid) {
    const double most = static_cast<double>(*std::max_element(grid->voxels->values.begin(), grid->voxels->values.end()));
    if (most * grid->scale * glm::length(glm::dvec3(grid->transform[0])) > 100) return HUGE_VAL;
  }
  const double error = t.estimate(scene, scene.camera.resolution, KnobValues(t.knobs, settings), 2).error + more;
  if (!scene.environment) return error;
  return scene.medium.gaussians.empty() && !scene.medium.grid ? error + 0.1 : HUGE_VAL;
}

std::string why_no_truth(const Asked& asked, double promise) {
  const auto set = [&](const char* name, const char* value) {
    return std::count(asked.settings.begin(), asked.settings.end(), std::pair<std::string, std::string>(name, value)) > 0;
  };
  if (set("indirect", "psf") || set("indirect", "mean_density")) return "indirect light of a model";
  if (set("environment_airlight", "off") || set("environment_airlight", "published")) return "airlight of a model";
  if (asked.technique == "illumination-network") return "orders of scattering that the truth has not";
  if (!(promise <= 0.3)) return "nothing is promised";
  return "";
}

}  // namespace

void hold_to_truth(const Scene& scene, const Asked& asked, std::uint32_t number, const TrialOptions& options, const Frame& frame,
                   Trial& trial) {
  const Technique& t = technique(asked.technique);
  const Extent extent = scene.camera.resolution;
  const KnobValues knobs(t.knobs, asked.settings);
  trial.promise = promise_of(scene, asked);
  trial.why_no_truth = why_no_truth(asked, trial.promise);
  const bool light_known = trial.why_no_truth.empty();  // else distances and transmittances alone
  if (options.seconds == 0 && work_of(scene) > tolerance("stress_work")) trial.why_no_truth = "long";
  if (on_a_surface(scene)) trial.why_no_truth = "camera or lamp in a surface";
  if (trial.why_no_truth == "long" || on_a_surface(scene)) return;
  const bool splats =
      std::count(asked.settings.begin(), asked.settings.end(), std::pair<std::string, std::string>("image", "splats"));

  ReferenceSettings settings{1e-5, knobs.choice("shadows") != "off",
                             knobs.choice("indirect") == "off" ? Indirect::off : Indirect::unbounded};
  const Reference reference(scene, settings);
  Deadline deadline(options.seconds);
  Draw draw(stream + number);
  const int all = extent.width * extent.height, count = std::min(all, options.truth_pixels);
  RelativeRmse beauty;
  double worst = 0, claimed = 0;
  std::vector<std::array<double, 2>> pairs;  // found, true
  std::string worst_text;
  const auto value = [&](const char* name, int pixel, int c) {
    const HostImage& image = frame.image(name);
    return static_cast<double>(image.values[static_cast<std::size_t>(pixel * image.channels + c)]);
  };
  try {
    for (int k = 0; k < count; ++k) {
      const int pixel = count == all ? k : draw.whole(0, all - 1);
      const glm::dvec2 at(pixel % extent.width + 0.5, pixel / extent.width + 0.5);
      if (reference.edge(at, extent)) continue;
      const ReferencePixel p = reference.pixel(at, extent, {light_known, light_known}, &deadline);
      deadline.check();
      claimed = std::max(claimed, p.error);
      for (int c = 0; c < 3 && light_known; ++c) {
        const double found = value("beauty", pixel, c), truth = p.beauty()[c];
        beauty.add(found, truth);
        pairs.push_back({found, truth});
        if (std::fabs(found - truth) < worst) continue;
        worst = std::fabs(found - truth);
        worst_text = fmt::format("pixel {} channel {}: surface {:.6g}, true {:.6g}; airlight {:.6g}, true {:.6g}", pixel, c,
                                 value("surface", pixel, c), p.surface[c], value("airlight", pixel, c), p.airlight[c]);
      }
      const double depth = value("depth", pixel, 0), seen = value("transmittance", pixel, 0);
      if (std::fabs(depth - p.depth) > tolerance("stress_depth") * p.depth)
        trial.failures.push_back(fmt::format("depth: pixel {} has {:.9g}, true {:.9g}", pixel, depth, p.depth));
      const double allowed = tolerance("stress_transmittance") + 2 * trial.promise;  // which may be infinite
      if (!splats && std::fabs(seen - p.transmittance) > allowed)
        trial.failures.push_back(fmt::format("transmittance: pixel {} has {:.6g}, true {:.6g}", pixel, seen, p.transmittance));
    }
  } catch (const Interrupted&) {
    trial.why_no_truth = "long";
    return;
  }
  if (claimed > 1e-3) {
    trial.why_no_truth = fmt::format("the truth claims {:.1e}", claimed);
    return;
  }
  if (!light_known) return;
  trial.truth = true;
  // Beside numbers of about 1: below that floor there is no light.
  const double mean = std::max(beauty.mean_truth(), tolerance("stress_dark"));
  trial.error = beauty.rmse() / mean;
  const double allowed = tolerance("stress_promise") * trial.promise + tolerance("stress_truth");
  if (!(trial.error <= allowed))
    trial.failures.push_back(
        fmt::format("relative RMSE {:.3g}, promised {:.3g}, worst {}", trial.error, trial.promise, worst_text));
  // Dark pixels, too, each beside itself and a part of the mean.
  std::size_t far = 0;
  double farthest = 0;
  for (const auto& [found, truth] : pairs) {
    const double apart = std::fabs(found - truth) / (truth + 0.03 * mean);
    far += apart > 10 * allowed + 0.03 ? 1 : 0;
    farthest = std::max(farthest, apart);
  }
  if (far > pairs.size() / 20)
    trial.failures.push_back(fmt::format("{} of {} numbers are off, one by {:.3g}, promised {:.3g}, worst {}", far, pairs.size(),
                                         farthest, trial.promise, worst_text));
}

}  // namespace airlight
