#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/gaussian_mean_depth.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray material_image;
layout(binding = 0, r32f) uniform writeonly image2DArray mean_depth_image;

uniform int gaussian_count;

// Two vectors a surface's lattice: corner and 1 / spacing; nodes and the first one's number.
layout(std430, binding = 0) readonly buffer LatticeBlock { vec4 lattices[]; };

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  float index = texelFetch(material_image, at, 0).x;
  float depth = 0.0;
  if (index >= 0.0) {
    vec3 place = pixel_ray(p) * texelFetch(distance_image, at, 0).x;
#ifdef WITH_LATTICES
    vec4 corner_scale = lattices[2 * int(index)];
    ivec4 nodes_first = floatBitsToInt(lattices[2 * int(index) + 1]);
    vec3 nodes = vec3(nodes_first.xyz);
    vec3 c = (place - corner_scale.xyz) * corner_scale.w;
    depth = value_among_nodes(nodes_first.w, 0.0, nodes.x, nodes.y, nodes.z, c.x, c.y, c.z);
#else
    depth = gaussian_mean_depth(gaussian_count, place);
#endif
  }
  imageStore(mean_depth_image, at, vec4(depth, 0.0, 0.0, 0.0));
}
