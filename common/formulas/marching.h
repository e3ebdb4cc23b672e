// Marching along a ray in steps. Inside a step extinction is constant, and what 1/r^2 of a point light and the extinction do to it is integrated,
// not sampled.

// Where step k of n begins in a stretch of homogeneous medium, k in 0..n: in a thin one steps are of equal length, in a dense one they grow with
// 1 + optical depth, fine in front and nowhere so coarse that a light behind much fog falls between them.
FORMULA real graded_step(real k, real n, real length, real extinction) {
  real tau = extinction * length;
  real share = k / n;
  real even = length * share;
  real graded = (exp_(share * log_(1.0 + tau)) - 1.0) / max(extinction, 1e-30);
  return select((tau < 0.02) || (k >= n), even, min(graded, length));
}

// A step [a, b] beside a point light whose foot is at `foot`, h > 0 away, ra and rb its distances from the ends: int_a^b dt / r^2, the angle in
// which the light sees the step over h [1/m]. Half its tangent is written for a foot outside the step and for one inside: each cancels in the
// other's place.
FORMULA real step_angle(real a, real b, real ra, real rb, real foot, real h, real over_h) {
  real to_a = a - foot;
  real to_b = b - foot;
  real both = to_a * to_b;
  mask inside = both < 0.0;
  real rise = select(inside, to_b * (h + ra) - to_a * (h + rb), h * (b - a));
  real run = select(inside, fma(h + ra, h + rb, both), fma(ra, rb, fma(h, h, both)));
  return 2.0 * over_h * atan_(rise / max(run, 1e-30));
}

// r + x for x = past the foot, where they cancel too.
FORMULA real beyond_foot(real past, real r, real h) {
  return select(past > 0.0, r + past, h * h / (r + abs(past)));
}

// Whether a step is not short beside its distance from the light.
FORMULA mask near_light(real a, real b, real ra, real rb) {
  return b - a > 0.1 * min(ra, rb);
}

// Means over the step, weighed like that: of the place t and of the light's distance r. `angle` is step_angle(). A step short beside its distance takes
// those where the angle is halved, whose error is 1e-3 of the step; the logarithms of the others would lose their digits there.
FORMULA void step_means(real a, real b, real ra, real rb, real foot, real h, real angle, OUT(real) t, OUT(real) r) {
  t = (a * rb + b * ra) / (ra + rb);
  real past = t - foot;
  r = sqrt(fma(past, past, h * h));
  mask near = near_light(a, b, ra, rb);
  if (any_lane(near)) {
    real to_a = a - foot;
    real to_b = b - foot;
    real scale = 1.0 / max(angle, 1e-30);
    real inverse = log_(beyond_foot(to_b, rb, h) / beyond_foot(to_a, ra, h));  // int dt / r
    t = select(near, min(max(fma(log_(rb / ra), scale, foot), a), b), t);
    r = select(near, max(inverse * scale, h), r);
  }
}

// Where on the ray the light is that far away, on the side of t: what lies before it on its way is what the whole step has on the mean.
FORMULA real place_at_distance(real t, real r, real foot, real h) {
  real past = sqrt(max((r - h) * (r + h), 0.0));
  return foot + select(t < foot, -past, past);
}

// The direction halfway between two, given by sine and cosine of their angles in -pi/2..pi/2.
FORMULA void halfway(real sin_a, real cos_a, real sin_b, real cos_b, OUT(real) s, OUT(real) c) {
  real x = sin_a + sin_b;
  real y = cos_a + cos_b;
  real scale = 1.0 / sqrt(max(fma(x, x, y * y), 1e-37));
  s = x * scale;
  c = y * scale;
}

// Mean of the phase function between two directions in which the light sees the ray: Boole's rule in the angle.
FORMULA real mean_phase(int kind, real g, real sin_a, real cos_a, real sin_b, real cos_b) {
  real s2;
  real c2;
  real s1;
  real s3;
  real unused;
  halfway(sin_a, cos_a, sin_b, cos_b, s2, c2);
  halfway(sin_a, cos_a, s2, c2, s1, unused);
  halfway(s2, c2, sin_b, cos_b, s3, unused);
  real ends = phase_value(kind, g, -sin_a) + phase_value(kind, g, -sin_b);
  real quarters = phase_value(kind, g, -s1) + phase_value(kind, g, -s3);
  return (7.0 * ends + 32.0 * quarters + 12.0 * phase_value(kind, g, -s2)) * (1.0 / 90.0);
}

// The same over a step, whose ends lie to_a and to_b from the foot: halfway where the angle is small beside phase_width(), by Simpson's rule where it is larger,
// in four parts where it is wide.
FORMULA real step_phase(int kind, real g, real to_a, real to_b, real ra, real rb, real h) {
  if (kind == 0) return phase_isotropic();
  real over_ra = 1.0 / ra;
  real over_rb = 1.0 / rb;
  real s0 = to_a * over_ra;
  real c0 = h * over_ra;
  real s4 = to_b * over_rb;
  real c4 = h * over_rb;
  real s2;
  real c2;
  halfway(s0, c0, s4, c4, s2, c2);
  real result = phase_value(kind, g, -s2);
  real width = phase_width(kind, g);
  real turn = (1.0 - fma(s0, s4, c0 * c4)) / (width * width);
  mask turning = turn > 0.004;
  if (any_lane(turning)) {
    result = select(turning, (4.0 * result + phase_value(kind, g, -s0) + phase_value(kind, g, -s4)) * (1.0 / 6.0), result);
    mask wide = turn > 0.125;
    if (any_lane(wide)) {
      real s1;
      real c1;
      real s3;
      real c3;
      halfway(s0, c0, s2, c2, s1, c1);
      halfway(s2, c2, s4, c4, s3, c3);
      real parts = mean_phase(kind, g, s0, c0, s1, c1) + mean_phase(kind, g, s1, c1, s2, c2) + mean_phase(kind, g, s2, c2, s3, c3) + mean_phase(kind, g, s3, c3, s4, c4);
      result = select(wide, 0.25 * parts, result);
    }
  }
  return result;
}

// A step near a light is cut into 1, 2, 4 or 8 parts of equal angle, as the light sees them, of a quarter of a radian at most where eight are enough. The ends' angles
// are told by sines s0, s1 and cosines; that of a part by `sine` and `cosine`.
FORMULA real step_parts(real s0, real c0, real s1, real c1, OUT(real) sine, OUT(real) cosine) {
  real s = s1 * c0 - s0 * c1;
  real c = fma(s0, s1, c0 * c1);
  real parts = 1.0;
  for (int halvings = 0; halvings < 3; ++halvings) {
    mask wide = c < 0.97;
    if (!any_lane(wide)) break;
    s = select(wide, sqrt(max(fma(c, -0.5, 0.5), 0.0)), s);
    c = select(wide, sqrt(max(fma(c, 0.5, 0.5), 0.0)), c);
    parts = select(wide, parts * 2.0, parts);
  }
  sine = s;
  cosine = c;
  return parts;
}

// Whether a step may have more than one: never one that is shorter beside its distance from the light. squared: the least distance, squared.
FORMULA mask may_have_parts(real length, real squared) {
  return length * length > 0.058 * squared;
}

// The end of a part that begins in the direction (s, c): that direction turned by the part's angle, and its place on the ray, in the rest [a, b] of the step.
FORMULA real end_of_part(real sine, real cosine, real s, real c, real a, real b, real foot, real h, OUT(real) s_end, OUT(real) c_end) {
  s_end = fma(s, cosine, c * sine);
  c_end = fma(c, cosine, -s * sine);
  return select(c_end > 0.0, min(max(fma(h, s_end / max(c_end, 1e-18), foot), a), b), b);
}

// Light that arrives at the camera from a step of optical depth tau behind `front` of it, for a sample at share u of the step behind `beside` on its
// way from the light: exp(-front) times the mean of exp(-tau) where u is 1/2; elsewhere the sample is seen through its own depth u tau, exactly where the step is
// thin, and through no less than what stands before the step.
FORMULA real step_transmittance(real front, real tau, real u, real beside) {
  real seen = front + tau * (u - 0.5) + beside;
  real light = select(seen < 87.0, exp_(-max(min(seen, 87.0), -87.0)), real(0.0)) * mean_transmittance(tau);
  mask early = tau * (0.5 - u) > 1e-3;
  if (any_lane(early)) light = select(early, min(light, transmittance(front + beside)), light);
  return light;
}

// Optical depth at which a ray surely ends: exp(-80) = 1e-35.
FORMULA real deepest() { return 80.0; }

// Whether a ray ends behind `front`: `most` is the radiance that all of it could have, seen through nothing (int sigma_t exp(-T) dt is 1 at most), `seen` what
// it has. From exp(-16) on it ends where what is behind can change that by 1e-6 at most.
FORMULA mask ray_ended(real front, real most, real seen) {
  mask deep = front >= 16.0;
  if (!any_lane(deep)) return deep;
  return (front >= deepest()) || (deep && (transmittance(front) * most <= seen * 1e-6));
}
