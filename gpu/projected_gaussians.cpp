#include <algorithm>
#include <cstring>
#include <glm/vec4.hpp>

#include "common/error.h"
#include "common/plan/gaussian_bins.h"
#include "gpu/medium.h"

namespace airlight {

namespace {

constexpr GLuint bins_binding = 0, depths_binding = 1, depths_number = 44;
constexpr int lights_a_pass = 4;  // as in the paper, section 5.4

// How many Gaussians the longest list of a square has.
int longest_list(const ProjectedGaussians& a, const StepRunner& r) {
  const std::vector<std::byte> bytes = r.content(a.bins);
  const auto squares = static_cast<std::size_t>(bin_columns(a.view.extent) * bin_rows(a.view.extent));
  std::vector<std::int32_t> begin(squares + 1);
  std::memcpy(begin.data(), bytes.data(), begin.size() * sizeof(std::int32_t));
  int longest = 0;
  for (std::size_t i = 0; i < squares; ++i) longest = std::max(longest, begin[i + 1] - begin[i]);
  return longest;
}

// All depths behind each other, as the shader reads them.
void bind_center_depths(const ProjectedGaussians& a, StepRunner& r) {
  const std::size_t row = a.gaussians.size() * sizeof(float), lights = a.lights.size();
  const std::size_t bytes = row * (1 + lights) + lights * sizeof(float);
  if (bytes > r.storage_limit()) {
    throw MachineError("OpenGL: the optical depths of " + std::to_string(a.gaussians.size()) + " Gaussians toward " +
                       std::to_string(lights) + " lights are more than a storage buffer may have");
  }
  r.reserve(depths_number, bytes);
  r.copy(r.buffer_name(a.to_camera), depths_number, 0, row);
  for (std::size_t k = 0; k < lights; ++k) r.copy(r.buffer_name(a.to_light[k]), depths_number, row * (1 + k), row);
  if (lights > 0) r.copy(r.buffer_name(a.light_to_camera), depths_number, row * (1 + lights), lights * sizeof(float));
  r.bind(depths_binding, depths_number);
}

}  // namespace

void run(const ProjectedGaussians& a, StepRunner& r, const Progress& progress) {
  std::vector<std::string> defines = bind_medium(r, a.gaussians, {}, {}, 1, LightDepth::analytic, a.erf);
  defines.push_back(r.lights(a.lights));
  if (a.per_light) defines.push_back("WITH_PER_LIGHT");
  if (a.optical_depth) defines.push_back("WITH_OPTICAL_DEPTH");
  if (a.extinction > 0) defines.push_back("WITH_TABLES");
  defines.push_back("LIGHTS_A_PASS " + std::to_string(lights_a_pass));
  Program& program = r.compute("gpu/projected_gaussians.glsl", defines);
  r.read(0, a.distance);
  r.read_write(0, a.airlight);
  r.read_write(1, a.per_light);
  r.write(2, a.transmittance);
  r.write(3, a.optical_depth);
  if (a.tables) r.storage(tables_binding, a.tables);
  r.storage(bins_binding, a.bins);
  bind_center_depths(a, r);
  r.view(a.view);
  struct {
    glm::vec4 albedo_extinction, ambient_sky_distance, emission_g;
    int phase_kind, side, columns, gaussians;
  } const knobs{{a.albedo, a.extinction},
                {a.ambient, a.sky_distance},
                {a.emission, static_cast<float>(a.phase.g)},
                static_cast<int>(a.phase.kind),
                bin_side,
                bin_columns(a.view.extent),
                static_cast<int>(a.gaussians.size())};
  r.block(knobs_binding, knobs);
  // Of one Gaussian, and of what comes once.
  constexpr int most = (LoopBudget::most - 4 * lights_a_pass) / (lights_a_pass + 1);
  const int longest = longest_list(a, r), lights = static_cast<int>(a.lights.size());
  program.set("most_of_list", most);
  for (int light = 0; light == 0 || light < lights; light += lights_a_pass) {
    for (int first = 0; first == 0 || first < longest; first += most) {
      const bool last = first + most >= longest;
      program.set("first_light", light);
      program.set("first_of_list", first);
      program.set("last_of_list", last ? 1 : 0);
      program.set("last_of_all", last && light + lights_a_pass >= lights ? 1 : 0);
      r.each_pixel(program, a.airlight.extent, progress);
    }
  }
}

}  // namespace airlight
