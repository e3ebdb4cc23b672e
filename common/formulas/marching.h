// Marching along a ray in steps. Inside a step extinction is constant, and what 1/r^2 of a point light and the extinction do to it is integrated,
// not sampled.

// Where step k of n begins in a stretch of homogeneous medium: steps of equal opacity, which in a thin medium are equal in length. k in 0..n.
FORMULA real opaque_step(real k, real n, real length, real extinction) {
  real tau = extinction * length;
  real share = k / n;
  real cut = 1.0 - opacity(tau) * share;
  real even = length * share;
  real uneven = -log_(max(cut, 1e-30)) / max(extinction, 1e-30);
  return select((tau < 0.02) || (k >= n), even, min(uneven, length));
}

// A step [a, b] beside a point light whose foot is at `foot`, h > 0 away, ra and rb its distances from the ends: int_a^b dt / r^2, the angle in
// which the light sees the step over h [1/m]. Half its tangent is written for a foot outside the step and for one inside: each cancels in the
// other's place.
FORMULA real step_angle(real a, real b, real ra, real rb, real foot, real h) {
  real to_a = a - foot;
  real to_b = b - foot;
  real both = to_a * to_b;
  mask inside = both < 0.0;
  real rise = select(inside, to_b * (h + ra) - to_a * (h + rb), h * (b - a));
  real run = select(inside, fma(h + ra, h + rb, both), fma(ra, rb, fma(h, h, both)));
  return 2.0 / h * atan_(rise / max(run, 1e-30));
}

// r + x for x = past the foot, where they cancel too.
FORMULA real beyond_foot(real past, real r, real h) {
  return select(past > 0.0, r + past, h * h / (r + abs(past)));
}

// Means over the step, weighed like that: of the place t and of the light's distance r. `angle` is step_angle(). A step short beside its distance takes
// those where the angle is halved, whose error is 1e-3 of the step; the logarithms of the others would lose their digits there.
FORMULA void step_means(real a, real b, real ra, real rb, real foot, real h, real angle, OUT(real) t, OUT(real) r) {
  t = (a * rb + b * ra) / (ra + rb);
  real past = t - foot;
  r = sqrt(fma(past, past, h * h));
  mask near_light = b - a > 0.1 * min(ra, rb);
  if (any_lane(near_light)) {
    real to_a = a - foot;
    real to_b = b - foot;
    real scale = 1.0 / max(angle, 1e-30);
    real inverse = log_(beyond_foot(to_b, rb, h) / beyond_foot(to_a, ra, h));  // int dt / r
    t = select(near_light, min(max(fma(log_(rb / ra), scale, foot), a), b), t);
    r = select(near_light, max(inverse * scale, h), r);
  }
}

// Light that arrives at the camera from a step of optical depth tau behind `front` of it, for a sample at share u of the step behind `beside` on its
// way from the light: exp(-front) times the mean of exp(-tau) where u is 1/2; elsewhere the sample is seen through its own depth.
FORMULA real step_transmittance(real front, real tau, real u, real beside) {
  return transmittance(max(front + tau * (u - 0.5) + beside, 0.0)) * mean_transmittance(tau);
}
