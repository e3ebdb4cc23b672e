#include "tests/parity/case.h"

#include "common/plan/hash.h"

namespace airlight {

std::vector<NamedCase> all_cases() {
  std::vector<NamedCase> all;
  for (const auto list : {surface_visibility_cases(),
                          shadow_planes_cases(),
                          view_transmittance_cases(),
                          surface_airlight_cases(),
                          mean_depth_lattice_cases(),
                          mean_depth_cases(),
                          environment_light_cases(),
                          surface_shading_cases(),
                          homogeneous_airlight_cases(),
                          density_injection_cases(),
                          optical_depth_propagation_cases(),
                          visibility_network_cases(),
                          particle_light_cases(),
                          network_iteration_cases(),
                          source_function_cases(),
                          ray_march_cases(),
                          particle_splats_cases(),
                          gaussian_airlight_cases(),
                          projected_gaussians_cases(),
                          light_march_cases(),
                          subsample_cases(),
                          depth_aware_upsample_cases(),
                          fill_airlight_cases(),
                          environment_airlight_cases(),
                          environment_indirect_cases(),
                          hidden_environment_cases(),
                          compose_cases(),
                          frame_cases()}) {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

std::vector<NamedCase> long_cases() {
  std::vector<NamedCase> all;
  for (const auto list :
       {long_ray_march_cases(), long_gaussian_airlight_cases(), long_projected_gaussians_cases(), long_light_march_cases()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

void upload(Backend& backend, const Case& c) {
  const auto key = [](std::span<const std::byte> content) {
    Hash hash;
    hash.bytes(content);
    return hash.value();
  };
  for (const auto& [buffer, bytes] : c.buffers) backend.upload(buffer, bytes, key(bytes));
  for (const auto& [image, values] : c.images) backend.upload(image, values, key(std::as_bytes(std::span(values))));
}

std::vector<float> download(Backend& backend, const Result& result) {
  if (const Image* image = std::get_if<Image>(&result)) {
    std::vector<float> values(image->floats());
    backend.download(*image, values);
    return values;
  }
  const Buffer& buffer = std::get<Buffer>(result);
  std::vector<float> values(buffer.bytes / sizeof(float));
  backend.download(buffer, std::as_writable_bytes(std::span(values)));
  return values;
}

Image shape_of_result(const Result& result) {
  if (const Image* image = std::get_if<Image>(&result)) return *image;
  const int floats = static_cast<int>(std::get<Buffer>(result).bytes / sizeof(float));
  return {std::get<Buffer>(result), Format::r32f, {floats, 1}, 1, true};
}

}  // namespace airlight
