// Gaussians of extinction, c exp(-|x - center|^2 / radius^2); on a ray c exp(-(h^2 + (t - foot)^2) / radius^2), h and foot as from perpendicular().

// Extinction at a distance from the centre, beside c. From exp(-60) on it is held: no denormal arises.
FORMULA real gaussian_falloff(real inverse_radius, real distance_squared) {
  return exp_(-min(distance_squared * (inverse_radius * inverse_radius), 60.0));
}

// What a Gaussian has at a distance h from its centre, beside c: on a ray, its part in every place.
FORMULA real gaussian_lateral(real inverse_radius, real h) {
  real y = h * inverse_radius;
  return exp_(-min(y * y, 60.0));
}

// Optical depth between two places, as a share of the whole line through the centre, c radius sqrt(pi); given erf_ of the places, counted from the foot in radii.
FORMULA real gaussian_between(real lateral, real erf_from, real erf_to) { return 0.5 * lateral * max(erf_to - erf_from, 0.0); }

// The same between `from` and `to`, both counted from the foot [m].
FORMULA real gaussian_depth(real inverse_radius, real h, real from, real to) {
  return gaussian_between(gaussian_lateral(inverse_radius, h), erf_(from * inverse_radius), erf_(to * inverse_radius));
}

// The same from `from` on, without an end.
FORMULA real gaussian_depth_beyond(real inverse_radius, real h, real from) {
  return gaussian_between(gaussian_lateral(inverse_radius, h), erf_(from * inverse_radius), real(1.0));
}

// Optical depth of the whole line through the centre.
FORMULA real gaussian_whole(real extinction, real radius) { return extinction * radius * 1.7724538509055160; }
