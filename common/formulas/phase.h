// Phase functions [1/sr]. mu: cosine between the directions of travel before and after; each integrates to 1 over the sphere; g > 0
// scatters forward.

FORMULA real phase_isotropic() {
  return real(0.079577471545947673);  // 1 / 4 pi
}

// Rayleigh 1871: 3 / (16 pi) (1 + mu^2).
FORMULA real phase_rayleigh(real mu) {
  return fma(mu, mu, 1.0) * 0.059683103659460751;
}

// ((1-|g|)^2 + 2 |g| (1 -+ mu))^-1.5: the denominator 1 + g^2 - 2 g mu in a form that loses no digits where it is small.
FORMULA real phase_peak(real g, real mu) {
  real a = abs(g);
  real toward = select(g < 0.0, 1.0 + mu, 1.0 - mu);
  real d = fma(1.0 - a, 1.0 - a, 2.0 * a * max(toward, 0.0));
  return 1.0 / (d * sqrt(d));
}

// Henyey and Greenstein 1941: (1 - g^2) / (4 pi (1 + g^2 - 2 g mu)^1.5). |g| <= 0.99.
FORMULA real phase_henyey_greenstein(real g, real mu) {
  return (1.0 - g) * (1.0 + g) * 0.079577471545947673 * phase_peak(g, mu);
}

// Cornette and Shanks 1992: 3 (1 - g^2) (1 + mu^2) / (8 pi (2 + g^2) (1 + g^2 - 2 g mu)^1.5). |g| <= 0.99.
FORMULA real phase_cornette_shanks(real g, real mu) {
  return (1.0 - g) * (1.0 + g) * fma(mu, mu, 1.0) / fma(g, g, 2.0) * 0.11936620731892150 * phase_peak(g, mu);
}

// Nishita et al. 1987, hazy and murky: (0.5 + 4.5 ((1+mu)/2)^8) / 4 pi and (0.5 + 16.5 ((1+mu)/2)^32) / 4 pi.
FORMULA real phase_mie_hazy(real mu) {
  real h = max(fma(mu, 0.5, 0.5), 0.0);
  real h2 = h * h;
  real h4 = h2 * h2;
  return fma(h4 * h4, 4.5, 0.5) * 0.079577471545947673;
}

FORMULA real phase_mie_murky(real mu) {
  real h = max(fma(mu, 0.5, 0.5), 0.1);  // 0.1^32 is still a normal number, and nothing beside 0.5
  real h2 = h * h;
  real h4 = h2 * h2;
  real h8 = h4 * h4;
  real h16 = h8 * h8;
  return fma(h16 * h16, 16.5, 0.5) * 0.079577471545947673;
}

// By kind, in the order of PhaseKind (common/algorithms/view.h).
FORMULA real phase_value(int kind, real g, real mu) {
  if (kind == 1) return phase_rayleigh(mu);
  if (kind == 2) return phase_henyey_greenstein(g, mu);
  if (kind == 3) return phase_cornette_shanks(g, mu);
  if (kind == 4) return phase_mie_hazy(mu);
  if (kind == 5) return phase_mie_murky(mu);
  return phase_isotropic();
}

// The angle [rad] within which a phase function changes much: 3 / width^2 is its second derivative at the peak, beside the peak; no wider than sqrt(2).
FORMULA real phase_width(int kind, real g) {
  if (kind == 2 || kind == 3) {
    real a = max(abs(g), 0.25);
    return (1.0 - a) / sqrt(a);
  }
  if (kind == 4) return 0.87;
  if (kind == 5) return 0.43;
  return 1.4;
}
