// The parts of a ray that a light reaches, as gpu/lit_parts.glsl lists them. A dispatch takes some of them.
#include "gpu/shadow_run.glsl"

uniform int first_lit;
uniform int most_lit;

int lit_at;  // the first that may matter still
int lit_end;

ivec2 this_lit_pixel() { return in_run() + corner_size.xy; }

void begin_lit() {
  int all = any_plane == 0 ? (covering > 0 ? 0 : 1) : int(lists[list_at(capacity)].x);
  lit_at = min(first_lit, all);
  lit_end = min(first_lit + most_lit, all);
}

vec2 lit_part(int n) { return any_plane == 0 ? vec2(0.0, 1e30) : uintBitsToFloat(lists[list_at(n)]); }

// Forgets parts that end before `from`, which must not fall from one call to the next.
void pass_lit(float from) {
  for (; lit_at < lit_end; ++lit_at) {
    if (lit_part(lit_at).y > from) break;
  }
}
