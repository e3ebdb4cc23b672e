// What is asked of the formulas in every build: each check calls them over arrays by a Run and holds the results against an
// oracle of its own, in double. No formula file is included by a check, so that the same checks can be turned on damaged ones.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/algorithms/view.h"

namespace airlight {

// The numbers are those of call_formula() in tests/formulas/calls.h.
enum class Formula : int {
  exp = 0,
  log = 1,
  phase_value = 2,           // mu
  point_airlight = 3,        // sigma_t, foot, h, x0, x1
  directional_airlight = 4,  // sigma_t, mu, x0, x1
  grid_coordinate = 5,       // x, size, n
  grid_lookup_zero = 6,      // coordinate, n -> lower, weight
  grid_lookup_clamped = 7,
  grid_value_zero = 8,  // x, y, z, size in x, y, z; the table as grid_extinction() takes it
  grid_value_clamped = 9,
  ray_length = 10,     // distance, sky distance
  optical_depth = 11,  // length, extinction
  transmittance = 12,
  opacity = 13,
  mean_transmittance = 14,
  attenuated_length = 15,  // length, extinction
  point_irradiance = 16,   // l, radius, extinction
  lambert = 17,
  unit_distance = 18,   // a, b
  phong = 19,           // cosine of normal and light, apart, shininess
  ray_triangle = 20,    // d, a, b, c -> distance, weights of b and c
  shading_normal = 21,  // d, normals of a, b, c, weights of b and c -> normal
  image_plane_x = 22,   // i, offset, width, height, tangent
  image_plane_y = 23,   // j, offset, height, tangent
  view_ray = 24,        // x, y, right, up, forward -> d
  perpendicular = 25,   // d, p, least -> foot, h
  erf = 26,
  atan = 27,
  gaussian_falloff = 28,       // inverse radius, squared distance
  gaussian_depth = 29,         // inverse radius, h, from, to
  gaussian_depth_beyond = 35,  // inverse radius, h, from
  gaussian_whole = 36,         // extinction, radius
  gaussian_nearest = 66,       // ends of a stretch from the foot, in radii
  erf_printed = 50,            // those three by the printed error function
  gaussian_depth_printed = 51,
  gaussian_depth_beyond_printed = 52,
  least_and_most = 53,      // a, b -> min, max
  light_density = 37,       // sigma_t, foot, h, x, more, mu -> of a point light, of a directional one
  ray_ended = 38,           // front, most, seen -> 1 or 0
  graded_step = 30,         // k, n, length, extinction
  step_of_light = 31,       // a, b, foot, h -> angle over h, mean place, mean distance
  step_transmittance = 32,  // front, tau, share, beside
  grid_bound = 33,          // coordinates, numbers of cells; the table: numbers of bricks, then their bounds
  step_phase = 34,          // ends from the foot, h
  step_parts = 39,          // the same -> number, the first cut's place from the foot, whether a step may have parts (1 or 0)
  depth_in_volume = 40,     // place; the table as depth_in_volume() takes it; the phase's kind is the volume's
  cube_face = 41,           // place -> a, b, c
  sharpened_depth = 42,     // before, here, after
  injected_gaussian = 43,   // inverse radius, offset, cell
  depth_beside = 44,        // own, others, weights; the phase's kind is the scheme
  link_shares = 45,         // depth, all -> lost, given, kept
  surface_airlight = 47,    // lambda, s -> of a point light, of a directional one; the table is one of surface_airlight_tables()
  source_in_volume = 46,    // place; the table as source_in_volume() takes it; the phase's kind is the channel
  exp2 = 48,                // x
  half_cell = 49,           // lower corner, weights; the table: a float, then halves, 31 and 32 along x and y
  upsampled = 60,           // four samples, four bends, u, v -> value, what bends of that size add at most
  bend_between = 61,        // before, a, b, after, whether there is one before, after (1 or 0) -> bend, size
  depth_fit = 62,           // inverse distance, of the sample, tolerance
  weighted_mean = 63,       // four samples, four weights
  gradient_noise = 64,      // place -> three noises
  bent_ray = 65,            // d, centre, radius, amplitude, inverse scale, offset -> direction
  sh_basis = 70,            // direction -> three coefficients from three times the phase's kind on
  sh_value = 71,            // direction; the table: coefficients; the phase's kind is the order
  sh_rotated = 72,          // axis; the table: coefficients about z -> as sh_basis
  sh_convolve = 73,         // factor; the table: six coefficients about z, then those of a function -> as sh_basis
  sh_triple_product = 74,   // three directions; the table: products; the phase's kind is the order
  sh_bands = 75,            // exponent -> peak, convolution, lobe; the phase's kind is the band
  average_gaussian_depth = 76,  // squared distance
  environment_value = 77,       // direction; the table: an image; the phase's kind is the channel
  environment_share = 78,       // cosine; the table: of a lobe
  environment_reflection = 79,  // direction; the table: of a lobe -> red, green, blue
  seen_side = 85,               // as shading_normal -> 1 or -1
  between_corners = 86,         // three values, weights of b and c
  environment_scattered = 80,   // depths of the homogeneous part and of the rest -> of each, published of the first alone
  surface_airlight_psf = 81,    // lambda, cosine; the table is one of surface_psf_tables()
  environment_scattered_to_surface = 82,  // mean depth of the rest -> of the homogeneous part, of the rest
  value_among_nodes = 83,                 // x, y, z; the table: a number, then 5 x 4 x 3 nodes and padding
  half_angles = 90,                       // normal, to the light, to the viewer -> of the half vector, from it, around it
  brdf_reflection = 91,                   // the same; the table: of a reflectance -> red, green, blue
  brdf_environment = 92,                  // normal, to the viewer; the table: harmonics, then lobes -> red, green, blue
  brdf_environment_part = 93,             // the same
  splat_before = 95,                      // s
  splat_depth = 96,                       // d, c, 1 / support, peak, end -> depth, foot
  splat_opacity = 97,                     // tau
  direction_weight = 98,                  // mu, 1 / reach
};
constexpr std::size_t most_inputs = 14, most_results = 3;

// Column k holds input or result k of every call. Inputs are numbers that a float holds exactly: no build rounds them.
using Columns = std::vector<std::vector<double>>;

struct Calls {
  Formula formula;
  Columns inputs;
  Phase phase = {};
  std::span<const float> table = {};
};

// A build of the formulas: most_results columns, of which a formula fills the first ones.
using Run = std::function<Columns(const Calls&)>;

// The largest error, and where.
struct Measured {
  double error = 0;
  std::size_t count = 0;
  std::string where;

  // NaN is kept as the largest error of all.
  template <class Where>
  void add(double e, Where&& place) {
    ++count;
    if (e <= error || std::isnan(error)) return;
    error = e;
    where = place();
  }
};

struct Check {
  std::string name;
  std::function<Measured(const Run&)> measure;
  std::string_view double_bound, float_bound;  // rows of tests/tolerances.h: for the build in double, for every other
};

// Of every topic, in the order of common/formulas/formulas.h.
std::vector<Check> all_checks();

void add_depth_volume_checks(std::vector<Check>&);
void add_elementary_checks(std::vector<Check>&);
void add_camera_checks(std::vector<Check>&);
void add_triangle_checks(std::vector<Check>&);
void add_phase_checks(std::vector<Check>&);
void add_transmittance_checks(std::vector<Check>&);
void add_reflection_checks(std::vector<Check>&);
void add_grid_checks(std::vector<Check>&);
void add_gaussian_checks(std::vector<Check>&);
void add_marching_checks(std::vector<Check>&);
void add_network_checks(std::vector<Check>&);
void add_splat_checks(std::vector<Check>&);
void add_upsample_checks(std::vector<Check>&);
void add_noise_checks(std::vector<Check>&);
void add_spherical_harmonics_checks(std::vector<Check>&);
void add_environment_checks(std::vector<Check>&);
void add_brdf_checks(std::vector<Check>&);
void add_airlight_checks(std::vector<Check>&);
void add_surface_airlight_checks(std::vector<Check>&);

// The nearest number that a float holds. volatile: GCC 12 leaves the two conversions out where it turns them into vector
// instructions.
inline double as_float(double x) {
  const volatile float nearest = static_cast<float>(x);
  return static_cast<double>(nearest);
}

// Adds one call to the columns.
template <class... Numbers>
void add_call(Columns& inputs, Numbers... numbers) {
  inputs.resize(sizeof...(numbers));
  std::size_t k = 0;
  (inputs[k++].push_back(as_float(static_cast<double>(numbers))), ...);
}

// "name 1.5, name 2" for messages.
std::string place(std::initializer_list<std::pair<const char*, double>> values);

// |found - truth| / |truth|; a truth of 0 must be met.
inline double relative_error(double found, double truth) {
  if (truth == 0) return found == 0 ? 0 : HUGE_VAL;
  return std::fabs(found / truth - 1);
}

}  // namespace airlight
