// exp, log, erf and atan for the single-precision builds. The same bits in every C++ build; exp and log within about 2 ULP of the truth.

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

// 2^x for x in -126..0.
FORMULA real exp2_(real x) {
  real n = round_even(x);
  real r = x - n;
  real p = fma(r, real(1.3264725418145537e-3), real(9.671512767578973e-3));
  p = fma(r, p, real(5.5507337491631170e-2));
  p = fma(r, p, real(2.4022242082586368e-1));
  p = fma(r, p, real(6.9314697759505830e-1));
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

// From here on erf_() is held at what it has here.
FORMULA real erf_end() { return real(3.7); }

// Error function: absolute error 3.4e-7. x P(x^2) / Q(x^2) on |x| <= 3.7, the minimax quotient of two polynomials of degree 5, 1e-8 away, the last digits of its
// constants chosen for the least error with all roundings, fused or not; beyond it the same as there, where erfc is 1.7e-7.
FORMULA real erf_(real x) {
  real t = min(max(x, -erf_end()), erf_end());
  real u = t * t;
  real p = fma(u, real(2.2182044e-06), real(0.00028951894));
  p = fma(u, p, real(0.0035737266));
  p = fma(u, p, real(0.052207965));
  p = fma(u, p, real(0.18479283));
  p = fma(u, p, real(1.1283787));
  real q = fma(u, real(4.005438e-05), real(0.0011320785));
  q = fma(u, q, real(0.014585496));
  q = fma(u, q, real(0.11197122));
  q = fma(u, q, real(0.49710074));
  q = fma(u, q, real(1.0));
  return t * p / q;
}

// Arc tangent of x >= 0, relative error 2e-7: beyond 1 by its complement, below by a minimax polynomial in x^2.
FORMULA real atan_(real x) {
  mask steep = x > 1.0;
  real t = select(steep, 1.0 / max(x, 1.0), x);
  real z = t * t;
  real p = fma(z, real(2.849889918e-3), real(-1.606863182e-2));
  p = fma(z, p, real(4.26915271e-2));
  p = fma(z, p, real(-7.504295531e-2));
  p = fma(z, p, real(0.1064093469));
  p = fma(z, p, real(-0.1420364471));
  p = fma(z, p, real(0.1999261944));
  p = fma(z, p, real(-0.3333307335));
  p = fma(z, p, real(0.9999999848));
  return select(steep, 1.57079632679489662 - t * p, t * p);
}
