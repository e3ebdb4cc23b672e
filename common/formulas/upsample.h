// From samples of an image to the pixels between them. u and v in 0..1 between two samples; beyond that they extrapolate.

FORMULA real between(real a, real b, real u) {
  return fma(u, b - a, a);
}

// The second difference of samples at a and b, from the side where it is less (Harten et al. 1987): an edge on the other side is not felt.
// `before` and `after`: the samples beside a and b, where there are any; at least one is.
FORMULA real bend_between(real before, real a, real b, real after, mask has_before, mask has_after) {
  real of_a = (before - a) - (a - b);
  real of_b = (a - b) - (b - after);
  real first = select(has_before, of_a, of_b);
  real second = select(has_after, of_b, of_a);
  return select(abs(first) < abs(second), first, second);
}

// The mean size of both, which tells of a peak of which the lesser one does not: what bends are off by beside a lamp. At a border the
// other side is not known: there the difference of a and b counts as well.
FORMULA real bend_size(real before, real a, real b, real after, mask has_before, mask has_after) {
  real of_a = abs((before - a) - (a - b));
  real of_b = abs((a - b) - (b - after));
  real slope = abs(a - b);
  return 0.5 * (select(has_before, of_a, of_b + slope) + select(has_after, of_b, of_a + slope));
}

// What a second difference of 1 adds at u to the line between two samples: exact for polynomials of the second degree.
FORMULA real bend_weight(real u) {
  return 0.5 * u * (u - 1.0);
}

// The value at (u, v) between samples a b above c d; bends along x above and below, along y to the left and to the right. At least 0.
FORMULA real upsampled(real a, real b, real c, real d, real above, real below, real left, real right, real u, real v) {
  real plane = between(between(a, b, u), between(c, d, u), v);
  real bent = fma(bend_weight(u), between(above, below, v), fma(bend_weight(v), between(left, right, u), plane));
  return max(bent, 0.0);
}

// What it may be off by, from the bends' sizes: the most that bends add, or more where those of both sides differ.
FORMULA real upsampling_error(real above, real below, real left, real right, real u, real v) {
  return fma(abs(bend_weight(u)), max(above, below), abs(bend_weight(v)) * max(left, right));
}

// How near the ends of two rays are, given as 1/distance: 1 where they are the same, 0 from a relative difference of `tolerance` on.
FORMULA real depth_fit(real inverse, real of_sample, real tolerance) {
  real x = min(abs(of_sample - inverse) / (tolerance * inverse), 1.0);
  return 1.0 - x * x;
}

// The least sum of bilinear weights times depth_fit() that serves a pixel.
FORMULA real least_fit() {
  return 0.125;
}

// The mean of four samples by weights of sum 1, from the least that has a weight on: that of equal ones is the same, in every bit,
// and one without a weight is not felt however large it is.
FORMULA real weighted_mean(real a, real b, real c, real d, real of_a, real of_b, real of_c, real of_d) {
  real low = min(min(select(of_a > 0.0, a, real(1e30)), select(of_b > 0.0, b, real(1e30))),
                 min(select(of_c > 0.0, c, real(1e30)), select(of_d > 0.0, d, real(1e30))));
  return fma(of_a, a - low, fma(of_b, b - low, fma(of_c, c - low, fma(of_d, d - low, low))));
}

// Below this transmittance its error counts beside it, not beside itself: surfaces are hardly seen there.
FORMULA real least_transmittance() {
  return 0.0625;
}
