// Particles as they are splatted (common/algorithms/particle_splats.h). A splat is a ball of radius `support` about a particle. A ray that passes the
// centre at h sees the optical depth peak (1 - h^2 / support^2)^2 of it, peak = 3 mass / (pi support^2), so that over the plane it is the mass [m^2];
// where the ray ends or begins within, it sees the part that lies there, spread along it as 3/4 (1 - s^2) over support before and behind the centre.

// Part of a splat that lies before s, in supports from the centre along the ray.
FORMULA real splat_before(real s) {
  real t = min(max(s, -1.0), 1.0);
  return fma(t, fma(t * t, -0.25, 0.75), 0.5);
}

// Optical depth that a unit ray d from the origin has on [0, end] of a splat about c; `foot`: where along the ray.
FORMULA real splat_depth(real dx, real dy, real dz, real cx, real cy, real cz, real inverse_support, real peak, real end, OUT(real) foot) {
  foot = fma(dx, cx, fma(dy, cy, dz * cz));
  // By the perpendicular vector, in supports: no cancellation, no overflow.
  real ex = fma(-foot, dx, cx) * inverse_support;
  real ey = fma(-foot, dy, cy) * inverse_support;
  real ez = fma(-foot, dz, cz) * inverse_support;
  real u = max(1.0 - fma(ex, ex, fma(ey, ey, ez * ez)), 0.0);
  real depth = u * u * peak;
  real front = foot * inverse_support;
  real back = (end - foot) * inverse_support;
  mask cut = (u > 0.0) && ((front < 1.0) || (back < 1.0));
  if (any_lane(cut)) depth = select(cut, depth * max(splat_before(back) - splat_before(-front), 0.0), depth);
  return depth;
}

// 1 - exp(-tau) with its relative accuracy, without exp_ below 1: a polynomial through (1 - exp(-tau)) / tau at the nodes of Chebyshev (1e-7).
FORMULA real splat_opacity(real tau) {
  real t = min(tau, 1.0);
  real p = fma(t, -0.0009125453917, 0.0078373638017);
  p = fma(t, p, -0.0414187630253);
  p = fma(t, p, 0.1666096712160);
  p = fma(t, p, -0.4999951598439);
  p = fma(t, p, 0.9999999328983);
  real opaque = t * p;
  mask thick = tau >= 1.0;
  if (any_lane(thick)) opaque = select(thick, 1.0 - transmittance(tau), opaque);
  return opaque;
}

// Weight of a direction in the mean that interpolates between directions, `mu` the cosine between it and the wanted one: (1 / chord - 1 / reach)^2 up to
// a chord of `reach` (Franke and Nielson 1980). Chords are held at 1e-3, below which the direction itself is meant.
FORMULA real direction_weight(real mu, real inverse_reach) {
  real chord = sqrt(max(fma(real(-2.0), mu, 2.0), 1e-6));
  real w = max(1.0 / chord - inverse_reach, 0.0);
  return w * w;
}
