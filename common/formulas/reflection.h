// Lambert and normalised Phong reflection, as radiance per unit of irradiance on a facing plane.

// diffuse / pi * max(0, n.l)
FORMULA real lambert(real cos_normal_light) {
  return max(cos_normal_light, 0.0) * 0.31830988618379067;
}

// (n + 1) / (2 pi) * max(0, r.l)^n, r the mirror of the view direction; no cosine (classic normalised Phong). Light comes
// from the front only: 0 where n.l <= 0. Exponents from 0 to 1e4.
FORMULA real phong(real cos_normal_light, real cos_mirror_light, real shininess) {
  real c = min(max(cos_mirror_light, 1e-30), 1.0);
  real lobe = exp_(max(shininess * log_(c), -87.0));
  real value = (shininess + 1.0) * 0.15915494309189535 * lobe;
  return select((cos_normal_light > 0.0) && (cos_mirror_light > 0.0), value, real(0.0));
}
