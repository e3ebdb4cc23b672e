#include "common/plan/sampled_airlight.h"

#include <algorithm>
#include <string>
#include <utility>

#include "common/plan/gaussian_light_volumes.h"

namespace airlight {

namespace {

// Offsets of the handles.
enum : std::uint32_t {
  part_distance,
  part_airlight,
  part_per_light,
  part_transmittance,
  remaining_distance,
  upsampled_airlight,
  upsampled_per_light,
  upsampled_transmittance,
  rest_airlight,
  rest_per_light,
  rest_transmittance,
  depth_airlight,
  depth_transmittance,
  part_depth,
  part_environment,
  rest_depth,
  rest_environment,
  used_ids
};
static_assert(used_ids <= sampled_airlight_ids);

// A view whose pixels are every `stride`-th one of another's, the upper left one first. Where the stride does not divide the
// extent, it is that much wider and higher to the right and below.
View subsampled(const View& whole, int stride) {
  View part = whole;
  part.extent = subsampled(whole.extent, stride);
  const double s = stride;
  // Of pixel 0 in both: 2 (1/2 + offset) / n - 1 on the same scale, that of the part being wider by s * taken / all.
  const auto offset = [&](float of_whole, int all, int taken) {
    return static_cast<float>((s * taken - all + 1 + 2 * static_cast<double>(of_whole)) / (2 * s) - 0.5);
  };
  part.offset = {offset(whole.offset.x, whole.extent.width, part.extent.width),
                 offset(whole.offset.y, whole.extent.height, part.extent.height)};
  part.tan_half_fov = static_cast<float>(static_cast<double>(whole.tan_half_fov) * s * part.extent.height / whole.extent.height);
  return part;
}

// Whether a pixel takes longer than it takes to find what samples tell of it.
bool is_worth_it(const RayMarch&) { return true; }
bool is_worth_it(const GaussianAirlight& a) {
  const auto glows = [](const GaussianDensity& g) { return g.emission != glm::vec3(0); };
  return std::any_of(a.gaussians.begin(), a.gaussians.end(), glows) || (!a.gaussians.empty() && !a.lights.empty()) ||
         a.gaussians.size() > few_gaussians;
}

// The same with nothing to sum but optical depth.
template <class March>
March depth_alone(March a) {
  a.lights.clear();
  a.ambient = a.emission = glm::vec3(0);
  for (GaussianDensity& g : a.gaussians) g.emission = glm::vec3(0);
  a.volumes = {};
  a.per_light = {};
  a.depths.clear(), a.depth_volumes.clear();
  if constexpr (requires { a.light_depth; }) a.light_depth = LightDepth::analytic;
  if constexpr (requires { a.sources; }) a.sources = {};
  return a;
}

template <class March>
void sample(FramePlan& frame, const March whole, std::string_view why, int stride, std::uint32_t first_id) {
  const Extent all = frame.request.extent, few = subsampled(all, stride);
  const auto handle = [&](std::uint32_t id, const Image& like, Extent extent) {
    return like ? Image{{first_id + id}, like.format, extent, like.layers, false} : Image{};
  };
  std::vector<Step>& steps = frame.plan.steps;
  steps.pop_back();
  // Told from a ray's depth, so that few of both will do.
  const std::optional<EnvironmentAirlight> environment = frame.take_environment_airlight();
  // Adds it to a step's airlight. Returns what the airlight is then.
  const auto add_environment = [&](const March& to, std::uint32_t id) {
    if (!environment) return to.airlight;
    EnvironmentAirlight a = *environment;
    a.distance = to.distance, a.optical_depth = to.optical_depth, a.scattered = to.airlight, a.view = to.view;
    a.airlight = handle(id, environment->airlight, to.airlight.extent);
    steps.push_back({a, "the environment's light, scattered once along the view ray"});
    return a.airlight;
  };

  March part = whole;
  part.view = subsampled(whole.view, stride);
  part.distance = handle(part_distance, whole.distance, few);
  part.airlight = handle(part_airlight, whole.airlight, few);
  part.per_light = handle(part_per_light, whole.per_light, few);
  part.transmittance = handle(part_transmittance, whole.transmittance, few);
  part.optical_depth = environment ? handle(part_depth, whole.optical_depth, few) : Image{};
  steps.push_back(
      {Subsample{.whole = whole.distance, .stride = stride, .part = part.distance}, "where the rays of few pixels end"});
  steps.push_back({part, why});
  const Image sampled_airlight = add_environment(part, part_environment);

  const DepthAwareUpsample between{.distance = whole.distance,
                                   .sampled_distance = part.distance,
                                   .sampled_airlight = sampled_airlight,
                                   .sampled_per_light = part.per_light,
                                   .sampled_transmittance = part.transmittance,
                                   .stride = stride,
                                   .remaining = handle(remaining_distance, whole.distance, all),
                                   .airlight = handle(upsampled_airlight, whole.airlight, all),
                                   .per_light = handle(upsampled_per_light, whole.per_light, all),
                                   .transmittance = handle(upsampled_transmittance, whole.transmittance, all)};
  steps.push_back({between, "what they tell of the pixels between them"});

  March rest = whole;
  rest.distance = between.remaining;
  rest.airlight = handle(rest_airlight, whole.airlight, all);
  rest.per_light = handle(rest_per_light, whole.per_light, all);
  rest.transmittance = handle(rest_transmittance, whole.transmittance, all);
  rest.optical_depth = environment ? handle(rest_depth, whole.optical_depth, all) : Image{};
  steps.push_back({rest, "the pixels of which they do not tell"});
  const Image rest_and_environment = add_environment(rest, rest_environment);

  steps.push_back({FillAirlight{.remaining = between.remaining,
                                .upsampled = between.airlight,
                                .upsampled_per_light = between.per_light,
                                .upsampled_transmittance = between.transmittance,
                                .computed = rest_and_environment,
                                .computed_per_light = rest.per_light,
                                .computed_transmittance = rest.transmittance,
                                .airlight = environment ? environment->airlight : whole.airlight,
                                .per_light = whole.per_light,
                                .transmittance = whole.transmittance},
                   "both together"});
  if (!whole.optical_depth || (environment && !whole.optical_depth.keep)) return;
  March depth = depth_alone(whole);
  depth.airlight = handle(depth_airlight, whole.airlight, all);
  depth.transmittance = handle(depth_transmittance, whole.transmittance, all);
  steps.push_back({depth, "the optical depth of every pixel"});
}

}  // namespace

Knob airlight_resolution_knob() {
  return choice_knob("airlight_resolution", {"full", "half", "quarter"},
                     "of the airlight along each side; what samples around a pixel do not tell to about 1 % is computed for it");
}

void sample_airlight(FramePlan& frame, std::uint32_t first_id) {
  const std::string_view resolution = frame.request.knobs.choice("airlight_resolution");
  if (resolution == "full") return;
  const int stride = resolution == "half" ? 2 : 4;
  const Extent few = subsampled(frame.request.extent, stride);
  const Step last = frame.plan.steps.back();
  std::visit(
      [&](const auto& a) {
        if constexpr (requires { is_worth_it(a); }) {
          const char* why_not = frame.scene.medium.empty()            ? "no medium"
                                : std::min(few.width, few.height) < 3 ? "the image is too small"
                                : !is_worth_it(a)                     ? "closed forms are as fast"
                                                                      : nullptr;
          if (why_not) {
            frame.plan.skips.push_back({Rule::every_pixel, "airlight_resolution = " + std::string(resolution), why_not});
          } else {
            sample(frame, a, last.why, stride, first_id);
          }
        }
      },
      last.what);
}

}  // namespace airlight
