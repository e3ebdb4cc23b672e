#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray scattered_image;
layout(binding = 0, rgba32f) uniform writeonly image2DArray airlight_image;
layout(binding = 1, rgba32f) uniform writeonly image2DArray per_light_image;

layout(std140, binding = 2) uniform Knobs {
  vec4 albedo_extinction;
  vec4 ambient_sky_distance;
  vec4 emission_g;
  int phase_kind;
};

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  float extinction = albedo_extinction.w;
  float length = ray_length(texelFetch(distance_image, at, 0).x, ambient_sky_distance.w);
  float tau = optical_depth(length, extinction);
  vec3 d = pixel_ray(p);
  vec3 sum = ambient_sky_distance.xyz * opacity(tau) + emission_g.xyz * attenuated_length(length, extinction, tau);
  for (int k = 0; k < light_count.x; ++k) {
    vec4 vector_radius = light_values[2 * k];
    vec4 power_directional = light_values[2 * k + 1];
    float once = 0.0;
#ifdef WITH_SCATTERED
    once = texelFetch(scattered_image, ivec3(p, k), 0).x;
#else
    if (extinction > 0.0) {
      once = airlight_of(vector_radius, power_directional.w != 0.0, d, phase_kind, emission_g.w, extinction, 0.0, length);
    }
#endif
    vec3 scattered = once * (power_directional.xyz * albedo_extinction.xyz);
#ifdef WITH_PER_LIGHT
    imageStore(per_light_image, ivec3(p, k), vec4(scattered, 0.0));
#endif
    sum += scattered;
  }
  imageStore(airlight_image, at, vec4(sum, 0.0));
}
