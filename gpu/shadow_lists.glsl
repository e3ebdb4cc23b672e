// Which planes the ray of a pixel crosses, and between them the parts that the light reaches. After gpu/dialect.glsl and gpu/screen.glsl.
#include "gpu/shadow_run.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;

// Where a tile's planes begin in `planes`; one more at the end.
layout(std430, binding = 0) readonly buffer TileBlock { int tile_begin[]; };
// Three vectors a plane: the values of u, v, e, k (common/plan/shadow_quads.h) at the tile's corner, what they gain a column, and a row.
layout(std430, binding = 1) readonly buffer PlaneBlock { vec4 planes[]; };
layout(std430, binding = 2) readonly buffer ChangeBlock { int changes[]; };
layout(std430, binding = 4) buffer MostBlock {
  uint most_crossings;  // where there are too many
  uint most_lit_parts;  // of gpu/lit_parts.glsl
};

// The ray of this pixel.
vec3 d;
float reach;  // its length [m]
float slant;  // length over z

// Sets these and lists the crossings, in the order of the planes. Returns how many there are; more than `capacity`: the list is too short, and the
// run is repeated.
int list_crossings(ivec2 p) {
  reach = ray_length(texelFetch(distance_image, ivec3(p, 0), 0).x, run_sky_distance);
  d = pixel_ray(p);
  slant = 1.0 / dot3(d, view_forward.xyz);
  float end = slant / max(reach, 1e-30);
  if (any_plane == 0) return 0;
  int n = 0;
  int tile = in_run().x / tile_side;
  vec2 in_tile = vec2(in_run().x - tile * tile_side, in_run().y);
  for (int i = tile_begin[tile]; i < tile_begin[tile + 1]; ++i) {
    vec4 f = fma(vec4(in_tile.x), planes[3 * i + 1], fma(vec4(in_tile.y), planes[3 * i + 2], planes[3 * i]));
    if (f.x >= 0.0 && f.y < 0.0 && f.z >= 0.0 && f.w > end) {
      if (n < capacity) lists[list_at(n)] = uvec2(floatBitsToUint(f.w), uint(changes[i]));
      ++n;
    }
  }
  if (n > capacity) atomicMax(most_crossings, uint(n));
  return n;
}

#ifndef PUBLISHED_ORDER

// What to do with each lit part, nearest first. It may overwrite as many slots of the list as there were parts.
void take_lit_part(float from, float to);

bool nearer(uvec2 a, uvec2 b) {
  float p = uintBitsToFloat(a.x);
  float q = uintBitsToFloat(b.x);
  return p > q || (!(p < q) && int(a.y) < int(b.y));
}

// Sorts n crossings by distance, then goes from lit part to lit part. Returns whether the ray's end is lit.
bool take_lit_parts(int n) {
  // Nearest first: Shell's sort, which is insertion sort for short lists.
  int gap = 1;
  while (gap * 3 + 1 < n) gap = gap * 3 + 1;
  for (; gap > 0; gap /= 3) {
    for (int i = gap; i < n; ++i) {
      uvec2 one = lists[list_at(i)];
      int hole = i;
      for (; hole >= gap; hole -= gap) {
        uvec2 before = lists[list_at(hole - gap)];
        if (!nearer(one, before)) break;
        lists[list_at(hole)] = before;
      }
      lists[list_at(hole)] = one;
    }
  }

  int count = covering;
  float at = 0.0;         // where the ray has been followed to
  float lit_from = -1.0;  // of the lit part that is open; negative: none
  for (int i = 0; i <= n + 1; ++i) {  // the last two: the part before the ray's end, and closing what is open there
    float next = reach;
    int change = 0;
    if (i < n) {
      uvec2 one = lists[list_at(i)];
      next = min(slant / uintBitsToFloat(one.x), reach);
      change = int(one.y);
    }
    // Parts of no length count for nothing: planes crossed at the same place may come in any order.
    if (at < next || i > n) {
      bool lit_here = count <= 0 && i <= n;
      if (lit_here && lit_from < 0.0) lit_from = at;
      if (!lit_here && lit_from >= 0.0) {
        take_lit_part(lit_from, at);
        lit_from = -1.0;
      }
    }
    count += change;
    at = next;
  }
  return count <= 0;
}

#endif
