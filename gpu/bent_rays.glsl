// Directions in which the ray d crosses Gaussians. Included after it.

#ifdef WITH_NOISE
uniform float noise_amplitude;
uniform float noise_inverse_scale;
uniform vec3 noise_offset;

vec3 way_across(vec3 center, float radius) {
  vec3 way;
  bent_ray(d.x, d.y, d.z, center.x, center.y, center.z, radius, noise_amplitude, noise_inverse_scale, noise_offset.x, noise_offset.y,
           noise_offset.z, way.x, way.y, way.z);
  return way;
}
#else
vec3 way_across(vec3 center, float radius) { return d; }
#endif
