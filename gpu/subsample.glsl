#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray whole;
layout(binding = 0, r32f) uniform writeonly image2DArray part;
uniform int stride;
uniform int whole_row;  // of the other texture, where that of row 0 stands

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  imageStore(part, ivec3(p, 0), texelFetch(whole, ivec3(p * stride + ivec2(0, whole_row), 0), 0));
}
