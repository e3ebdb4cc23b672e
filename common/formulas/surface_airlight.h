// Indirect single scattering on a surface (Biri, Michelin, Arques 2006, III-C): light that scatters once in the unbounded homogeneous
// medium before it arrives at a point, integrated over the hemisphere of the normal (Lambert) or the cosine lobe about the mirror
// direction (Phong).
//
// A ray from the point at the angle gamma from the light, which is l away, lambda = sigma_t l, brings (B at 0 of airlight.h)
//     L = I / l^2 lambda exp(-lambda) / sin(gamma) int_0^(pi - gamma) p(-cos s) exp(-lambda sin(gamma) (cot(s/2) - tan(gamma/2))) ds
// so the sine of the solid angle cancels. (Their eq. 11 and 13 print + 1 for + sin(phi) in the exponent, and integrate the whole sphere.)
// Of a directional light every ray brings E p(cos gamma), whatever the density.
//
// A table has axes of lambda (airlight_axis_depth) and of s = sin of half the angle between the light and the normal or the mirror
// direction, as s (1 + w) / (s + w). What is tabulated is divided by lambda exp(-lambda) / (1 + lambda) and (1 + w) / (s + w). Layout, made
// by common/plan/surface_airlight_tables.cpp:
//     [0] n   [1] w   [2] m   [3] k   then n x m, s along the rows, and m for a directional light
// Where light scatters back, what arrives has a peak in the direction away from the light as well, which that axis does not tell apart: from number k
// on the same follows for s = sin of half the angle from there, which serves angles beyond 90 degrees. k = 0: there is none.

// In: the sine. Out: s, where its half of the table begins, the first of four nodes along it, and where s lies among the nodes.
FORMULA void surface_airlight_axis(table t, real half_sine, OUT(real) s, OUT(real) first, OUT(real) j, OUT(real) v) {
  real m = element(t, 2);
  real k = element(t, 3);
  mask back = (half_sine > 0.70710678) && (k > 0.0);
  s = select(back, sqrt(max((1.0 - half_sine) * (1.0 + half_sine), 0.0)), half_sine);
  first = select(back, k, real(4.0));
  v = airlight_axis_angle(s, element(t, 1), m);
  j = min(max(floor(v) - 1.0, 0.0), m - 4.0);
}

// Of a point light at optical depth lambda, per unit of I / l^2; times the albedo it is an irradiance (Lambert), or the radiance of the
// normalised lobe (Phong).
FORMULA real surface_airlight_point(table t, real lambda, real half_sine) {
  real n = element(t, 0);
  real u = airlight_axis_depth(lambda, n);
  real i = min(max(floor(u) - 1.0, 0.0), n - 4.0);
  real s; real first; real j; real v;
  surface_airlight_axis(t, half_sine, s, first, j, v);
  real a0; real a1; real a2; real a3;
  cubic_weights(u - i, a0, a1, a2, a3);
  real b0; real b1; real b2; real b3;
  cubic_weights(v - j, b0, b1, b2, b3);
  real value = weighted_patch(t, fma(i, element(t, 2), j) + first, integer_element(t, 2), a0, a1, a2, a3, b0, b1, b2, b3);
  real w = element(t, 1);
  return max(value, 0.0) * transmittance(lambda) * (lambda / (1.0 + lambda)) * ((1.0 + w) / (s + w));
}

// Of a directional light, per unit of its irradiance.
FORMULA real surface_airlight_directional(table t, real half_sine) {
  real n = element(t, 0);
  real s; real first; real j; real v;
  surface_airlight_axis(t, half_sine, s, first, j, v);
  real b0; real b1; real b2; real b3;
  cubic_weights(v - j, b0, b1, b2, b3);
  real value = weighted_patch(t, fma(n, element(t, 2), j) + first, 0, real(1.0), real(0.0), real(0.0), real(0.0), b0, b1, b2, b3);
  real w = element(t, 1);
  return max(value, 0.0) * ((1.0 + w) / (s + w));
}

// The same by the point spread function of Zhou et al. 2007, eq. 18 and 25: the light convolved with NPSF and reflected by the lobe, times
// lambda exp(-lambda), where the medium between the light and the surface is as dense as in the mean. Both are functions of the angle from the
// light alone, so that the harmonics are a polynomial in the cosine between the light and the normal or the mirror direction; not below 0, where a
// cut-off expansion may swing. The table: six coefficients, the constant first.
FORMULA real surface_airlight_psf(table t, real lambda, real cosine) {
  real value = element(t, 5);
  for (int i = 4; i >= 0; --i) value = fma(value, cosine, element(t, i));
  return max(value, 0.0) * (min(lambda, 1e4) * transmittance(lambda));
}
