// Every formula under one signature, in the dialect of common/formulas, so that one caller a build reaches them all. INPUTS is an
// array of 14 reals `a`, RESULTS one of 3 reals `r`. The numbers are those of Formula in tests/formulas/checks/check.h.

// A voxel of a grid in a table: three sizes, then the values, x fastest; 0 outside.
FORMULA real voxel_or_zero(table t, real i, real j, real k) {
  real nx = element(t, 0);
  real ny = element(t, 1);
  real nz = element(t, 2);
  mask inside = (i >= 0.0) && (i < nx) && (j >= 0.0) && (j < ny) && (k >= 0.0) && (k < nz);
  real ci = min(max(i, 0.0), nx - 1.0);
  real cj = min(max(j, 0.0), ny - 1.0);
  real ck = min(max(k, 0.0), nz - 1.0);
  return select(inside, fetch(t, (ck * ny + cj) * nx + ci + 3.0), real(0.0));
}

FORMULA real trilinear(table t, real i, real j, real k, real u, real v, real w) {
  real y0z0 = (1.0 - u) * voxel_or_zero(t, i, j, k) + u * voxel_or_zero(t, i + 1.0, j, k);
  real y1z0 = (1.0 - u) * voxel_or_zero(t, i, j + 1.0, k) + u * voxel_or_zero(t, i + 1.0, j + 1.0, k);
  real y0z1 = (1.0 - u) * voxel_or_zero(t, i, j, k + 1.0) + u * voxel_or_zero(t, i + 1.0, j, k + 1.0);
  real y1z1 = (1.0 - u) * voxel_or_zero(t, i, j + 1.0, k + 1.0) + u * voxel_or_zero(t, i + 1.0, j + 1.0, k + 1.0);
  return (1.0 - w) * ((1.0 - v) * y0z0 + v * y1z0) + w * ((1.0 - v) * y0z1 + v * y1z1);
}

FORMULA real grid_value(table t, int clamped, real x, real y, real z, real size_x, real size_y, real size_z) {
  real cx = grid_coordinate(x, size_x, element(t, 0));
  real cy = grid_coordinate(y, size_y, element(t, 1));
  real cz = grid_coordinate(z, size_z, element(t, 2));
  real i;
  real j;
  real k;
  real u;
  real v;
  real w;
  if (clamped == 1) {
    grid_lookup_clamped(cx, element(t, 0), i, u);
    grid_lookup_clamped(cy, element(t, 1), j, v);
    grid_lookup_clamped(cz, element(t, 2), k, w);
  } else {
    grid_lookup_zero(cx, element(t, 0), i, u);
    grid_lookup_zero(cy, element(t, 1), j, v);
    grid_lookup_zero(cz, element(t, 2), k, w);
  }
  return trilinear(t, i, j, k, u, v, w);
}

FORMULA void call_formula(int formula, table t, int kind, real g, INPUTS, RESULTS) {
  if (formula == 0) r[0] = exp_(a[0]);
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
  if (formula == 22) r[0] = image_plane_x(a[0], a[1], a[2], a[3], a[4]);
  if (formula == 23) r[0] = image_plane_y(a[0], a[1], a[2], a[3]);
  if (formula == 24) view_ray(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], r[0], r[1], r[2]);
  if (formula == 25) perpendicular(a[0], a[1], a[2], a[3], a[4], a[5], a[6], r[0], r[1]);
}
