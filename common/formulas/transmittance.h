// Attenuation in the homogeneous medium.

// exp(-tau), with tau held at 87 so that no denormal arises (exp(-87) = 1.6e-38 is about the least normal float).
FORMULA real transmittance(real tau) {
  return exp_(-min(tau, 87.0));
}

// (1 - exp(-tau)) / tau for tau >= 0; 1 at 0. The closed form loses digits below 0.25, there the series is used: its first left-out
// term is 0.25^7 / 8! = 1.5e-9.
FORMULA real mean_transmittance(real tau) {
  real t = min(tau, 0.25);
  real series = fma(t, fma(t, fma(t, fma(t, fma(t, fma(t, real(1.0 / 5040.0), real(-1.0 / 720.0)), real(1.0 / 120.0)), real(-1.0 / 24.0)), real(1.0 / 6.0)), real(-0.5)), real(1.0));
  real u = max(tau, 0.25);
  return select(tau < 0.25, series, (1.0 - transmittance(u)) / u);
}
