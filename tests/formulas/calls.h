// Every formula under one signature, in the dialect of common/formulas, so that one caller a build reaches them all. INPUTS is an
// array of 14 reals `a`, RESULTS one of 3 reals `r`. The numbers are those of Formula in tests/formulas/checks/check.h.

// A grid as grid_extinction() takes it: its value at (x, y, z) from the corner of the box; outside, the outermost values or none.
FORMULA real grid_value(table t, int clamped, real x, real y, real z, real size_x, real size_y, real size_z) {
  real nx = element(t, 0);
  real ny = element(t, 1);
  real nz = element(t, 2);
  real cx = grid_coordinate(x, size_x, nx);
  real cy = grid_coordinate(y, size_y, ny);
  real cz = grid_coordinate(z, size_z, nz);
  if (clamped == 0) return grid_extinction(t, 0, cx, cy, cz);
  real i;
  real j;
  real k;
  real u;
  real v;
  real w;
  grid_lookup_clamped(cx, nx, i, u);
  grid_lookup_clamped(cy, ny, j, v);
  grid_lookup_clamped(cz, nz, k, w);
  return weighted_cell(t + 3, i + 1.0, j + 1.0, k + 1.0, nx + 2.0, ny + 2.0, u, v, w);
}

FORMULA void call_harmonics(int formula, table t, int kind, INPUTS, RESULTS) {
  if (formula == 71) r[0] = sh_value(t, kind, a[0], a[1], a[2]);
  if (formula == 75) {
    r[0] = sh_delta(kind);
    r[1] = sh_zonal_factor(kind);
    r[2] = sh_lobe_factor(kind, a[0]);
  }
  if (formula == 74) {
    real f[36];
    real g[36];
    real h[36];
    sh_basis(kind, a[0], a[1], a[2], f);
    sh_basis(kind, a[3], a[4], a[5], g);
    sh_basis(kind, a[6], a[7], a[8], h);
    r[0] = sh_triple_product(t, f, g, h);
  }
  if ((formula == 70) || (formula == 72) || (formula == 73)) {
    real v[36];
    if (formula == 70) sh_basis(6, a[0], a[1], a[2], v);
    if (formula == 72) sh_rotated(t, 6, a[0], a[1], a[2], v);
    if (formula == 73) {
      for (int i = 0; i < 36; ++i) v[i] = element(t, 6 + i) * a[0];
      sh_convolve(t, 6, v);
    }
    for (int k = 0; k < 3; ++k) r[k] = v[3 * kind + k];
  }
}

FORMULA void call_environment(int formula, table t, int kind, INPUTS, RESULTS) {
  if (formula == 76) r[0] = average_gaussian_depth(a[0]);
  if (formula == 77) {
    real turns;
    real polar;
    environment_place(a[0], a[1], a[2], turns, polar);
    r[0] = environment_value(t, kind, turns, polar);
  }
  if (formula == 78) r[0] = environment_share(t, a[0]);
  if (formula == 80) {
    environment_scattered(a[0], a[1], r[0], r[1]);
    r[2] = environment_scattered_published(a[0]);
  }
  if (formula == 82) environment_scattered_to_surface(a[0], r[0], r[1]);
  if (formula == 83) r[0] = value_among_nodes(t + 1, 0, real(5.0), real(4.0), real(3.0), a[0], a[1], a[2]);
  if (formula == 79) environment_reflection(t, a[0], a[1], a[2], r[0], r[1], r[2]);
}

FORMULA void call_brdf(int formula, table t, INPUTS, RESULTS) {
  if (formula == 90) half_angles(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], r[0], r[1], r[2]);
  if (formula == 91) brdf_reflection(t, a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], r[0], r[1], r[2]);
  if (formula == 92) brdf_environment(t, t + 108, a[0], a[1], a[2], a[3], a[4], a[5], r[0], r[1], r[2]);
  if (formula == 93) {
    real red[36];
    real green[36];
    real blue[36];
    for (int i = 0; i < 36; ++i) {
      red[i] = element(t, i);
      green[i] = element(t, 36 + i);
      blue[i] = element(t, 72 + i);
    }
    brdf_environment_part(red, green, blue, t + 108, a[0], a[1], a[2], a[3], a[4], a[5], r[0], r[1], r[2]);
  }
}

FORMULA void call_formula(int formula, table t, int kind, real g, INPUTS, RESULTS) {
  if (formula == 0) r[0] = exp_(a[0]);
  if (formula == 48) r[0] = exp2_(a[0]);
  if (formula == 1) r[0] = log_(a[0]);
  if (formula == 2) r[0] = phase_value(kind, g, a[0]);
  if (formula == 3) r[0] = point_airlight(t, kind, g, a[0], a[1], a[2], a[3], a[4]);
  if (formula == 4) r[0] = directional_airlight(kind, g, a[0], a[1], a[2], a[3]);
  if (formula == 5) r[0] = grid_coordinate(a[0], a[1], a[2]);
  if (formula == 6) grid_lookup_zero(a[0], a[1], r[0], r[1]);
  if (formula == 7) grid_lookup_clamped(a[0], a[1], r[0], r[1]);
  if (formula == 8) r[0] = grid_value(t, 0, a[0], a[1], a[2], a[3], a[4], a[5]);
  if (formula == 9) r[0] = grid_value(t, 1, a[0], a[1], a[2], a[3], a[4], a[5]);
  if (formula == 10) r[0] = ray_length(a[0], a[1]);
  if (formula == 11) r[0] = optical_depth(a[0], a[1]);
  if (formula == 12) r[0] = transmittance(a[0]);
  if (formula == 13) r[0] = opacity(a[0]);
  if (formula == 14) r[0] = mean_transmittance(a[0]);
  if (formula == 15) r[0] = attenuated_length(a[0], a[1], optical_depth(a[0], a[1]));
  if (formula == 16) r[0] = point_irradiance(a[0], a[1], a[2]);
  if (formula == 17) r[0] = lambert(a[0]);
  if (formula == 18) r[0] = unit_distance(a[0], a[1], a[2], a[3], a[4], a[5]);
  if (formula == 19) r[0] = phong(a[0], a[1], a[2]);
  if (formula == 20) {
    ray_triangle(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11], r[0], r[1], r[2]);
  }
  if (formula == 21) {
    shading_normal(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11], a[12], a[13], r[0], r[1], r[2]);
  }
  if (formula == 85) r[0] = seen_side(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11], a[12], a[13]);
  if (formula == 86) r[0] = between_corners(a[0], a[1], a[2], a[3], a[4]);
  if (formula == 22) r[0] = image_plane_x(a[0], a[1], a[2], a[3], a[4]);
  if (formula == 23) r[0] = image_plane_y(a[0], a[1], a[2], a[3]);
  if (formula == 24) view_ray(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], r[0], r[1], r[2]);
  if (formula == 26) r[0] = erf_(a[0]);
  if (formula == 27) r[0] = atan_(a[0]);
  if (formula == 28) r[0] = gaussian_falloff(a[0], a[1]);
  if (formula == 29) r[0] = gaussian_depth(0, a[0], a[1], a[2], a[3]);
  if (formula == 35) r[0] = gaussian_depth_beyond(0, a[0], a[1], a[2]);
  if (formula == 53) {
    r[0] = min(a[0], a[1]);
    r[1] = max(a[0], a[1]);
  }
  if (formula == 50) r[0] = gaussian_erf(1, a[0]);
  if (formula == 51) r[0] = gaussian_depth(1, a[0], a[1], a[2], a[3]);
  if (formula == 52) r[0] = gaussian_depth_beyond(1, a[0], a[1], a[2]);
  if (formula == 36) r[0] = gaussian_whole(a[0], a[1]);
  if (formula == 66) r[0] = gaussian_nearest(gaussian_erf(0, a[0]), gaussian_erf(0, a[1]));
  if (formula == 37) {
    r[0] = airlight_density(kind, g, a[0], a[1], a[2], a[3], a[4]);
    r[1] = directional_density(kind, g, a[0], a[5], a[3], a[4]);
  }
  if (formula == 38) r[0] = select(ray_ended(a[0], a[1], a[2]), real(1.0), real(0.0));
  if (formula == 33) r[0] = grid_bound(t, a[0], a[1], a[2], a[3], a[4], a[5]);
  if (formula == 30) r[0] = graded_step(a[0], a[1], a[2], a[3]);
  if (formula == 31) {
    real ra = sqrt(fma(a[0] - a[2], a[0] - a[2], a[3] * a[3]));
    real rb = sqrt(fma(a[1] - a[2], a[1] - a[2], a[3] * a[3]));
    r[0] = step_angle(a[0], a[1], ra, rb, a[2], a[3], 1.0 / a[3]);
    step_means(a[0], a[1], ra, rb, a[2], a[3], r[0], r[1], r[2]);
  }
  if (formula == 34) {
    r[0] = step_phase(kind, g, a[0], a[1], sqrt(fma(a[0], a[0], a[2] * a[2])), sqrt(fma(a[1], a[1], a[2] * a[2])), a[2]);
  }
  if (formula == 39) {
    real ra2 = fma(a[0], a[0], a[2] * a[2]);
    real rb2 = fma(a[1], a[1], a[2] * a[2]);
    real s = a[0] / sqrt(ra2);
    real c = a[2] / sqrt(ra2);
    real sine;
    real cosine;
    r[0] = step_parts(s, c, a[1] / sqrt(rb2), a[2] / sqrt(rb2), sine, cosine);
    r[1] = end_of_part(sine, cosine, s, c, a[0], a[1], real(0.0), a[2], s, c);
    r[2] = select(may_have_parts(a[1] - a[0], min(ra2, rb2)), real(1.0), real(0.0));
  }
  if (formula == 32) r[0] = step_transmittance(a[0], a[1], a[2], a[3]);
  if (formula == 49) r[0] = weighted_half_cell(t + 1, a[0], a[1], a[2], real(31.0), real(32.0), a[3], a[4], a[5]);
  if (formula == 40) r[0] = depth_in_volume(t, kind, 0, a[0], a[1], a[2]);
  if (formula == 41) {
    real face = cube_face(a[0], a[1], a[2], r[0], r[1], r[2]);
    r[0] = select(face < 6.0, r[0], real(1e30));
  }
  if (formula == 42) r[0] = sharpened_depth(a[0], a[1], a[2]);
  if (formula == 43) r[0] = injected_gaussian(a[0], a[1], a[2]);
  if (formula == 44) r[0] = depth_beside(kind, a[0], a[1], a[2]);
  if (formula == 45) link_shares(a[0], a[1], r[0], r[1], r[2]);
  if (formula == 46) r[0] = source_in_volume(t, kind, a[0], a[1], a[2]);
  if (formula == 47) {
    r[0] = surface_airlight_point(t, a[0], a[1]);
    r[1] = surface_airlight_directional(t, a[1]);
  }
  if (formula == 60) {
    r[0] = upsampled(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9]);
    r[1] = upsampling_error(abs(a[4]), abs(a[5]), abs(a[6]), abs(a[7]), a[8], a[9]);
  }
  if (formula == 61) {
    r[0] = bend_between(a[0], a[1], a[2], a[3], a[4] > 0.5, a[5] > 0.5);
    r[1] = bend_size(a[0], a[1], a[2], a[3], a[4] > 0.5, a[5] > 0.5);
  }
  if (formula == 62) r[0] = depth_fit(a[0], a[1], a[2]);
  if (formula == 63) r[0] = weighted_mean(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]);
  if (formula == 64) gradient_noise(a[0], a[1], a[2], r[0], r[1], r[2]);
  if (formula == 65) bent_ray(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11], r[0], r[1], r[2]);
  if ((formula >= 70) && (formula < 76)) call_harmonics(formula, t, kind, a, r);
  if ((formula >= 76) && (formula <= 83) && (formula != 81)) call_environment(formula, t, kind, a, r);
  if (formula == 81) r[0] = surface_airlight_psf(t, a[0], a[1]);
  if ((formula >= 90) && (formula < 95)) call_brdf(formula, t, a, r);
  if (formula == 95) r[0] = splat_before(a[0]);
  if (formula == 96) r[0] = splat_depth(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], r[1]);
  if (formula == 97) r[0] = splat_opacity(a[0]);
  if (formula == 98) r[0] = direction_weight(a[0], a[1]);
  if (formula == 25) perpendicular(a[0], a[1], a[2], a[3], a[4], a[5], a[6], r[0], r[1]);
}
