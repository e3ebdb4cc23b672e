// Gaussians of extinction, c exp(-|x - center|^2 / radius^2); on a ray c exp(-(h^2 + (t - foot)^2) / radius^2), h and foot as from perpendicular().

// Extinction at a distance from the centre, beside c. From exp(-60) on it is held: no denormal arises.
FORMULA real gaussian_falloff(real inverse_radius, real distance_squared) {
  return exp_(-min(distance_squared * (inverse_radius * inverse_radius), 60.0));
}

// Half of what a Gaussian at a distance h from a line has there, beside one on the line.
FORMULA real gaussian_half(real inverse_radius, real h) {
  real y = h * inverse_radius;
  return 0.5 * exp_(-min(y * y, 60.0));
}

// Optical depth between `from` and `to`, both counted from the foot, as a share of the whole line through the centre, c radius sqrt(pi).
FORMULA real gaussian_depth(real inverse_radius, real h, real from, real to) {
  return gaussian_half(inverse_radius, h) * max(erf_(to * inverse_radius) - erf_(from * inverse_radius), 0.0);
}

// The same from `from` on, without an end.
FORMULA real gaussian_depth_beyond(real inverse_radius, real h, real from) {
  return gaussian_half(inverse_radius, h) * max(1.0 - erf_(from * inverse_radius), 0.0);
}

// Optical depth of the whole line through the centre.
FORMULA real gaussian_whole(real extinction, real radius) { return extinction * radius * 1.7724538509055160; }
