// Lambert and normalised Phong reflection, as radiance per unit of irradiance on a facing plane.

// diffuse / pi * max(0, n.l)
FORMULA real lambert(real cos_normal_light) {
  return max(cos_normal_light, 0.0) * 0.31830988618379067;
}

// Half the squared distance of two unit vectors: 1 - cos of the angle between them, to full relative accuracy where it is small.
FORMULA real unit_distance(real ax, real ay, real az, real bx, real by, real bz) {
  real x = ax - bx;
  real y = ay - by;
  real z = az - bz;
  return fma(x, x, fma(y, y, z * z)) * 0.5;
}

// (n + 1) / (2 pi) * max(0, r.l)^n, r the mirror of the view direction; no cosine (classic normalised Phong). Light comes
// from the front only: 0 where n.l <= 0. Exponents from 0 to 1e4. `apart` is 1 - r.l: a power as high as that of a cosine near 1 would
// lose its digits.
FORMULA real phong(real cos_normal_light, real apart, real shininess) {
  real c = max(1.0 - apart, 1e-30);
  EXACT real rounding = (1.0 - c) - apart;  // of 1 - apart, exact where it matters
  real lobe = exp_(max(shininess * (log_(c) + rounding), -87.0));
  real value = (shininess + 1.0) * 0.15915494309189535 * lobe;
  return select((cos_normal_light > 0.0) && (apart < 1.0), value, real(0.0));
}
