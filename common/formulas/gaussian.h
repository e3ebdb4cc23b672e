// Gaussians of extinction, c exp(-|x - center|^2 / radius^2); on a ray c exp(-(h^2 + (t - foot)^2) / radius^2), h and foot as from perpendicular().

// Extinction at a distance from the centre, beside c. From exp(-60) on it is held: no denormal arises.
FORMULA real gaussian_falloff(real inverse_radius, real distance_squared) {
  return exp2_(max(distance_squared * (inverse_radius * inverse_radius * -1.4426950408889634), -86.5));
}

// What a Gaussian has at a distance h from its centre, beside c: on a ray, its part in every place.
FORMULA real gaussian_lateral(real inverse_radius, real h) {
  return gaussian_falloff(inverse_radius, h * h);
}

// The error function as Zhou et al. 2007 print it below eq. 31, for speed: absolute error 2.0e-4, the largest where it steps by 3e-5 to 1.
FORMULA real erf_printed(real x) {
  real t = min(max(x, -2.629639), 2.629639);
  real z = fma(t * t, real(0.289226), real(-1.0));
  real q = fma(z, real(0.0145688), real(-0.0348595));
  q = fma(z, q, real(0.0503913));
  q = fma(z, q, real(-0.0897001));
  q = fma(z, q, real(0.156097));
  q = fma(z, q, real(-0.249431));
  q = fma(z, q, real(0.533201));
  real p = select(x > 2.629639, real(1.0), t * q);
  return select(x < -2.629639, real(-1.0), p);
}

// By what optical depths are taken: 0 erf_, 1 erf_printed.
FORMULA real gaussian_erf(int kind, real x) {
  if (kind == 1) return erf_printed(x);
  return erf_(x);
}

// Optical depth between two places, as a share of the whole line through the centre, c radius sqrt(pi); given the error function of the places, counted from the foot in radii.
FORMULA real gaussian_between(real lateral, real erf_from, real erf_to) { return 0.5 * lateral * max(erf_to - erf_from, 0.0); }

// The same between `from` and `to`, both counted from the foot [m]; erf: as in gaussian_erf().
FORMULA real gaussian_depth(int erf, real inverse_radius, real h, real from, real to) {
  return gaussian_between(gaussian_lateral(inverse_radius, h), gaussian_erf(erf, from * inverse_radius), gaussian_erf(erf, to * inverse_radius));
}

// The same from `from` on, without an end.
FORMULA real gaussian_depth_beyond(int erf, real inverse_radius, real h, real from) {
  return gaussian_between(gaussian_lateral(inverse_radius, h), gaussian_erf(erf, from * inverse_radius), real(1.0));
}

// Optical depth of the whole line through the centre.
FORMULA real gaussian_whole(real extinction, real radius) { return extinction * radius * 1.7724538509055160; }

// The error function of that place of a stretch which is nearest to the foot, given the error function of its ends: there a Gaussian is sampled by its projection
// (Zhou et al. 2007, eq. 10 and their note 1).
FORMULA real gaussian_nearest(real erf_from, real erf_to) { return max(erf_from, min(erf_to, 0.0)); }
