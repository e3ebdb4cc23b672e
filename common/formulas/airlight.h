// Single scattering along a ray in the homogeneous medium, after Biri, Michelin, Arques 2006.
//
// A point light stands h away from the ray, its foot at t; r(x) is its distance from x, delta(x) = atan2(h, x - t) the angle at x, rho =
// sigma_t r, lambda = sigma_t h. The light scattered on [x0, x1], per unit of intensity and albedo, is
//     int sigma_t p(mu) exp(-sigma_t (x + r)) / r^2 dx = sigma_t (B(x0) - B(x1)),     B(x) = what comes from [x, infinity)
// Their Gamma (eq. 7) times exp(-sigma_t t) is infinity times zero for a light behind the camera; here every integral is scaled by
// its largest factor, so that the tables hold numbers of order 1:
//     x >= t   B(x) = exp(-sigma_t (x + r)) M / r,   M = 1/sin(delta) int_0^delta p(-cos s) exp(-lambda (cot(s/2) - cot(delta/2))) ds
//     x <  t   B(x) = exp(-sigma_t (x + r)) P / h,   P = the same integral without 1/sin(delta)
//     x <  t   B'(x) = exp(-sigma_t t) N / r = what comes from (-infinity, x],   N = 1/sin(delta) int_delta^pi p(-cos s) exp(-lambda cot(s/2)) ds
// Where both ends lie before the foot, B(x0) - B(x1) cancels in thin media and B'(x1) - B'(x0) in dense ones: the smaller decides.
//
// Tables over tau = tan of half the smaller angle between ray and light, in 0..1, and rho (M, N) or lambda (P), the latter held at 100: the
// exponential before it is 0 by then. What is tabulated is divided by its behaviour in dense media: M (1 + 2 rho), N (1 + 2 rho tau^2),
// P (1 + lambda). Axes: fourth root of rho / (30 + rho), which takes the rho ln(rho) at 0 and is uniform near 30; tau (1 + w) / (tau + w), which
// is fine near 0 for a small w (a phase function's peak). Layout, made by common/plan/airlight_tables.cpp:
//     [0] n   [1] w of M and P   [2] w of N   [3] 0   then M, N, P: n x n each, tau along the rows

FORMULA real airlight_axis_depth(real rho, real n) {
  real d = min(rho, 100.0);
  return sqrt(sqrt(d / (30.0 + d))) * ((n - 1.0) * 1.0677899723724409);  // (130 / 100)^(1/4): 1 at rho = 100
}

FORMULA real airlight_axis_angle(real tau, real w, real n) {
  return tau * (1.0 + w) / (tau + w) * (n - 1.0);
}

// Weights of four equidistant nodes 0..3 at t in 0..3 (Lagrange).
FORMULA void cubic_weights(real t, OUT(real) w0, OUT(real) w1, OUT(real) w2, OUT(real) w3) {
  real a = t - 1.0;
  real b = t - 2.0;
  real c = t - 3.0;
  real ab = a * b;
  real tc = t * c;
  w0 = ab * c * (-1.0 / 6.0);
  w1 = tc * b * 0.5;
  w2 = tc * a * (-0.5);
  w3 = t * ab * (1.0 / 6.0);
}

// Table number `which` (0 M, 1 N, 2 P) at (depth, tau).
FORMULA real airlight_lookup(table t, real which, real depth, real tau) {
  real n = element(t, 0);
  real w = select((which > 0.5) && (which < 1.5), element(t, 2), element(t, 1));
  real u = airlight_axis_depth(depth, n);
  real v = airlight_axis_angle(tau, w, n);
  real i = min(max(floor(u) - 1.0, 0.0), n - 4.0);
  real j = min(max(floor(v) - 1.0, 0.0), n - 4.0);
  real a0; real a1; real a2; real a3;
  cubic_weights(u - i, a0, a1, a2, a3);
  real b0; real b1; real b2; real b3;
  cubic_weights(v - j, b0, b1, b2, b3);
  return weighted_patch(t, fma(fma(which, n, i), n, j) + 4.0, integer_element(t, 0), a0, a1, a2, a3, b0, b1, b2, b3);
}

// B(x): what comes from [x, infinity), divided by sigma_t.
FORMULA real airlight_beyond(table t, real sigma_t, real foot, real h, real x) {
  real before = foot - x;
  real r = sqrt(fma(before, before, h * h));
  real tau = h / (r + abs(before));
  mask ahead = before > 0.0;
  real depth = sigma_t * select(ahead, h, r);
  real value = airlight_lookup(t, select(ahead, real(2.0), real(0.0)), depth, tau);
  real scale = select(ahead, fma(depth, h, h), fma(2.0 * depth, r, r));
  return transmittance(sigma_t * (x + r)) * value / scale;
}

// B'(x): what comes from (-infinity, x], divided by sigma_t; for x before the foot.
FORMULA real airlight_before(table t, real sigma_t, real foot, real h, real x) {
  real before = foot - x;
  real r = sqrt(fma(before, before, h * h));
  real tau = h / (r + abs(before));
  real rho = sigma_t * r;
  real value = airlight_lookup(t, real(1.0), rho, tau);
  return transmittance(sigma_t * max(foot, 0.0)) * value / fma(2.0 * rho * tau * tau, r, r);
}

// The integrand at x, divided by sigma_t; `more` is the optical depth of what else stands on both ways.
FORMULA real airlight_density(int kind, real g, real sigma_t, real foot, real h, real x, real more) {
  real past = x - foot;
  real r2 = fma(past, past, h * h);
  real r = sqrt(r2);
  return phase_value(kind, g, -past / r) * transmittance(fma(sigma_t, x + r, more)) / r2;
}
FORMULA real airlight_density(int kind, real g, real sigma_t, real foot, real h, real x) {
  return airlight_density(kind, g, sigma_t, foot, h, x, real(0.0));
}

// The same of a directional light; mu = -dot(direction of the light, ray).
FORMULA real directional_density(int kind, real g, real sigma_t, real mu, real x, real more) {
  return phase_value(kind, g, mu) * transmittance(fma(sigma_t, x, more));
}

// The same over a segment short beside the light's distance: Gauss-Legendre of eight nodes.
FORMULA real airlight_short(int kind, real g, real sigma_t, real foot, real h, real x0, real x1) {
  real half_length = (x1 - x0) * 0.5;
  real middle = (x1 + x0) * 0.5;
  real a = half_length * 0.18343464249564980;
  real b = half_length * 0.52553240991632899;
  real c = half_length * 0.79666647741362674;
  real d = half_length * 0.96028985649753623;
  real sum = (airlight_density(kind, g, sigma_t, foot, h, middle - a) + airlight_density(kind, g, sigma_t, foot, h, middle + a)) * 0.36268378337836198;
  sum += (airlight_density(kind, g, sigma_t, foot, h, middle - b) + airlight_density(kind, g, sigma_t, foot, h, middle + b)) * 0.31370664587788729;
  sum += (airlight_density(kind, g, sigma_t, foot, h, middle - c) + airlight_density(kind, g, sigma_t, foot, h, middle + c)) * 0.22238103445337447;
  sum += (airlight_density(kind, g, sigma_t, foot, h, middle - d) + airlight_density(kind, g, sigma_t, foot, h, middle + d)) * 0.10122853629037626;
  return sum * half_length;
}

// Light of a point light scattered once on [x0, x1] of a ray, per unit of intensity and of albedo [1/m^2]. foot and h as from
// perpendicular(), h > 0; 0 <= x0 <= x1, x1 may be 1e30 (infinite). Never negative.
FORMULA real point_airlight(table t, int kind, real g, real sigma_t, real foot, real h, real x0, real x1) {
  real far_end = min(x1, 1e15);  // 1e30 squared is too large for a float; what comes from beyond 1e15 m is nothing
  real from = airlight_beyond(t, sigma_t, foot, h, x0);
  real result = from;
  mask bounded = x1 < 1e15;
  real before = foot - x0;
  real r = sqrt(fma(before, before, h * h));
  mask is_short = far_end - x0 < 0.4 * r;
  mask long_one = bounded && !is_short;
  if (any_lane(long_one)) {
    real beyond = airlight_beyond(t, sigma_t, foot, h, far_end);
    real difference = from - beyond;
    mask approaching = long_one && (far_end < foot);
    if (any_lane(approaching)) {
      real behind = airlight_before(t, sigma_t, foot, h, x0);
      real other = airlight_before(t, sigma_t, foot, h, min(far_end, foot)) - behind;
      difference = select(approaching && (behind < from), other, difference);
    }
    result = select(long_one, difference, result);
  }
  if (any_lane(is_short)) {
    real x = select(is_short, far_end, x0);
    result = select(is_short, airlight_short(kind, g, sigma_t, foot, h, x0, x), result);
  }
  // Light that has crossed an optical depth of 87 at the near end is below any float.
  mask lit = sigma_t * (x0 + r) < 87.0;
  return select(lit, sigma_t * max(result, 0.0), real(0.0));
}

// The same for a directional light, per unit of irradiance; mu = -dot(direction of the light, ray).
FORMULA real directional_airlight(int kind, real g, real sigma_t, real mu, real x0, real x1) {
  return phase_value(kind, g, mu) * transmittance(sigma_t * x0) * opacity(optical_depth(x1 - x0, sigma_t));
}
