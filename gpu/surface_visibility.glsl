// Four programs in one file: INDICES makes an index buffer, VERTEX and FRAGMENT find the nearest triangle on each pixel, RESOLVE computes
// what is seen of it.
#include "gpu/dialect.glsl"

#ifdef VERTEX
layout(location = 0) in vec3 position;
layout(std140, binding = 2) uniform Knobs {
  vec4 right;    // w: x scale
  vec4 up;       // w: y scale
  vec4 forward;  // w: near plane
  vec4 shift;    // xy: of the image, in clip space
};
// Reversed depth, near / z, and no far plane: the same relative precision at every distance.
void main() {
  float z = dot(position, forward.xyz);
  gl_Position = vec4(dot(position, right.xyz) * right.w + shift.x * z, dot(position, up.xyz) * up.w + shift.y * z, forward.w, z);
}
#endif

#ifdef FRAGMENT
uniform int first_triangle;  // of this draw
layout(location = 0) out uint hit;
void main() { hit = uint(first_triangle + gl_PrimitiveID) + 1u; }
#endif

#ifdef RESOLVE
#include "gpu/screen.glsl"
layout(binding = 0) uniform usampler2DArray hit_image;
uniform int slab_row;  // of the image, that is row 0 of hit_image
layout(binding = 0, r32f) uniform writeonly image2DArray distance_image;
layout(binding = 1, rgba32f) uniform writeonly image2DArray normal_image;
layout(binding = 2, r32f) uniform writeonly image2DArray material_image;
#ifdef WITH_CORNERS
layout(binding = 3, rgba32f) uniform writeonly image2DArray corners_image;
#endif
layout(std430, binding = 0) readonly buffer PositionBlock { float positions[]; };
layout(std430, binding = 1) readonly buffer NormalBlock { float normals[]; };
layout(std430, binding = 2) readonly buffer TriangleBlock { uvec4 triangles[]; };

vec3 position_of(uint i) { return vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]); }
vec3 normal_of(uint i) { return vec3(normals[3u * i], normals[3u * i + 1u], normals[3u * i + 2u]); }

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  uint hit = texelFetch(hit_image, ivec3(p.x, in_image(p).y - slab_row, 0), 0).x;
  float along = 1e30;
  vec3 n = vec3(0.0);
  float material = -1.0;
#ifdef WITH_CORNERS
  vec3 corners = vec3(0.0);
#endif
  if (hit != 0u) {
    uvec4 t = triangles[hit - 1u];
    vec3 a = position_of(t.x);
    vec3 b = position_of(t.y);
    vec3 c = position_of(t.z);
    vec3 d = pixel_ray(p);
    float wb;
    float wc;
    ray_triangle(d.x, d.y, d.z, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, along, wb, wc);
    vec3 na = normal_of(t.x);
    vec3 nb = normal_of(t.y);
    vec3 nc = normal_of(t.z);
    shading_normal(d.x, d.y, d.z, na.x, na.y, na.z, nb.x, nb.y, nb.z, nc.x, nc.y, nc.z, wb, wc, n.x, n.y, n.z);
    material = float(t.w);
#ifdef WITH_CORNERS
    float side = seen_side(d.x, d.y, d.z, na.x, na.y, na.z, nb.x, nb.y, nb.z, nc.x, nc.y, nc.z, wb, wc);
    corners = vec3(float(hit) * side, wb, wc);
#endif
  }
  imageStore(distance_image, at, vec4(along));
  imageStore(normal_image, at, vec4(n, 0.0));
  imageStore(material_image, at, vec4(material));
#ifdef WITH_CORNERS
  imageStore(corners_image, at, vec4(corners, 0.0));
#endif
}
#endif

#ifdef INDICES
// Three of each triangle's four numbers.
layout(local_size_x = 64) in;
uniform int first_item;
uniform int items;
layout(std430, binding = 0) readonly buffer TriangleBlock { uvec4 triangles[]; };
layout(std430, binding = 1) writeonly buffer IndexBlock { uint indices[]; };
void main() {
  int i = first_item + int(gl_GlobalInvocationID.x);
  if (i >= items) return;
  uvec4 t = triangles[i];
  indices[3 * i] = t.x;
  indices[3 * i + 1] = t.y;
  indices[3 * i + 2] = t.z;
}
#endif
