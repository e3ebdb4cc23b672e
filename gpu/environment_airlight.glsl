#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray optical_depth_image;
layout(binding = 2) uniform sampler2DArray scattered_image;
layout(binding = 0, rgba32f) uniform writeonly image2DArray airlight_image;

layout(std140, binding = 2) uniform Knobs {
  vec4 albedo_extinction;
  vec4 gaussian_albedo_sky_distance;
};

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  vec3 d = pixel_ray(p);
  float tau = texelFetch(optical_depth_image, at, 0).x;
  float length = ray_length(texelFetch(distance_image, at, 0).x, gaussian_albedo_sky_distance.w);
  float homogeneous = min(optical_depth(length, albedo_extinction.w), tau);
  float rest = tau - homogeneous;
  float of_homogeneous;
  float of_rest;
#ifdef PUBLISHED
  float share = environment_scattered_published(tau) / max(tau, 1e-30);
  of_homogeneous = homogeneous * share;
  of_rest = rest * share;
#else
  environment_scattered(homogeneous, rest, of_homogeneous, of_rest);
#endif
  vec3 gathered;
  environment_reflection(0, d.x, d.y, d.z, gathered.x, gathered.y, gathered.z);
  vec3 albedo = fma(vec3(of_homogeneous), albedo_extinction.xyz, of_rest * gaussian_albedo_sky_distance.xyz);
  imageStore(airlight_image, at, vec4(fma(gathered, albedo, texelFetch(scattered_image, at, 0).xyz), 0.0));
}
