#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/shadow_lists.glsl"

layout(binding = 0, r32f) uniform writeonly image2DArray scattered_image;
layout(binding = 1, r32f) uniform writeonly image2DArray light_transmittance_image;

layout(std140, binding = 2) uniform Knobs {
  float extinction;
  float phase_g;
  int phase_kind;
};

// The light beside the ray.
bool directional;
float mu;    // directional light: cosine between its direction and the ray
float foot;  // point light: of the perpendicular on the ray, and its length [m]
float h;

float sum = 0.0;

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
bool take_crossings(int n) {
  int stencil = covering;
  for (int i = 0; i < n; ++i) stencil += int(lists[list_at(i)].y);
  bool lit = stencil <= 0;
  sum = lit ? airlight(0.0, reach) : 0.0;
#ifdef WITH_SCATTERED
  for (int i = 0; i < n; ++i) {
    uvec2 one = lists[list_at(i)];
    bool was_lit = stencil <= 0;
    stencil -= int(one.y);
    if (was_lit == (stencil <= 0)) continue;
    float once = airlight(0.0, min(slant / uintBitsToFloat(one.x), reach));
    sum += was_lit ? -once : once;
  }
#endif
  return lit;
}

#else

void take_lit_part(float from, float to) { sum += airlight(from, to); }
bool take_crossings(int n) { return take_lit_parts(n); }

#endif

void main() {
  ivec2 p = in_run() + corner_size.xy;
  if (outside(p) || outside_run(in_run())) return;
  int n = list_crossings(p);
  if (n > capacity) return;

  vec4 vector_radius = light_values[2 * light];
  vec3 v = vector_radius.xyz;
  directional = light_values[2 * light + 1].w != 0.0;
  mu = -dot3(v, d);
  foot = 0.0;
  h = 1.0;
  if (!directional) beside_ray(vector_radius, d, foot, h);
  bool lit = take_crossings(n);
#ifdef WITH_SCATTERED
  imageStore(scattered_image, ivec3(p, light), vec4(sum));
#endif
#ifdef WITH_LIGHT_TRANSMITTANCE
  imageStore(light_transmittance_image, ivec3(p, light), vec4(lit ? 1.0 : 0.0));
#endif
}
