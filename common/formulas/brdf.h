// Tabulated isotropic reflectances (BRDFs) over the angles of the half vector (Rusinkiewicz 1998), laid out as the MERL database has them
// (Matusik et al. 2003).

// Of unit vectors: the normal, the directions to the light and to the viewer, both above its horizon. The angle of their half vector with the
// normal and with either of them, both 0..pi/2, and the azimuth of the light about the half vector, counted from the continuation of the normal's
// plane, modulo pi: to exchange light and viewer turns it by pi. Of the half vector's length only quotients remain: theirs are the lengths
// of l + v and l - v.
FORMULA void half_angles(real nx, real ny, real nz, real lx, real ly, real lz, real vx, real vy, real vz, OUT(real) theta_half, OUT(real) theta_difference,
                         OUT(real) phi_difference) {
  real hx = lx + vx;
  real hy = ly + vy;
  real hz = lz + vz;
  real cx = fma(ny, hz, -(nz * hy));
  real cy = fma(nz, hx, -(nx * hz));
  real cz = fma(nx, hy, -(ny * hx));
  real up = fma(nx, hx, fma(ny, hy, nz * hz));
  theta_half = atan_(sqrt(fma(cx, cx, fma(cy, cy, cz * cz))) / max(up, 1e-15));
  real dx = lx - vx;
  real dy = ly - vy;
  real dz = lz - vz;
  real sum = max(sqrt(fma(hx, hx, fma(hy, hy, hz * hz))), 1e-15);
  theta_difference = atan_(sqrt(fma(dx, dx, fma(dy, dy, dz * dz))) / sum);
  real across = 2.0 * fma(cx, lx, fma(cy, ly, cz * lz)) / sum;
  real along = -fma(nx, dx, fma(ny, dy, nz * dz));
  real angle = atan_(abs(across) / max(abs(along), 1e-15));
  mask other = ((across < 0.0) && (along > 0.0)) || ((across > 0.0) && (along < 0.0));
  phi_difference = select(other, 3.14159265358979324 - angle, angle);
}

// What a surface sends toward the viewer per unit of irradiance on a plane that faces the light: the reflectance times the cosine, 0 where the
// light is below the horizon. Linear an axis at a time between the centres of the table's cells, of the square root of theta_half, of theta_difference
// and of phi_difference, which goes round; the outermost centres hold beyond. The table: numbers of cells of phi_difference, theta_difference
// and theta_half, each 2 or more, then red, green and blue [1/sr], phi fastest, its first cell again at each row's end, theta_half slowest.
FORMULA void brdf_reflection(table t, real nx, real ny, real nz, real lx, real ly, real lz, real vx, real vy, real vz, OUT(real) red, OUT(real) green,
                             OUT(real) blue) {
  real theta_half;
  real theta_difference;
  real phi_difference;
  half_angles(nx, ny, nz, lx, ly, lz, vx, vy, vz, theta_half, theta_difference, phi_difference);
  real phis = element(t, 0);
  real differences = element(t, 1);
  real halves = element(t, 2);
  real column = fma(phi_difference * 0.318309886183790672, phis, real(-0.5));
  column = select(column < 0.0, column + phis, column);
  real i = min(floor(column), phis - 1.0);
  real j;
  real k;
  real v;
  real w;
  grid_lookup_clamped(fma(theta_difference * 0.636619772367581343, differences, real(-0.5)), differences, j, v);
  grid_lookup_clamped(fma(sqrt(theta_half * 0.636619772367581343), halves, real(-0.5)), halves, k, w);
  real cosine = max(fma(nx, lx, fma(ny, ly, nz * lz)), 0.0);
  red = cosine * weighted_cell(t + 3, i, j, k, phis + 1.0, differences, column - i, v, w);
  green = cosine * weighted_cell(t + 3, i, j, k + halves, phis + 1.0, differences, column - i, v, w);
  blue = cosine * weighted_cell(t + 3, i, j, fma(halves, 2.0, k), phis + 1.0, differences, column - i, v, w);
}

// How a surface sees a tabulated reflectance's lobes in brdf_environment(), by its normal and the direction to the viewer: where the weights of the
// viewing angle before this one's begin in `lobes`, and the weight of the next; toward the viewer in the plane of view, of length 1 / scale.
FORMULA void brdf_view(table lobes, real nx, real ny, real nz, real vx, real vy, real vz, OUT(real) first, OUT(real) weight, OUT(real) tx, OUT(real) ty,
                       OUT(real) tz, OUT(real) scale) {
  real level = min(max(fma(nx, vx, fma(ny, vy, nz * vz)), 0.0), 1.0);
  // Across the plane; where the viewer is in the direction of the normal any will do, as the lobe is round.
  real bx = fma(ny, vz, -(nz * vy));
  real by = fma(nz, vx, -(nx * vz));
  real bz = fma(nx, vy, -(ny * vx));
  mask overhead = fma(bx, bx, fma(by, by, bz * bz)) < 1e-12;
  mask upright = abs(ny) > 0.7;
  bx = select(overhead, select(upright, real(0.0), nz), bx);
  by = select(overhead, select(upright, nz, real(0.0)), by);
  bz = select(overhead, select(upright, -ny, -nx), bz);
  tx = fma(by, nz, -(bz * ny));
  ty = fma(bz, nx, -(bx * nz));
  tz = fma(bx, ny, -(by * nx));
  scale = 1.0 / sqrt(max(fma(tx, tx, fma(ty, ty, tz * tz)), 1e-30));
  real last = element(lobes, 12) - 1.0;
  real at = sqrt(1.0 - level) * last;
  real node = min(floor(at), last - 1.0);
  weight = at - node;
  first = fma(node, real(108.0), real(13.0));
}

// The basis at one of the lobes' axes.
FORMULA void brdf_axis(table lobes, int axis, real nx, real ny, real nz, real tx, real ty, real tz, real scale, OUT_LIST(f, 36)) {
  real c = element(lobes, axis);
  real s = element(lobes, 6 + axis) * scale;
  sh_basis(6, -fma(s, tz, c * nz), fma(s, tx, c * nx), fma(s, ty, c * ny), f);
}

// What the lobe sends of an environment's band l about an axis, given each channel's there.
FORMULA void brdf_add_band(table lobes, int axis, int l, real first, real weight, real r, real g, real b, IN_OUT_LIST(sent, 3)) {
  real place = first + real(18 * axis + 3 * l);
  real low = fetch(lobes, place);
  sent[0] = fma(fma(weight, fetch(lobes, place + 108.0) - low, low), r, sent[0]);
  low = fetch(lobes, place + 1.0);
  sent[1] = fma(fma(weight, fetch(lobes, place + 109.0) - low, low), g, sent[1]);
  low = fetch(lobes, place + 2.0);
  sent[2] = fma(fma(weight, fetch(lobes, place + 110.0) - low, low), b, sent[2]);
}

// Radiance that a surface sends toward the viewer of an environment, by harmonics of order 6 of both. `harmonics`: the environment's, 36 a channel, about
// +Y as their axis and from -Z on. For each viewing angle the lobe, the reflectance times the cosine, is the same on both sides of the plane of view; such
// a function's band is a sum of six zonal ones about axes in that plane (Nowrouzezahrai et al. 2012), so that nothing needs to be turned: the
// environment's band is looked up at each axis. `lobes`: cosine and sine of the six axes' angles from the normal toward the viewer; the number of
// viewing angles, evenly spaced in the square root of 1 - cosine; then for each of them 108 weights: axes, bands, channels. Not below 0, where a
// cut-off expansion may swing.
FORMULA void brdf_environment(table harmonics, table lobes, real nx, real ny, real nz, real vx, real vy, real vz, OUT(real) red, OUT(real) green, OUT(real) blue) {
  real first;
  real weight;
  real tx;
  real ty;
  real tz;
  real scale;
  brdf_view(lobes, nx, ny, nz, vx, vy, vz, first, weight, tx, ty, tz, scale);
  real sent[3];
  for (int c = 0; c < 3; ++c) sent[c] = real(0.0);
  for (int axis = 0; axis < 6; ++axis) {
    real f[36];
    brdf_axis(lobes, axis, nx, ny, nz, tx, ty, tz, scale, f);
    for (int l = 0; l < 6; ++l) {
      brdf_add_band(lobes, axis, l, first, weight, sh_band(harmonics, l, f), sh_band(harmonics + 36, l, f), sh_band(harmonics + 72, l, f), sent);
    }
  }
  red = max(sent[0], 0.0);
  green = max(sent[1], 0.0);
  blue = max(sent[2], 0.0);
}

// The same of a part of an environment that is given as lists, as it comes out: what of it is hidden is taken away from all of it.
FORMULA void brdf_environment_part(IN_LIST(r, 36), IN_LIST(g, 36), IN_LIST(b, 36), table lobes, real nx, real ny, real nz, real vx, real vy, real vz, OUT(real) red,
                                   OUT(real) green, OUT(real) blue) {
  real first;
  real weight;
  real tx;
  real ty;
  real tz;
  real scale;
  brdf_view(lobes, nx, ny, nz, vx, vy, vz, first, weight, tx, ty, tz, scale);
  real sent[3];
  for (int c = 0; c < 3; ++c) sent[c] = real(0.0);
  for (int axis = 0; axis < 6; ++axis) {
    real f[36];
    brdf_axis(lobes, axis, nx, ny, nz, tx, ty, tz, scale, f);
    for (int l = 0; l < 6; ++l)
      brdf_add_band(lobes, axis, l, first, weight, sh_list_band(r, l, f), sh_list_band(g, l, f), sh_list_band(b, l, f), sent);
  }
  red = sent[0];
  green = sent[1];
  blue = sent[2];
}
