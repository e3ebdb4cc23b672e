// Noise that bends view rays (Zhou et al. 2007, section 5.5). Gradient noise by Perlin ("Improving Noise", 2002): twelve gradients toward the
// middles of a cube's edges, a quintic between them; which of them stands where is told by arithmetic, so that lanes need no table.

// Cells after which the noise repeats along each axis.
FORMULA real noise_period() {
  return 256.0;
}

// x modulo n in 0 .. n - 1, for integral x and n below 2^24, however the quotient is rounded.
FORMULA real wrapped(real x, real n) {
  real r = x - n * floor(x / n);
  r = select(r < 0.0, r + n, r);
  return select(r < n, r, r - n);
}

// A permutation of 0..288, for integral x of 0..576: a polynomial is one modulo 17^2 where its other coefficients are multiples of 17.
FORMULA real permuted(real x) {
  return wrapped((34.0 * x + 1.0) * x, 289.0);
}

// The product of (x, y, z) and the gradient that the hash, integral and not negative, tells in its last four bits.
FORMULA real noise_gradient(real hash, real x, real y, real z) {
  real last = wrapped(hash, 16.0);
  real pair = floor(last * 0.5);
  mask along_x = (last > 11.5 && last < 12.5) || (last > 13.5 && last < 14.5);
  real one = select(last < 8.0, x, y);
  real other = select(last < 4.0, y, select(along_x, x, z));
  mask turn_one = last - 2.0 * pair > 0.5;
  mask turn_other = pair - 2.0 * floor(pair * 0.5) > 0.5;
  return select(turn_one, -one, one) + select(turn_other, -other, other);
}

FORMULA real noise_fade(real t) {
  return t * t * t * fma(t, fma(t, 6.0, -15.0), 10.0);
}

// Three noises, of one lattice place each: the products of their gradients and the way from there.
FORMULA void noise_corner(real hash, real x, real y, real z, OUT(real) a, OUT(real) b, OUT(real) c) {
  a = noise_gradient(hash, x, y, z);
  b = noise_gradient(permuted(hash + 1.0), x, y, z);
  c = noise_gradient(permuted(hash + 2.0), x, y, z);
}

// Between two places along z, numbers k0 and k1, w on the way from one to the other.
FORMULA void noise_edge(real hash, real k0, real k1, real x, real y, real z, real w, OUT(real) a, OUT(real) b, OUT(real) c) {
  real a1;
  real b1;
  real c1;
  noise_corner(permuted(hash + k0), x, y, z, a, b, c);
  noise_corner(permuted(hash + k1), x, y, z - 1.0, a1, b1, c1);
  a = fma(w, a1 - a, a);
  b = fma(w, b1 - b, b);
  c = fma(w, c1 - c, c);
}

FORMULA void noise_face(real hash, real j0, real j1, real k0, real k1, real x, real y, real z, real v, real w, OUT(real) a, OUT(real) b,
                        OUT(real) c) {
  real a1;
  real b1;
  real c1;
  noise_edge(permuted(hash + j0), k0, k1, x, y, z, w, a, b, c);
  noise_edge(permuted(hash + j1), k0, k1, x, y - 1.0, z, w, a1, b1, c1);
  a = fma(v, a1 - a, a);
  b = fma(v, b1 - b, b);
  c = fma(v, c1 - c, c);
}

// Three noises at a place, each in -noise_bound() .. noise_bound() and 0 at each lattice place; |x|, |y|, |z| below 2^23.
FORMULA void gradient_noise(real x, real y, real z, OUT(real) a, OUT(real) b, OUT(real) c) {
  real i = floor(x);
  real j = floor(y);
  real k = floor(z);
  x = x - i;
  y = y - j;
  z = z - k;
  real j0 = wrapped(j, noise_period());
  real j1 = wrapped(j + 1.0, noise_period());
  real k0 = wrapped(k, noise_period());
  real k1 = wrapped(k + 1.0, noise_period());
  real u = noise_fade(x);
  real v = noise_fade(y);
  real w = noise_fade(z);
  real a1;
  real b1;
  real c1;
  noise_face(permuted(wrapped(i, noise_period())), j0, j1, k0, k1, x, y, z, v, w, a, b, c);
  noise_face(permuted(wrapped(i + 1.0, noise_period())), j0, j1, k0, k1, x - 1.0, y, z, v, w, a1, b1, c1);
  a = fma(u, a1 - a, a);
  b = fma(u, b1 - b, b);
  c = fma(u, c1 - c, c);
}

// Were all gradients the worst ones, it would be 1.04 (tests/formulas/checks/noise.cpp).
FORMULA real noise_bound() {
  return 1.05;
}

// Direction in which the ray of unit direction d is taken to cross a Gaussian: d and, at the place of the ray nearest to its centre c, the noise
// times amplitude * radius / |c|, which moves the ray there by as much beside the Gaussian wherever it is; where the camera is nearer than a
// radius, times the amplitude alone. Relative to the camera, as offset is: noise is taken at place / scale + offset.
FORMULA void bent_ray(real dx, real dy, real dz, real cx, real cy, real cz, real radius, real amplitude, real inverse_scale, real offset_x,
                      real offset_y, real offset_z, OUT(real) x, OUT(real) y, OUT(real) z) {
  real foot = max(fma(dx, cx, fma(dy, cy, dz * cz)), 0.0) * inverse_scale;
  real a;
  real b;
  real c;
  gradient_noise(fma(foot, dx, offset_x), fma(foot, dy, offset_y), fma(foot, dz, offset_z), a, b, c);
  real size = amplitude * radius / max(sqrt(fma(cx, cx, fma(cy, cy, cz * cz))), radius);
  x = fma(size, a, dx);
  y = fma(size, b, dy);
  z = fma(size, c, dz);
  real scale = 1.0 / max(sqrt(fma(x, x, fma(y, y, z * z))), 1e-6);
  x = x * scale;
  y = y * scale;
  z = z * scale;
}
