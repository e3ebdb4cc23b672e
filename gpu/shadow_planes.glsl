#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

// One light over one run of tiles, a rectangle of the screen.

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 0, r32f) uniform writeonly image2DArray scattered_image;
layout(binding = 1, r32f) uniform writeonly image2DArray light_transmittance_image;

layout(std140, binding = 2) uniform Knobs {
  float extinction;
  float sky_distance;
  float phase_g;
  int phase_kind;
};
layout(std140, binding = 3) uniform Run {
  ivec4 corner_size;  // of the rectangle [pixel]
  int tile_side;
  int light;
  int covering;   // triangles between camera and light
  int capacity;   // crossings that the list of a pixel holds
  int any_plane;  // 0: no plane touches the rectangle, and there are no lists
};

// Where a tile's planes begin in `planes`; one more at the end.
layout(std430, binding = 0) readonly buffer TileBlock { int tile_begin[]; };
// Three vectors a plane: the values of u, v, e, k (common/plan/shadow_quads.h) at the tile's corner, what they gain a column, and a row.
layout(std430, binding = 1) readonly buffer PlaneBlock { vec4 planes[]; };
layout(std430, binding = 2) readonly buffer ChangeBlock { int changes[]; };
// Slot by slot, in each a pixel of the rectangle after the other: 1/z and change.
layout(std430, binding = 3) buffer ListBlock { uvec2 lists[]; };
layout(std430, binding = 4) buffer MostBlock { uint most_crossings; };

// The ray of this pixel, and the light beside it.
float reach;  // its length [m]
float slant;  // length over z
bool directional;
float mu;    // directional light: cosine between its direction and the ray
float foot;  // point light: of the perpendicular on the ray, and its length [m]
float h;

float airlight(float from, float to) {
#ifdef WITH_SCATTERED
  if (extinction > 0.0) {
    return directional ? directional_airlight(phase_kind, phase_g, extinction, mu, from, to)
                       : point_airlight(0, phase_kind, phase_g, extinction, foot, h, from, to);
  }
#endif
  return 0.0;
}

#ifdef PUBLISHED_ORDER

// Planes as wholes, from the last to the first, in the order of the lists: see ShadowOrder.
float sum_of_crossings(int n, int stride, int first, out bool lit) {
  int stencil = covering;
  for (int i = 0; i < n; ++i) stencil += int(lists[i * stride + first].y);
  lit = stencil <= 0;
  float sum = lit ? airlight(0.0, reach) : 0.0;
#ifdef WITH_SCATTERED
  for (int i = 0; i < n; ++i) {
    uvec2 one = lists[i * stride + first];
    bool was_lit = stencil <= 0;
    stencil -= int(one.y);
    if (was_lit == (stencil <= 0)) continue;
    float once = airlight(0.0, min(slant / uintBitsToFloat(one.x), reach));
    sum += was_lit ? -once : once;
  }
#endif
  return sum;
}

#else

bool nearer(uvec2 a, uvec2 b) {
  float p = uintBitsToFloat(a.x);
  float q = uintBitsToFloat(b.x);
  return p > q || (!(p < q) && int(a.y) < int(b.y));
}

// Sorted by distance, then lit part by lit part.
float sum_of_crossings(int n, int stride, int first, out bool lit) {
  // Nearest first: Shell's sort, which is insertion sort for short lists.
  int gap = 1;
  while (gap * 3 + 1 < n) gap = gap * 3 + 1;
  for (; gap > 0; gap /= 3) {
    for (int i = gap; i < n; ++i) {
      uvec2 one = lists[i * stride + first];
      int hole = i;
      for (; hole >= gap; hole -= gap) {
        uvec2 before = lists[(hole - gap) * stride + first];
        if (!nearer(one, before)) break;
        lists[hole * stride + first] = before;
      }
      lists[hole * stride + first] = one;
    }
  }

  float sum = 0.0;
  int count = covering;
  float at = 0.0;         // where the ray has been followed to
  float lit_from = -1.0;  // of the lit part that is open; negative: none
  for (int i = 0; i <= n + 1; ++i) {  // the last two: the part before the ray's end, and closing what is open there
    float next = reach;
    int change = 0;
    if (i < n) {
      uvec2 one = lists[i * stride + first];
      next = min(slant / uintBitsToFloat(one.x), reach);
      change = int(one.y);
    }
    // Parts of no length count for nothing: planes crossed at the same place may come in any order.
    if (at < next || i > n) {
      bool lit_here = count <= 0 && i <= n;
      if (lit_here && lit_from < 0.0) lit_from = at;
      if (!lit_here && lit_from >= 0.0) {
        sum += airlight(lit_from, at);
        lit_from = -1.0;
      }
    }
    count += change;
    at = next;
  }
  lit = count <= 0;
  return sum;
}

#endif

void main() {
  ivec2 in_run = ivec2(gl_GlobalInvocationID.xy);
  ivec2 p = in_run + corner_size.xy;
  if (outside(p) || in_run.x >= corner_size.z || in_run.y >= corner_size.w) return;
  reach = ray_length(texelFetch(distance_image, ivec3(p, 0), 0).x, sky_distance);
  vec3 d = pixel_ray(p);
  slant = 1.0 / dot3(d, view_forward.xyz);
  float end = slant / max(reach, 1e-30);
  int stride = corner_size.z * corner_size.w;
  int first = in_run.y * corner_size.z + in_run.x;

  int n = 0;
  if (any_plane != 0) {
    int tile = in_run.x / tile_side;
    vec2 in_tile = vec2(in_run.x - tile * tile_side, in_run.y);
    for (int i = tile_begin[tile]; i < tile_begin[tile + 1]; ++i) {
      vec4 f = fma(vec4(in_tile.x), planes[3 * i + 1], fma(vec4(in_tile.y), planes[3 * i + 2], planes[3 * i]));
      if (f.x >= 0.0 && f.y < 0.0 && f.z >= 0.0 && f.w > end) {
        if (n < capacity) lists[n * stride + first] = uvec2(floatBitsToUint(f.w), uint(changes[i]));
        ++n;
      }
    }
    if (n > capacity) atomicMax(most_crossings, uint(n));
  }
  if (n > capacity) return;  // the run is repeated with longer lists

  vec4 vector_radius = light_values[2 * light];
  vec3 v = vector_radius.xyz;
  directional = light_values[2 * light + 1].w != 0.0;
  mu = -dot3(v, d);
  foot = 0.0;
  h = 1.0;
  if (!directional) perpendicular(d.x, d.y, d.z, v.x, v.y, v.z, vector_radius.w, foot, h);
  bool lit;
  float sum = sum_of_crossings(n, stride, first, lit);
#ifdef WITH_SCATTERED
  imageStore(scattered_image, ivec3(p, light), vec4(sum));
#endif
#ifdef WITH_LIGHT_TRANSMITTANCE
  imageStore(light_transmittance_image, ivec3(p, light), vec4(lit ? 1.0 : 0.0));
#endif
}
