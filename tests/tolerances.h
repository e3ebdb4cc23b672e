// Every tolerance of the tests, with its reason. Comparisons are written so that NaN fails: !(error <= tolerance).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace airlight {

struct Tolerance {
  std::string_view name;
  double value;
  std::string_view reason;
};

inline constexpr Tolerance tolerances[] = {
    {"airlight_double", 1e-8, "relative; the adaptive quadrature that serves as oracle, against the high-precision table"},
    {"airlight_value", 2e-5, "relative to the value: interpolation in the tables at their default size"},
    {"airlight_end", 1e-7, "relative to the larger end value B or B': the difference of two floats is known no better"},
    {"airlight_interpolation", 4e-5, "relative to the value and the end values: cubic interpolation of the tables, |g| <= 0.97"},
    {"airlight_interpolation_peak", 1e-3, "the same for |g| up to 0.99, whose peak is 1/100 rad wide: 256 nodes leave this"},
    {"phase_integral", 5e-6, "of a phase function over the sphere; the float mu near a peak of |g| = 0.99 is worth 3e-6"},
    {"phase_value", 2.5e-6,
     "relative, float against double: eighth and 32nd powers of 1 + mu and quotients at a peak magnify roundings"},
    {"exp2_ulp", 2.5, "ULP of exp2_: its polynomial of five multiplications, 1 at 0, is 9.1e-8 off, its rounding comes to that"},
    {"exp_ulp", 2.5, "ULP of exp_: rounding of its polynomial and of the reduced argument"},
    {"log_ulp", 2.5, "ULP of log_ away from 1, where its value is small in absolute terms"},
    {"parity_off_edges", 0.0002,
     "share of pixels, of the normals of a million triangles alone: smaller than 1/10 pixel, that rounding picks a neighbour"},
    {"parity_sampled", 0.0005,
     "share of pixels of which samples tell just enough on one backend, and not on the other: the difference is what samples may "
     "leave"},
    {"parity_edge_share", 0.002,
     "CPU and GL round projected vertices to 1/256 pixel from differently rounded floats: pixels on an edge may see the other "
     "side"},
    {"truth_off_edges", 0.001, "relative RMSE of shadow-planes off edges: single precision and interpolated tables"},
    {"published_order", 20,
     "times truth_off_edges: what planes sorted as wholes are wrong by at least where they interleave (38 and 190 measured)"},
    {"truth_surface_off_edges", 0.0025,
     "of the surfaces alone, 0.0001 but for one pixel: a sliver seen edge-on, narrower than 1/100 pixel, hides from the eight "
     "points "
     "by which the truth finds edges"},
    {"truth_everywhere", 0.01,
     "the same with edges: vertices are rounded to 1/256 pixel, so a pixel at an edge may show its other side"},
    {"truth_marching", 0.015,
     "the same of marching by default, 32 steps; 512 in dense fog, where a step must not be long beside the free path, and 128 "
     "where a "
     "lamp stands in a Gaussian little larger than one of 32 steps"},
    {"truth_gaussians", 0.02, "relative RMSE of gaussian-airlight by default, four nodes a panel: what the knob promises"},
    {"truth_gaussians_fine", 0.002, "the same with eight nodes"},
    {"rendered_optical_depth", 3e-6,
     "of a way, beside the lines through the Gaussians' centres: single precision, and what their reach leaves out"},
    {"depths_of_the_nodes", 0.002, "relative RMSE: depth on the ray from four nodes a panel beside closed forms"},
    {"truth_light_volumes", 0.015,
     "eight nodes, lights looked up in volumes of three and six cells a radius: 1.2 % through optical depths of five and more"},
    {"truth_propagation", 0.015,
     "relative RMSE of opacity-propagation by default: steps that are not short beside the free path, and lamps nearer to what "
     "they "
     "light than a few cells"},
    {"truth_propagation_fine", 0.002, "the same with 160 cells and 512 steps"},
    {"depth_volume_32", 0.01,
     "relative RMS of optical depths looked up in a volume of 32 cells an edge, radii of three cells and more"},
    {"depth_volume_64", 0.003, "the same with 64"},
    {"truth_sampled", 0.01,
     "relative RMSE of gaussian-airlight with eight nodes at half and quarter resolution: the tolerance of DepthAwareUpsample, "
     "by "
     "pixel"},
    {"truth_published_airlight", 0.9,
     "relative RMSE of the airlight as Zhou et al. publish it, one sample a Gaussian: 0.03, in fog that outshines them, to 0.76"},
    {"truth_published_halo", 40,
     "the same where lamps stand in Gaussians: up to 34, as a sample may be a millimetre from the lamp"},
    {"published_equations", 1e-4,
     "of the largest: what reaches leave out, 1e-5 of each Gaussian in a way, single precision, the tables of fog"},
    {"truth_printed_erf", 0.001,
     "what the printed error function adds: 2e-4 of the whole line through a Gaussian, where that is an optical depth of a few"},
    {"truth_airlight_everywhere", 0.002,
     "the airlight alone with edges: what a pixel at an edge sees or misses of the ray behind it is little of a picture's "
     "airlight"},
    {"brute_force", 0.002, "relative RMSE off edges of 512 equal steps: of first order where a shadow begins within a step"},
    {"promise", 2, "times the error asked for: what a choice by the stored models may miss it by"},
    {"truth_edge_share", 0.01,
     "share of pixels within 1/100 pixel of an edge or of a shadow's boundary (0.0002 to 0.008 measured): all that "
     "truth_off_edges may leave out"},
    {"truth_stored", 1e-6,
     "of the image's mean, beyond rounding to float: the reference asks for 1e-9 of a pixel, C libraries differ in a last digit"},
    {"indirect_open", 2e-5, "relative: exact indirect light asked for to 1e-5, and the unbounded one's fixed rule, good to 1e-5"},
    {"indirect_plain_sum", 1e-2, "relative: twice 40 000 places in space, most of them shadowed or hidden; a million leave 7e-4"},
    {"riemann_sum", 1e-8, "relative, beyond half a step at each shadow boundary: rounding of sums of a million terms"},
    {"depth_lookup", 4e-6, "beside the largest value: a quotient and a difference before linear lookups with slopes of 1 a node"},
    {"injected_mass", 4e-6,
     "of a Gaussian's whole: differences of erf_, whose digits end at 1e-7, of cells a twentieth of the radius; a hundred times "
     "more "
     "where a cell is about as wide as the radius, whose negative values are left out"},
    {"grid_closed_form", 1e-11, "relative: the reference asks for 1e-11 of each integral, and a constant is exact in it"},
    {"paths_same_medium", 1e-8, "relative: the same paths through the same depths, whose places are known to 1e-13 of the line"},
    {"grid_depth", 1e-8, "optical depth: midpoint sums of a field with kinks at every cell, in steps of less than 1/2000 cell"},
    {"grid_riemann_sum", 2e-5,
     "relative: midpoint sums of 1500 steps of 6 mm through cells of 0.3 m with kinks, and of 600 to each light"},
    {"indirect_of_gaussians", 1e-4, "of the brightest: the tables, and what Gaussians' reach leaves out of a depth"},
    {"environment_indirect_plain_sum", 3e-2,
     "relative: 60 000 places leave 1e-2; the reference's fixed rule claims a few percent, of lobes and boxes"},
    {"environment_indirect_fog", 2e-3, "relative: nodes along each ray and patches of the sky of 22 degrees"},
    {"surface_airlight", 1e-3, "relative; cubic interpolation of 48 x 128 tables, shininess 1 to 1000"},
    {"surface_airlight_table", 2e-5,
     "relative; the same at the high-precision values alone, isotropic and far from the axes' ends"},
    {"surface_airlight_sun", 1e-4,
     "relative; Rayleigh's phase of a directional light, shininess to 300, whose lobe is 3 degrees wide"},
    {"surface_airlight_psf_double", 3e-7, "beside the top, and 1 + depth: six coefficients given as floats"},
    {"surface_airlight_psf", 3e-6,
     "the same in single precision: a polynomial of degree 5 whose terms are some times its sum, exp_"},
    {"surface_airlight_double", 1e-5,
     "relative; the quadrature that serves as truth for whole pictures, against the high-precision table"},
    {"surface_airlight_quadrature", 3e-3,
     "relative; 3e-5 but for a backward peak (g = -0.4) under a lobe of shininess 1000: there the nodes of the angle lie widest"},
    {"exact_double", 1e-14, "relative; a few roundings of a double"},
    {"exact_float", 2e-7, "relative; one or two roundings of a float"},
    {"float_ulp_of_double", 1e-6, "ULP of a float: exp_ and log_ in double are the C library's"},
    {"truth_network", 0.05, "relative RMSE of illumination-network with 4096 particles and 256 directions: what it promises"},
    {"truth_network_forward", 0.07,
     "relative, of the mean with 1024 particles and 128 directions where light scatters forward (g = 0.6): they are coarse "
     "beside "
     "the peak, and the mean of the paths is known to 0.01"},
    {"network_dense", 1e-5, "of the largest value: the iteration's sums of floats against elimination in double"},
    {"network_energy", 2e-6, "relative: out against in at albedo 1, after rounds until nothing but rounding changes"},
    {"network_line_depth", 2.5e-5, "absolute: of each of two Gaussians a chord below 1e-5 is left out, the rest is rounding"},
    {"network_moments", 4e-3,
     "[m, m^2] of 4096 low-discrepancy points in Gaussians of 0.5 and 0.7 m: random ones would be off by 1e-2"},
    {"link_shares_double", 5e-7, "relative: the series below 0.25 leaves out 0.25^5 / 2520 = 4e-7, and that of opacity"},
    {"link_shares", 3e-6, "relative: from 0.25 on, a difference that is a ninth of its terms, which are known to 2e-7"},
    {"sh_basis_double", 1e-6,
     "absolute: the direction is a unit vector to a float's accuracy alone, five times that of polynomials of degree 5"},
    {"sh_basis", 4e-6,
     "absolute: a unit vector rounded to floats, and polynomials of degree 5 whose terms are 8 times their sum"},
    {"sh_convolve_double", 1e-13, "absolute: sums of 36 terms in double"},
    {"sh_sums", 3e-6, "absolute: 36 terms of the basis times numbers up to 1"},
    {"sh_triple_double", 1e-6, "beside the peak: the integrals of three basis functions are given as floats"},
    {"sh_triple", 1e-6, "beside the peak: some 1500 products of three floats"},
    {"sh_bands_double", 1e-12, "relative or beside 1: the quadrature of the oracle"},
    {"sh_bands", 1e-6, "relative or beside 1: a square root, or up to six quotients and products"},
    {"average_gaussian_depth_double", 2e-7, "relative or absolute: the quotient of polynomials is 8e-8 off"},
    {"average_gaussian_depth", 1e-6, "relative or absolute: two polynomials of degree 8 with positive terms, and their quotient"},
    {"environment_value_double", 1e-6,
     "of differences of neighbouring pixels up to 1: the direction is a unit vector to a float's accuracy, "
     "32 pixels around; the turn is given as a float"},
    {"environment_value", 3e-5,
     "the same in single precision: places among 32 columns are known to 3e-6, near the poles' axis to 1e-5"},
    {"environment_share", 5e-4,
     "absolute: linear between 64 nodes over four widths of a lobe, and the sums that serve as oracle"},
    {"environment_reflection_double", 2e-6, "absolute: 36 terms whose coefficients, up to 2, are given as floats"},
    {"environment_reflection", 1e-5, "absolute: the same and their basis in single precision"},
    {"environment_scattered_double", 1e-7, "absolute, of 0 to 1: opacity's series; transmittance ends at 87"},
    {"environment_scattered", 5e-7, "the same in single precision: a quotient, two products, exp_"},
    {"npsf", 1e-6, "relative, against the high-precision table: quadrature whose nodes are floats"},
    {"npsf_printed", 4e-5, "absolute: the paper's six coefficients are right to 3e-5"},
    {"phase_coefficients", 2e-6, "absolute: quadrature whose nodes are floats; g = 0.99 is a peak of 1/100 rad"},
    {"environment_harmonics", 1e-4,
     "beside the first: midpoint sums over patches of 1.4 degrees, in the plan, and of 0.5 degrees"},
    {"environment_truth", 0.03,
     "relative, what the reference claims: all of the difference to patches twice as wide, 5.6 degrees on surfaces, 22 degrees "
     "in the medium"},
    {"environment_closed_form", 1e-4, "relative: sums over patches of 2.8 degrees and, of lobes, their horizon, extrapolated"},
    {"environment_seen", 1e-4,
     "relative RMSE: the view ray's transmittance, of whose depth Gaussians may lose 1e-4, and lookups"},
    {"environment_soft_matt", 3e-4, "relative RMSE of the light that surfaces reflect: bands beyond 5 of a smooth sky"},
    {"environment_soft_glossy", 0.025,
     "the same where the lobe meets the horizon of the surface: its share above is taken to gather what the whole one does"},
    {"environment_sharp_matt", 2e-3, "the same of a sky whose sun is 13 degrees wide: what of it lies in the bands beyond 5"},
    {"environment_sharp_glossy", 0.03, "the same with a lobe as narrow as that, and its horizon"},
    {"environment_thin_steam", 0.07,
     "the same in Gaussians of optical depth 0.5 to 1: one mean depth, of directions behind the surface too"},
    {"environment_thick_steam", 0.2, "the same of optical depth 1.5 to 3"},
    {"environment_airlight_fog", 0.015,
     "relative RMSE of airlight: bands beyond 5; of a peaked phase function the reference claims 1e-2"},
    {"environment_airlight_thin", 0.06,
     "the same in Gaussians of optical depth 0.5: their own depth stands for that of the light's ways"},
    {"environment_airlight_steam", 0.2, "the same of optical depth 1.5"},
    {"environment_airlight_thick", 0.6, "the same of optical depth 6, of which the light comes from the near side alone"},
    {"environment_airlight_published", 0.5,
     "the same as Zhou et al. print it, T exp(-T) and a function whose integral is 1.18: 33 to 44 % measured"},
    {"image_plane", 5e-7, "beside half the image or the number of cells: three to five roundings of a number up to that"},
    {"direction", 4e-7, "length of the difference from a unit vector, or beside the distance: a few roundings"},
    {"geometry_double", 1e-12, "roundings of a double, the oracle's among them, magnified by flat triangles"},
    {"perpendicular_double", 2e-7,
     "the ray is a unit vector to a float's accuracy alone: that of the inputs, whatever the build"},
    {"ray_triangle", 2e-6, "beside far / (height cosine): roundings of products of three differences"},
    {"phase_double", 1e-12,
     "relative; 1 + g^2 - 2 g mu at |g| = 0.99 magnifies roundings 1e4 times, the oracle's in long double"},
    {"transmittance", 3e-7, "relative, beside 1 + optical depth where that is a rounded product: exp_ and two roundings"},
    {"opacity_double", 2e-8, "relative: the series below 0.25 leaves out 0.25^7 / 8! = 1.5e-9"},
    {"opacity", 5e-7, "relative: exp_, the difference 1 - exp(-0.25), a quotient"},
    {"unit_distance", 1e-6, "relative; unit vectors rounded to floats are known to 1e-7"},
    {"phong_double", 1e-12, "beside 1 - n log(r.l): 1 - apart is rounded"},
    {"phong", 1e-6, "beside 1 - n log(r.l): log_, the product and exp_"},
    {"grid_value_double", 1e-12, "beside the largest value: the coordinate is rounded in both"},
    {"grid_value", 3e-6, "beside the largest value: a coordinate up to 13 cells is rounded three times"},
    {"erf", 3.5e-7, "absolute: 1.7e-7 where it is held, elsewhere roundings of two polynomials, their quotient and its product"},
    {"erf_printed", 2.01e-4,
     "absolute, and of depths beside the whole line: the paper's clamp is where erfc is 2.0012e-4, its polynomial leaves 1.7e-4; "
     "roundings of 3e-7"},
    {"atan", 3e-7, "relative: the polynomial's 2e-8, a quotient and a difference rounded"},
    {"left_out_depth", 1e-5,
     "of a Gaussian whose reach a way does not meet, and of its whole line: what the reach is chosen for"},
    {"depths_exponent", 0.12,
     "of pairs that the sweep visits, by the number of Gaussians: boxes are wider than cones, and where few are met the edge of "
     "their cloud counts"},
    {"gaussian_table", 1e-7, "beside the whole line: the inputs are given as floats, which moves an end by 1e-7 of its distance"},
    {"gaussian_depth", 6e-7, "beside the whole line: half the difference of two erf_, exp_ of a rounded square"},
    {"light_density", 2.5e-6,
     "relative, beside 1 + optical depth: a phase value, exp_, the distance from the light and a quotient"},
    {"graded_step", 1e-5, "beside the logarithm of the whole: exp_ and log_ of numbers rounded beside 1"},
    {"step_phase", 1e-2,
     "beside the mean and a tenth of the isotropic one: a step seen in 0.2 rad takes the phase halfway, second order in the "
     "angle"},
    {"step_angle", 2e-6, "beside the angle and 1 % of half a turn: the differences from the foot are rounded"},
    {"step_means", 1e-2,
     "beside the step: one of a tenth of the light's distance takes the half angle for the means, 0.1 / 12 away where it points "
     "at the light"},
    {"upsampled", 6e-7, "beside the largest sample: three or four fused steps of numbers up to that"},
    {"depth_fit_double", 1e-12, "of 1: the inputs' quotient, magnified by the tolerance"},
    {"depth_fit", 1e-6, "of 1: a product and a quotient rounded, squared; the difference of ends so near is exact"},
    {"weighted_mean_double", 2e-7, "beside the largest sample: weights are floats, whose sum is 1 to rounding"},
    {"gradient_noise", 1e-6, "absolute, of up to 1.05: eight products of rounded weights, seven steps between them"},
    {"noise_smooth", 1e-3,
     "a second difference over a step of 1/512, at faces of cells, where the second derivative is 0: of third order, and "
     "roundings"},
    {"bent_ray", 1e-4,
     "length, of a unit vector: noise is taken at up to 456 cells, where a float tells 3e-5 of one, and its slope is below 2.5"},
    {"airlight_allowed", 1, "a multiple of airlight_value of the value and airlight_end of the end value"},
};

inline double tolerance(std::string_view name) {
  for (const Tolerance& t : tolerances) {
    if (t.name == name) return t.value;
  }
  throw std::logic_error("no such tolerance: " + std::string(name));
}

}  // namespace airlight
