// A parity case is data: inputs made in code, a list of steps, the images that are its result. The same cases are run as kernel
// benchmarks at a larger extent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/backend.h"

namespace airlight {

using Result = std::variant<Image, Buffer>;  // a buffer of floats

struct Case {
  std::vector<std::pair<Buffer, std::vector<std::byte>>> buffers;
  std::vector<std::pair<Image, std::vector<float>>> images;
  std::vector<Step> steps;
  std::vector<std::pair<std::string, Result>> results;  // images are kept
};

struct NamedCase {
  std::string_view name;  // algorithm/what is special
  Case (*make)(Extent);
};
inline void PrintTo(const NamedCase& c, std::ostream* out) { *out << c.name; }

// One list an algorithm, in the file of its name, and one of whole frames.
std::span<const NamedCase> surface_visibility_cases();
std::span<const NamedCase> shadow_planes_cases();
std::span<const NamedCase> view_transmittance_cases();
std::span<const NamedCase> surface_airlight_cases();
std::span<const NamedCase> environment_light_cases();
std::span<const NamedCase> surface_shading_cases();
std::span<const NamedCase> homogeneous_airlight_cases();
std::span<const NamedCase> mean_depth_lattice_cases();
std::span<const NamedCase> mean_depth_cases();
std::span<const NamedCase> density_injection_cases();
std::span<const NamedCase> optical_depth_propagation_cases();
std::span<const NamedCase> visibility_network_cases();
std::span<const NamedCase> particle_light_cases();
std::span<const NamedCase> network_iteration_cases();
std::span<const NamedCase> source_function_cases();
std::span<const NamedCase> ray_march_cases();
std::span<const NamedCase> particle_splats_cases();
std::span<const NamedCase> gaussian_airlight_cases();
std::span<const NamedCase> projected_gaussians_cases();
std::span<const NamedCase> light_march_cases();
std::span<const NamedCase> subsample_cases();
std::span<const NamedCase> depth_aware_upsample_cases();
std::span<const NamedCase> fill_airlight_cases();
std::span<const NamedCase> environment_airlight_cases();
std::span<const NamedCase> hidden_environment_cases();
std::span<const NamedCase> environment_indirect_cases();
std::span<const NamedCase> compose_cases();
std::span<const NamedCase> frame_cases();
std::vector<NamedCase> all_cases();

// Cases with so many loops that GL takes them in parts: for small images, and no benchmarks.
std::span<const NamedCase> long_ray_march_cases();
std::span<const NamedCase> long_gaussian_airlight_cases();
std::span<const NamedCase> long_projected_gaussians_cases();
std::span<const NamedCase> long_light_march_cases();
std::vector<NamedCase> long_cases();

// Uploads the inputs; then run(case.steps) may be called any number of times.
void upload(Backend&, const Case&);
std::vector<float> download(Backend&, const Result&);
// A buffer is as an image one row high.
Image shape_of_result(const Result&);

}  // namespace airlight
