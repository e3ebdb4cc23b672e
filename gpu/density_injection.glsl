// Two programs: INJECT, an invocation a value of the grid in its ring; BOUND, one a brick of lookups.
#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/medium.glsl"

layout(std430, binding = 0) buffer ExtinctionBuffer { float extinctions[]; };  // laid out as common/plan/voxels.h tells
layout(std430, binding = 1) readonly buffer BeginBuffer { int begin[]; };      // of the list of each block of cells
layout(std430, binding = 2) readonly buffer ListBuffer { int list[]; };        // Gaussians that reach into it

uniform int first_item;
uniform int size_x;  // cells
uniform int size_y;
uniform int size_z;
uniform float cell;
uniform int first_entry;  // of each list, in this dispatch
uniform int end_entry;

int item() { return first_item + int(gl_WorkGroupID.x) * 64 + int(gl_LocalInvocationIndex); }
ivec3 place_of(int n, ivec3 size) { return ivec3(n % size.x, n / size.x % size.y, n / size.x / size.y); }

#ifdef INJECT
const int block_side = 8;

// Of an axis of a Gaussian's cells; 0 for those that it does not reach.
float share_of(int axis, int at, float center, float reach, float radius) {
  if (float(at) < floor((center - reach) / cell - 0.5) || float(at) >= floor((center + reach) / cell + 1.5)) return 0.0;
  float first = 0.5 * cell - center;
  return injected_gaussian(1.0 / radius, fma(float(at), cell, first), cell);
}

void main() {
  ivec3 size = ivec3(size_x, size_y, size_z);
  int n = item();
  ivec3 ring = size + 2;
  if (n >= ring.x * ring.y * ring.z) return;
  if (n < 3 && first_entry == 0) extinctions[n] = float(size[n]);
  ivec3 at = place_of(n, ring) - 1;
  if (any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, size))) {
    extinctions[3 + n] = 0.0;
    return;
  }
  float value = first_entry == 0 ? 0.0 : extinctions[3 + n];
#ifdef WITH_GAUSSIANS
  ivec3 blocks = (size + block_side - 1) / block_side;
  ivec3 block = at / block_side;
  int b = block.x + blocks.x * (block.y + blocks.y * block.z);
  int last = min(begin[b + 1], begin[b] + end_entry);
  for (int entry = begin[b] + first_entry; entry < last; ++entry) {
    int g = list[entry];
    vec4 c = center_radius(g);
    float reach = emission_reach(g).w;
    float y = albedo_extinction_of(g).w * share_of(2, at.z, c.z, reach, c.w) * share_of(1, at.y, c.y, reach, c.w);
    if (y > 0.0) value = fma(share_of(0, at.x, c.x, reach, c.w), y, value);
  }
#endif
#ifdef WITH_GRID
  if (first_entry == 0) value += grid_extinction_at((vec3(at) + 0.5) * cell);
#endif
  extinctions[3 + n] = value;
}
#endif

#ifdef BOUND
void main() {
  ivec3 ring = ivec3(size_x, size_y, size_z) + 2;
  ivec3 bricks = (ring + 2) / 4;
  int n = item();
  int head = 3 + ring.x * ring.y * ring.z;
  if (n < 3) extinctions[head + n] = float(bricks[n]);
  if (n >= bricks.x * bricks.y * bricks.z) return;
  ivec3 first = 4 * place_of(n, bricks);
  ivec3 last = min(first + 5, ring);
  float most = 0.0;
  for (int k = first.z; k < last.z; ++k) {
    for (int j = first.y; j < last.y; ++j) {
      for (int i = first.x; i < last.x; ++i) most = max(most, extinctions[3 + i + ring.x * (j + ring.y * k)]);
    }
  }
  extinctions[head + 3 + n] = most;
}
#endif
