// exp and log for the single-precision builds. The same bits in every C++ build; within about 2 ULP of the truth.

// e^x, x held in -87..88 (the result is a normal number). x = n ln 2 + r, |r| <= ln 2 / 2, with ln 2 in two parts so that r is exact to
// rounding; then a polynomial through the Chebyshev nodes of that interval, relative error 2e-8.
FORMULA real exp_(real x) {
  x = min(max(x, -87.0), 88.0);
  real n = round_even(x * 1.44269504088896341);
  EXACT real r = fma(n, real(-0.693145751953125), x);
  r = fma(n, real(-1.42860682030941723e-6), r);
  real p = fma(r, real(1.394111926e-3), real(8.375134776e-3));
  p = fma(r, p, real(4.166635277e-2));
  p = fma(r, p, real(1.666641541e-1));
  p = fma(r, p, real(0.5));
  p = fma(r, p, real(1.0));
  p = fma(r, p, real(1.0));
  return p * exp2_int(n);
}

// Natural logarithm of a normal x > 0. x = 2^e m with m in sqrt(1/2)..sqrt(2); log m = 2 artanh s, s = (m - 1) / (m + 1),
// by its series: the first left-out term is s^10 / 11 < 2e-9.
FORMULA real log_(real x) {
  real m = mantissa_of(x);
  real e = exponent_of(x);
  mask large = m > 1.41421356;
  m = select(large, m * 0.5, m);
  e = select(large, e + 1.0, e);
  real s = (m - 1.0) / (m + 1.0);
  real z = s * s;
  real p = fma(z, real(1.0 / 9.0), real(1.0 / 7.0));
  p = fma(z, p, real(1.0 / 5.0));
  p = fma(z, p, real(1.0 / 3.0));
  real series = fma(s * z, p * 2.0, s * 2.0);
  EXACT real sum = fma(e, real(0.693145751953125), fma(e, real(1.42860682030941723e-6), series));
  return sum;
}
