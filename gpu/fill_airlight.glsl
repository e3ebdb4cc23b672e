#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray remaining;
layout(binding = 1) uniform sampler2DArray upsampled_airlight;
layout(binding = 2) uniform sampler2DArray upsampled_transmittance;
layout(binding = 3) uniform sampler2DArray computed_airlight;
layout(binding = 4) uniform sampler2DArray computed_transmittance;
layout(binding = 0, rgba32f) uniform writeonly image2DArray airlight;
layout(binding = 2, r32f) uniform writeonly image2DArray transmittance_image;
#ifdef WITH_PER_LIGHT
layout(binding = 5) uniform sampler2DArray upsampled_per_light;
layout(binding = 6) uniform sampler2DArray computed_per_light;
layout(binding = 1, rgba32f) uniform writeonly image2DArray per_light;
uniform int layers;
#endif

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  bool computed = texelFetch(remaining, at, 0).x > 0.0;
  imageStore(airlight, at, computed ? texelFetch(computed_airlight, at, 0) : texelFetch(upsampled_airlight, at, 0));
  imageStore(transmittance_image, at, computed ? texelFetch(computed_transmittance, at, 0) : texelFetch(upsampled_transmittance, at, 0));
#ifdef WITH_PER_LIGHT
  for (int k = 0; k < layers; ++k) {
    ivec3 layer = ivec3(p, k);
    imageStore(per_light, layer, computed ? texelFetch(computed_per_light, layer, 0) : texelFetch(upsampled_per_light, layer, 0));
  }
#endif
}
