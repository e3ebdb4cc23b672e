// Real spherical harmonics of the bands 0..5, for functions of direction that are smooth: the surfaces and environments of Zhou et al. 2007, section 4.
//
// y_lm stands at l (l + 1) + m and is orthonormal over the sphere; z is its axis, m > 0 goes with cos(m phi), m < 0 with sin(-m phi), no sign of Condon
// and Shortley. An expansion of `order` n in 1..6 has the bands below n, n^2 coefficients. Polynomials in x, y, z: the direction must be a unit vector.
// A function g of the angle from the z axis alone has one coefficient a band, g_l, that of y_l0: a table of six.

// The basis in a direction: what is told of the first order^2 of v. By eq. 24 and 23 that is the most peaked function of that order about the direction.
FORMULA void sh_basis(int order, real x, real y, real z, OUT_LIST(v, 36)) {
  v[0] = real(0.28209479177387814);
  if (order <= 1) return;
  v[2] = z * 0.4886025119029199;
  v[1] = y * 0.48860251190292;
  v[3] = x * 0.48860251190292;
  if (order <= 2) return;
  real zz = z * z;
  real c2 = fma(x, x, -(y * y));
  real s2 = 2.0 * x * y;
  v[6] = fma(zz, real(0.9461746957575601), real(-0.31539156525252005));
  real p21 = z * 1.0925484305920792;
  v[5] = y * p21;
  v[7] = x * p21;
  v[4] = s2 * 0.5462742152960396;
  v[8] = c2 * 0.5462742152960396;
  if (order <= 3) return;
  real c3 = fma(x, c2, -(y * s2));
  real s3 = fma(x, s2, y * c2);
  v[12] = z * fma(zz, real(1.865881662950577), real(-1.1195289977703462));
  real p31 = fma(zz, real(2.285228997322329), real(-0.4570457994644658));
  v[11] = y * p31;
  v[13] = x * p31;
  real p32 = z * 1.4453057213202773;
  v[10] = s2 * p32;
  v[14] = c2 * p32;
  v[9] = s3 * 0.5900435899266436;
  v[15] = c3 * 0.5900435899266436;
  if (order <= 4) return;
  real c4 = fma(x, c3, -(y * s3));
  real s4 = fma(x, s3, y * c3);
  v[20] = fma(zz, fma(zz, real(3.7024941420321507), real(-3.1735664074561294)), real(0.31735664074561293));
  real p41 = z * fma(zz, real(4.683325804901025), real(-2.0071396306718676));
  v[19] = y * p41;
  v[21] = x * p41;
  real p42 = fma(zz, real(3.31161143515146), real(-0.47308734787878));
  v[18] = s2 * p42;
  v[22] = c2 * p42;
  real p43 = z * 1.7701307697799307;
  v[17] = s3 * p43;
  v[23] = c3 * p43;
  v[16] = s4 * 0.6258357354491763;
  v[24] = c4 * 0.6258357354491763;
  if (order <= 5) return;
  real c5 = fma(x, c4, -(y * s4));
  real s5 = fma(x, s4, y * c4);
  v[30] = z * fma(zz, fma(zz, real(7.367870314565687), real(-8.186522571739651)), real(1.754254836801354));
  real p51 = fma(zz, fma(zz, real(9.511879675109636), real(-6.341253116739757)), real(0.45294665119569694));
  v[29] = y * p51;
  v[31] = x * p51;
  real p52 = z * fma(zz, real(7.190305177459987), real(-2.396768392486662));
  v[28] = s2 * p52;
  v[32] = c2 * p52;
  real p53 = fma(zz, real(4.403144694917255), real(-0.4892382994352505));
  v[27] = s3 * p53;
  v[33] = c3 * p53;
  real p54 = z * 2.0756623148810416;
  v[26] = s4 * p54;
  v[34] = c4 * p54;
  v[25] = s5 * 0.6563820568401701;
  v[35] = c5 * 0.6563820568401701;
}

// Eq. 22: the value of an expansion where the basis is v.
FORMULA real sh_sum(table f, int order, IN_LIST(v, 36)) {
  real sum = v[0] * element(f, 0);
  for (int i = 1; i < order * order; ++i) sum = fma(v[i], element(f, i), sum);
  return sum;
}

// The same in a direction.
FORMULA real sh_value(table f, int order, real x, real y, real z) {
  real v[36];
  sh_basis(order, x, y, z, v);
  return sh_sum(f, order, v);
}

// What one band has of sh_sum().
FORMULA real sh_band(table f, int l, IN_LIST(v, 36)) {
  real sum = real(0.0);
  for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum = fma(v[i], element(f, i), sum);
  return sum;
}

// The same of an expansion that is given as a list.
FORMULA real sh_list_band(IN_LIST(f, 36), int l, IN_LIST(v, 36)) {
  real sum = real(0.0);
  for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum = fma(v[i], f[i], sum);
  return sum;
}

// sqrt(4 pi / (2 l + 1)): times g_l it is by what a convolution with g multiplies band l.
FORMULA real sh_zonal_factor(int l) { return sqrt(12.566370614359173 / (2.0 * real(l) + 1.0)); }

// Eq. 24: band l of the most peaked function about z.
FORMULA real sh_delta(int l) { return sqrt((2.0 * real(l) + 1.0) * 0.079577471545947668); }

// Eq. 23: g turned from z to an axis.
FORMULA void sh_rotated(table g, int order, real x, real y, real z, OUT_LIST(f, 36)) {
  sh_basis(order, x, y, z, f);
  for (int l = 0; l < order; ++l) {
    real factor = element(g, l) * sh_zonal_factor(l);
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) f[i] = f[i] * factor;
  }
}

// Eq. 21: f convolved with g, in place.
FORMULA void sh_convolve(table g, int order, IN_OUT_LIST(f, 36)) {
  for (int l = 0; l < order; ++l) {
    real factor = sh_zonal_factor(l) * element(g, l);
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) f[i] = f[i] * factor;
  }
}

// int f g h over the sphere (eq. 20). `products`: how many integrals of three basis functions are not 0, then i, j, k and the integral of each, as
// common/plan/spherical_harmonics.h makes them.
FORMULA real sh_triple_product(table products, IN_LIST(f, 36), IN_LIST(g, 36), IN_LIST(h, 36)) {
  int count = integer_element(products, 0);
  real sum = real(0.0);
  for (int n = 0; n < count; ++n) {
    int at = 4 * n + 1;
    real pair = f[integer_element(products, at)] * g[integer_element(products, at + 1)];
    sum = fma(pair * h[integer_element(products, at + 2)], element(products, at + 3), sum);
  }
  return sum;
}

// By what a convolution with the normalised lobe (n + 1) / (2 pi) max(0, cos)^n multiplies band l; n = 1 is Lambert's. From the recurrence of
// int_0^1 x^n P_l(x) dx: two bands on, it is (n - l + 2) / (n + l + 1) of it.
FORMULA real sh_lobe_factor(int l, real n) {
  real factor = real(1.0);
  int k = l;
  for (; k > 1; k -= 2) factor *= (n - real(k) + 2.0) / (n + real(k) + 1.0);
  if (k > 0) factor *= (n + 1.0) / (n + 2.0);
  return factor;
}
