#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/medium.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
#ifdef WITH_LIT
layout(binding = 1) uniform sampler2DArray lit_image;
#endif
layout(binding = 0, r32f) uniform writeonly image2DArray light_transmittance_image;
#ifdef WITH_DEPTH
layout(binding = 1, r32f) uniform writeonly image2DArray depth_image;
#endif

uniform int first_light;  // of this dispatch
uniform int end_light;

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  float depth = texelFetch(distance_image, ivec3(p, 0), 0).x;
  vec3 place = pixel_ray(p) * depth;
  for (int k = first_light; k < end_light; ++k) {
    float toward = 0.0;
    if (depth < 1e30) toward = depth_to(k, light_values[2 * k].xyz, light_values[2 * k + 1].w != 0.0, place);
    float through = transmittance(toward);
#ifdef WITH_DEPTH
    imageStore(depth_image, ivec3(p, k), vec4(toward));
#endif
#ifdef WITH_LIT
    through *= texelFetch(lit_image, ivec3(p, k), 0).x;
#endif
    imageStore(light_transmittance_image, ivec3(p, k), vec4(through));
  }
}
