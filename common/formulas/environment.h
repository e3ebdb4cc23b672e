// Light that comes from everywhere, given by direction: an image of latitude and longitude, top row +Y, centre -Z, columns toward +X.

// Of a unit direction: its place in the image, both in 0..1 from the left and from the top.
FORMULA void environment_place(real x, real y, real z, OUT(real) turns, OUT(real) polar) {
  real level = sqrt(fma(x, x, z * z));
  real azimuth = atan_(abs(x) / max(abs(z), 1e-30)) * 0.15915494309189535;
  azimuth = select(z > 0.0, 0.5 - azimuth, azimuth);
  turns = select(x < 0.0, 0.5 - azimuth, 0.5 + azimuth);
  real below = atan_(level / max(abs(y), 1e-30)) * 0.31830988618379067;
  polar = select(y < 0.0, 1.0 - below, below);
}

// Radiance there in one of three channels, linear between the centres of pixels; beyond the first and last rows' theirs. The table: width,
// height, what is added to `turns`, 0; then rows of three lines, one a channel, of the width and the first pixel again; and a line of zeros.
FORMULA real environment_value(table t, int channel, real turns, real polar) {
  real width = element(t, 0);
  real height = element(t, 1);
  real turned = turns + element(t, 2);
  turned = turned - floor(turned);
  real column = fma(turned, width, real(-0.5));
  column = select(column < 0.0, column + width, column);
  real i = min(floor(column), width - 1.0);
  real row = min(max(fma(polar, height, real(-0.5)), 0.0), height - 1.0);
  real j = min(floor(row), height - 2.0);
  return weighted_cell(t + 4, i, real(channel), j, width + 1.0, real(3.0), column - i, real(0.0), row - j);
}

// Optical depth of exp(-|x|^2) along half-lines from a place u away from the centre, in the mean over all directions (Zhou et al. 2007, 4.2,
// whose T lacks the minus), by u^2: sqrt(pi) / 2 Dawson(u) / u. Of a Gaussian: times its extinction and its radius, in which u is told. A
// quotient of polynomials in y = (u^2 - 7) / (u^2 + 7), found by Lawson's reweighting of least squares; relative error 8e-8 for all u.
FORMULA real average_gaussian_depth(real squared) {
  real y = 1.0 - 14.0 / (squared + 7.0);
  real p = fma(y, real(0.103649886), real(1.98473015));
  p = fma(y, p, real(2.84572912));
  p = fma(y, p, real(6.55698387));
  p = fma(y, p, real(6.96205605));
  p = fma(y, p, real(4.34492186));
  p = fma(y, p, real(4.41745729));
  p = fma(y, p, real(0.82307538));
  p = fma(y, p, real(1.17673213));
  real q = fma(y, real(0.2734103), real(1.54601624));
  q = fma(y, q, real(3.96785137));
  q = fma(y, q, real(6.12349923));
  q = fma(y, q, real(6.64877957));
  q = fma(y, q, real(4.95456995));
  q = fma(y, q, real(3.61558412));
  q = fma(y, q, real(1.08562685));
  q = fma(y, q, real(1.0));
  return 0.88622692545275801 * p / (q * fma(squared, real(2.0), real(1.0)));
}

// How much of a cosine lobe about a direction lies above the horizon of a normal, by the cosine between the two: 1/2 to 1. The table: by what
// the cosine is multiplied to count its nodes, then 65 of them.
FORMULA real environment_share(table t, real cosine) {
  real q = min(max(cosine, 0.0) * element(t, 0), 64.0);
  real i = min(floor(q), 63.0);
  real low = fetch(t, i + 1.0);
  return fma(q - i, fetch(t, i + 2.0) - low, low);
}

// Radiance that a normalised lobe about a unit direction reflects: the table has 36 coefficients a channel of the environment convolved with the
// lobe, about +Y as their axis and from -Z on. Not below 0, where a cut-off expansion may swing.
FORMULA void environment_reflection(table t, real x, real y, real z, OUT(real) red, OUT(real) green, OUT(real) blue) {
  real v[36];
  sh_basis(6, -z, x, y, v);
  red = max(sh_sum(t, 6, v), 0.0);
  green = max(sh_sum(t + 36, 6, v), 0.0);
  blue = max(sh_sum(t + 72, 6, v), 0.0);
}

// How much of an environment's light a view ray scatters toward the camera, per unit of albedo and of what the phase function gathers, of the
// homogeneous part and of the rest, by the optical depths of both along the ray. Light is attenuated on its way to the ray by the rest
// alone, in the mean over all directions about as much as the ray up to there: int exp(-(h + 2 g)) of both.
FORMULA void environment_scattered(real homogeneous, real rest, OUT(real) of_homogeneous, OUT(real) of_rest) {
  real both = fma(rest, real(2.0), homogeneous);
  real scale = 1.0 / max(both, 1e-30);
  real thick = opacity(both);
  of_homogeneous = thick * (homogeneous * scale);
  of_rest = thick * (rest * scale);
}

// The same of the medium as a whole as Zhou et al. 2007 have it, eq. 18 and 28.
FORMULA real environment_scattered_published(real tau) {
  return min(tau, 1e4) * transmittance(tau);
}

// How much of an environment's light the medium scatters once toward a surface, of the homogeneous part and of the rest, by the mean depth of the
// rest over all directions from there; per unit of albedo and of what phase function and lobe gather. The rest attenuates the light on its way to
// each place about as much as the way on from there to the surface: int exp(-2 t) over the depth. The homogeneous part lies around all of that and
// has no end; what it scatters arrives as the environment itself does.
FORMULA void environment_scattered_to_surface(real rest, OUT(real) of_homogeneous, OUT(real) of_rest) {
  of_homogeneous = transmittance(rest);
  of_rest = opacity(rest * 2.0) * 0.5;
}
