#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/medium.glsl"
#ifdef WITH_LIT
#include "gpu/lit_rays.glsl"
#endif

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 0, rgba32f) uniform image2DArray airlight_image;
layout(binding = 1, rgba32f) uniform image2DArray per_light_image;
layout(binding = 2, r32f) uniform image2DArray transmittance_image;
layout(binding = 3, r32f) uniform writeonly image2DArray optical_depth_image;

#include "gpu/no_airlight.glsl"

layout(std140, binding = 2) uniform Knobs {
  vec4 albedo_extinction;
  vec4 ambient_sky_distance;
  vec4 emission_g;
  int phase_kind;
  int steps;
};

// One dispatch takes some of the steps, counted over the three stretches of a ray, some of the lights, or of one light some lit parts, and some of the parts that a light
// cuts a step into. Between dispatches the airlight image holds what is summed and the depth in front, the transmittance image that within Gaussians and grid.
uniform int first_step;
uniform int end_step;
uniform int first_light;
uniform int end_light;
uniform int last_light;  // 1: no lights and no parts come after these
uniform int first_part;
uniform int end_part;

#ifdef WITH_OPTICAL_DEPTH
const bool whole = true;  // it is wanted also behind where the ray ends
#else
const bool whole = false;
#endif

#ifdef WITH_LIT
bool is_first_of_light() { return first_lit == 0; }
#else
bool is_first_of_light() { return true; }
#endif
bool is_first() { return first_light == 0 && first_part == 0 && is_first_of_light(); }

// The ray on its way.
ivec2 pixel;
vec3 d;
float front = 0.0;   // optical depth so far
float within = 0.0;  // that of Gaussians and grid alone
float most;          // radiance that the whole ray can have, were it seen through nothing
vec3 sum = vec3(0.0);

bool ended() { return ray_ended(front, most, largest(sum)); }

#ifdef WITH_SOURCES
uniform int sources_at;
uniform vec3 source_first;
uniform vec3 source_scale;
#endif

// What is at a place of the ray.
struct Local {
  float extinction;
  vec3 scattering;
  vec3 emission;
};

Local local_at(vec3 p, bool all) {
  Local here = Local(albedo_extinction.w, albedo_extinction.xyz * albedo_extinction.w, emission_g.xyz);
  if (!all) return here;
#ifdef WITH_GAUSSIANS
  for (int g = 0; g < medium_counts.x; ++g) {
    float falloff = gaussian_falloff_at(g, p);
    float extinction = falloff * albedo_extinction_of(g).w;
    here.extinction += extinction;
    here.scattering += extinction * albedo_extinction_of(g).xyz;
    here.emission += falloff * emission_reach(g).xyz;
  }
#endif
#ifdef WITH_GRID
  float extinction = grid_extinction_at(p);
  here.extinction += extinction;
  here.scattering += extinction * grid_albedo.xyz;
#endif
#ifdef WITH_SOURCES
  vec3 at = (p - source_first) * source_scale;
  for (int c = 0; c < 3; ++c) {
    float uneven = max(here.scattering[c] - albedo_extinction[c] * albedo_extinction.w, 0.0);
    here.emission[c] = fma(uneven, source_in_volume(sources_at, c, at.x, at.y, at.z), here.emission[c]);
  }
#endif
  return here;
}

bool uneven;  // this stretch has Gaussians and grid
bool peaked;  // the phase function has a peak

// A part of a step, or all of it: of optical depth tau, behind `before_it`.
void add_part(int k, float from, float to, float before_it, float tau, Local here) {
  vec4 vector_radius = light_values[2 * k];
  vec4 power_directional = light_values[2 * k + 1];
  vec3 v = vector_radius.xyz;
  float at = (from + to) * 0.5;
  float weight = to - from;
  float beside = 0.0;
  float phase;
  float sampled = at;
  vec3 scattering = here.scattering;
  if (power_directional.w != 0.0) {
    phase = phase_value(phase_kind, emission_g.w, -dot3(v, d));
  } else {
    float foot;
    float h;
    beside_ray(vector_radius, d, foot, h);
    float before = from - foot;
    float after = to - foot;
    float ra = sqrt(fma(before, before, h * h));
    float rb = sqrt(fma(after, after, h * h));
    weight = step_angle(from, to, ra, rb, foot, h, 1.0 / h);
    float r;
    step_means(from, to, ra, rb, foot, h, weight, at, r);
    phase = step_phase(phase_kind, emission_g.w, before, after, ra, rb, h);
    beside = r * albedo_extinction.w;
    sampled = at;
    // As cpu/ray_march.cpp tells.
    if (uneven && near_light(from, to, ra, rb)) {
      sampled = place_at_distance(at, r, foot, h);
      scattering = local_at(d * at, true).scattering;
    }
  }
#if defined(WITH_GAUSSIANS) || defined(WITH_GRID)
  beside += depth_to(k, v, power_directional.w != 0.0, d * sampled);
#endif
  float share = (at - from) / max(to - from, 1e-30);
  float once = phase * weight * step_transmittance(before_it, tau, share, beside);
  vec3 light_of_step = scattering * once * power_directional.xyz;
  sum += light_of_step;
#ifdef WITH_PER_LIGHT
  ivec3 layer = ivec3(pixel, k);
  imageStore(per_light_image, layer, imageLoad(per_light_image, layer) + vec4(light_of_step, 0.0));
#endif
}

// Light number k, scattered in the step [from, to] or in a lit part of one, as cpu/ray_march.cpp tells.
void add_light(int k, float from, float to, float before_it, Local here) {
  float parts = 1.0;
  float s;
  float c;
  float sine;
  float cosine;
  float foot;
  float h;
  if ((uneven || peaked) && light_values[2 * k + 1].w == 0.0) {
    beside_ray(light_values[2 * k], d, foot, h);
    float before = from - foot;
    float after = to - foot;
    float ra2 = fma(before, before, h * h);
    float rb2 = fma(after, after, h * h);
    if (may_have_parts(to - from, min(ra2, rb2))) {
      float over_ra = 1.0 / sqrt(ra2);
      float over_rb = 1.0 / sqrt(rb2);
      s = before * over_ra;
      c = h * over_ra;
      parts = step_parts(s, c, after * over_rb, h * over_rb, sine, cosine);
    }
  }
  float begin = from;
  for (int part = 0; part < int(parts) && part < end_part; ++part) {
    float end = to;
    Local there = here;
    if (parts > 1.0) {
      if (float(part + 1) < parts) end = end_of_part(sine, cosine, s, c, begin, to, foot, h, s, c);
      there = local_at(d * ((begin + end) * 0.5), uneven);
    }
    float tau = there.extinction * (end - begin);
    if (part >= first_part) add_part(k, begin, end, before_it, tau, there);
    before_it += tau;
    begin = end;
  }
}

void add_lights(float from, float to, Local here) {
#ifdef WITH_LIT
  pass_lit(from);
  for (int n = lit_at; n < lit_end; ++n) {
    vec2 lit = lit_part(n);
    if (lit.x >= to) break;
    float begin_lit = max(lit.x, from);
    float end_of_lit = min(lit.y, to);
    if (begin_lit < end_of_lit)
      add_light(first_light, begin_lit, end_of_lit, fma(here.extinction, begin_lit - from, front), here);
  }
#else
  for (int k = first_light; k < end_light; ++k) add_light(k, from, to, front, here);
#endif
}

// From `begin` to `end`, the steps from number `base` on, which grow as cpu/ray_march.cpp tells; all: with Gaussians and grid. Nothing
// where end <= begin.
void stretch(int base, float begin, float end, bool all) {
  bool marching = !ended() && begin < end;
  if (!marching) return;
  float extinction = albedo_extinction.w;
  if (!all && extinction <= 0.0) {  // nothing there but a glow
    if (is_first() && first_step <= base && base < end_step) sum += (end - begin) * transmittance(front) * emission_g.xyz;
    return;
  }
  float length = all ? end - begin : min(end - begin, deepest() / max(extinction, 1e-30));
  float n = float(steps);
  int first = max(first_step - base, 0);
  int last = min(end_step - base, steps);
  float before = float(first);
  float steep = local_at(d * begin, all).extinction;
  uneven = all;
  float from = begin + graded_step(before, n, length, steep);
  for (int k = first; k < last; ++k) {
    bool going = !ended();
    if (!going && !(whole && all)) break;
    float next = float(k + 1);
    float to = begin + graded_step(next, n, length, steep);
    float size = max(to - from, 0.0);
    Local here = local_at(d * ((from + to) * 0.5), all);
    float tau = here.extinction * size;
    if (going) {
      if (here.extinction > 0.0) add_lights(from, to, here);
      if (is_first()) sum += size * mean_transmittance(tau) * transmittance(front) * here.emission;
    }
    front += tau;
    if (all) within += max(here.extinction - extinction, 0.0) * size;
    from = to;
  }
}

void main() {
#ifdef WITH_LIT
  pixel = this_lit_pixel();
  if (outside(pixel) || outside_run(in_run())) return;
  begin_lit();
#else
  pixel = this_pixel();
  if (outside(pixel)) return;
#endif
  ivec3 at = ivec3(pixel, 0);
  float length = ray_length(texelFetch(distance_image, at, 0).x, ambient_sky_distance.w);
  if (store_no_airlight(at, length, first_light, end_light)) return;
  float end = min(length, 1e15);
  peaked = phase_kind > 1;
  d = pixel_ray(pixel);
  most = radiance_bound(phase_kind, emission_g, albedo_extinction.w, d);
#ifdef WITH_SOURCES
  most += element(sources_at, 3);
#endif
  if (first_step > 0 || !is_first()) sum = imageLoad(airlight_image, at).xyz;
  if (first_step > 0) {
    front = imageLoad(airlight_image, at).w;
    within = imageLoad(transmittance_image, at).x;
  }
#ifdef WITH_PER_LIGHT
  if (first_step == 0 && first_part == 0 && is_first_of_light()) {
    for (int k = first_light; k < end_light; ++k) imageStore(per_light_image, ivec3(pixel, k), vec4(0.0));
  }
#endif
  float behind = 0.0;  // of Gaussians and grid
#if defined(WITH_GAUSSIANS) || defined(WITH_GRID)
  vec2 inside = vec2(1e30, -1e30);
#ifdef WITH_GAUSSIANS
  inside = gaussian_stretch(vec3(0.0), d, end);
#endif
#ifdef WITH_GRID
  vec2 box = grid_stretch(vec3(0.0), d, end);
  if (box.x < box.y) inside = vec2(min(inside.x, box.x), max(inside.y, box.y));
#endif
  if (inside.x < inside.y) {
    stretch(0, 0.0, inside.x, false);
    stretch(steps, inside.x, inside.y, true);
    behind = inside.y;
  }
#endif
  stretch(2 * steps, behind, end, false);
  if (end_step < 3 * steps || last_light == 0) {
    imageStore(airlight_image, at, vec4(sum, front));
    imageStore(transmittance_image, at, vec4(within));
    return;
  }

  float tau = optical_depth(length, albedo_extinction.w) + within;
  imageStore(airlight_image, at, vec4(fma(vec3(opacity(tau)), ambient_sky_distance.xyz, sum), 0.0));
  imageStore(transmittance_image, at, vec4(ended() ? 0.0 : transmittance(tau)));
#ifdef WITH_OPTICAL_DEPTH
  imageStore(optical_depth_image, at, vec4(min(tau, 1e30)));
#endif
}
