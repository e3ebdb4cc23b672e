#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray surface;
layout(binding = 1) uniform sampler2DArray airlight;
layout(binding = 0, rgba32f) uniform writeonly image2DArray beauty;

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  imageStore(beauty, at, texelFetch(surface, at, 0) + texelFetch(airlight, at, 0));
}
