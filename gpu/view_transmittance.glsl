#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 0, r32f) uniform writeonly image2DArray transmittance_image;
layout(binding = 1, r32f) uniform writeonly image2DArray optical_depth_image;

layout(std140, binding = 2) uniform Knobs {
  float extinction;
  float sky_distance;
};

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  float tau = optical_depth(ray_length(texelFetch(distance_image, at, 0).x, sky_distance), extinction);
  imageStore(transmittance_image, at, vec4(transmittance(tau)));
#ifdef WITH_OPTICAL_DEPTH
  imageStore(optical_depth_image, at, vec4(tau));
#endif
}
