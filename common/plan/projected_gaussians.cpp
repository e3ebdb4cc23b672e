#include "common/plan/projected_gaussians.h"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "common/error.h"
#include "common/plan/depths_to_centers.h"
#include "common/plan/gaussian_bins.h"
#include "common/plan/hash.h"
#include "common/plan/light_volumes.h"
#include "common/plan/ray_noise.h"
#include "common/plan/upload.h"

namespace airlight {

namespace {

using Gaussians = std::shared_ptr<const std::vector<GaussianDensity>>;

Gaussians shared(std::vector<GaussianDensity> all) {
  return std::make_shared<const std::vector<GaussianDensity>>(std::move(all));
}

// What their optical depths depend on.
Hash hash_of(std::string_view what, const Gaussians& all) {
  Hash hash;
  hash.add(what);
  hash.add(all->size());
  for (const GaussianDensity& g : *all) hash.add(g.center), hash.add(g.radius), hash.add(g.extinction), hash.add(g.reach);
  return hash;
}

std::vector<float> as_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

Plan::Upload bins_upload(std::uint32_t id, const Gaussians& all, const View& view) {
  Hash key = hash_of("Gaussians of squares", all);
  key.add(view);
  return {{{id}, 0},
          key.value(),
          [all, view] {
            const std::vector<std::int32_t> bins = gaussian_bins(view, *all);
            const auto bytes = std::as_bytes(std::span(bins));
            return std::vector<std::byte>(bytes.begin(), bytes.end());
          },
          [all, view] { return sizeof(std::int32_t) * count_gaussian_bins(view, *all); }};
}

// Of a place from which the Gaussians are seen.
Plan::Upload depths_upload(std::uint32_t id, const Gaussians& seen) {
  return table_upload({{id}, sizeof(float) * seen->size()}, hash_of("depths from a place", seen).value(),
                      [seen] { return as_floats(depths_to_centers(*seen).others); });
}

Plan::Upload depths_upload(std::uint32_t id, const Gaussians& seen, const glm::vec3& direction) {
  Hash key = hash_of("depths along a direction", seen);
  key.add(direction);
  return table_upload({{id}, sizeof(float) * seen->size()}, key.value(),
                      [seen, direction] { return as_floats(depths_to_centers(*seen, direction).others); });
}

Plan::Upload light_to_camera_upload(std::uint32_t id, const Gaussians& seen, const std::vector<Light>& lights) {
  Hash key = hash_of("depths from the lights to the camera", seen);
  for (const Light& light : lights) key.add(light.vector), key.add(light.directional);
  return table_upload({{id}, sizeof(float) * lights.size()}, key.value(), [seen, lights] {
    std::vector<double> depths;
    depths.reserve(lights.size());
    for (const Light& light : lights)
      depths.push_back(light.directional ? depth_toward(*seen, -glm::dvec3(light.vector)) : depth_to(*seen, light.vector));
    return as_floats(depths);
  });
}

}  // namespace

void add_projected_gaussians(FramePlan& frame, const std::vector<GaussianDensity>& gaussians, Erf erf, Buffer tables,
                             Buffer volumes, std::uint32_t first_id, std::uint32_t light_id) {
  const Scene& scene = frame.scene;
  const auto refuse = [](const char* what) {
    throw InputError("setting light_path: published " + std::string(what) + ", or another light_path");
  };
  if (volumes) refuse("has no shadows of surfaces in the medium, and a surface throws one; expected shadows=off");
  if (ray_noise(scene).amplitude > 0) refuse("bends no rays, and the scene has noise; expected none");
  const std::string_view resolution = frame.request.knobs.choice("airlight_resolution");
  if (resolution != "full") refuse("renders every pixel; expected airlight_resolution=full");
  // Depths have the least lost depth whatever the knob says: other reaches depend on where lamps stand, and a lamp that moves is
  // to leave the camera's depths as they are.
  const Gaussians seen = shared(gaussians_of(scene, scene.camera.position));
  std::vector<Plan::Upload>& uploads = frame.plan.uploads;
  const auto add = [&](Plan::Upload upload) {
    uploads.push_back(std::move(upload));
    return uploads.back().buffer;
  };
  const Buffer bins = add(bins_upload(first_id, shared(gaussians), frame.view));
  const Buffer to_camera = add(depths_upload(first_id + 1, seen));
  Buffer light_to_camera;
  if (!frame.lights.empty()) light_to_camera = add(light_to_camera_upload(first_id + 2, seen, frame.lights));
  std::vector<Buffer> to_light;
  for (std::size_t k = 0; k < frame.lights.size(); ++k) {
    const LightSource& source = scene.lights[frame.light_index[k]];
    const std::uint32_t id = light_id + light_ids * frame.slot_of(k);
    if (frame.lights[k].directional) {
      // Seen from a place that does not move with the camera, and is near for the sake of single precision.
      const Gaussians from_one = shared(gaussians_of(scene, scene.medium.gaussians.front().center));
      to_light.push_back(add(depths_upload(id, from_one, frame.lights[k].vector)));
    } else {
      to_light.push_back(add(depths_upload(id, shared(gaussians_of(scene, source.position)))));
    }
  }
  auto step = frame.along_view_ray<ProjectedGaussians>();
  step.tables = tables;
  step.bins = bins;
  step.to_camera = to_camera;
  step.to_light = to_light;
  step.light_to_camera = light_to_camera;
  step.gaussians = gaussians;
  step.erf = erf;
  frame.plan.steps.push_back({step, "light scattered once at each Gaussian's projection, as published"});
}

}  // namespace airlight
