#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/shadow_lists.glsl"

// Turns the planes of a run into lists of lit parts, for gpu/lit_rays.glsl.

int found = 0;

void take_lit_part(float from, float to) {
  lists[list_at(found)] = uvec2(floatBitsToUint(from), floatBitsToUint(to));
  ++found;
}

void main() {
  ivec2 p = in_run() + corner_size.xy;
  if (outside(p) || outside_run(in_run())) return;
  int n = list_crossings(p);
  if (n > capacity) return;
  take_lit_parts(n);
  lists[list_at(capacity)].x = uint(found);
  atomicMax(most_lit_parts, uint(found));
}
