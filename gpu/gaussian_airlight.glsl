#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/medium.glsl"
#ifdef WITH_LIT
#include "gpu/lit_rays.glsl"
#endif

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 0, rgba32f) uniform image2DArray airlight_image;
layout(binding = 1, rgba32f) uniform image2DArray per_light_image;
layout(binding = 2, r32f) uniform writeonly image2DArray transmittance_image;
layout(binding = 3, r32f) uniform writeonly image2DArray optical_depth_image;

layout(std140, binding = 2) uniform Knobs {
  vec4 albedo_extinction;
  vec4 ambient_sky_distance;
  vec4 emission_g;
  int phase_kind;
  int square_side;
  int square_columns;
  int first_square_row;
  vec4 rules[136];   // node, weight: that of one node, that of two, and so on
  vec4 before[374];  // theirs, four in a vector (GaussLegendre::before)
};

#include "gpu/no_airlight.glsl"

// The panels of all squares (common/plan/gaussian_panels.h): where a square's parts begin and end, then where its Gaussians do; behind all of them the
// parts, what a dispatch does for a square: panels, and which pieces of each; a panel's begin, end, lists and how many nodes it has; of each light's list there the ends,
// the levels, and whether anything may shade it; Gaussians.
layout(std430, binding = 0) readonly buffer SquareBlock { ivec4 squares[]; };
layout(std430, binding = 1) readonly buffer PanelBlock { ivec4 panels[]; };
layout(std430, binding = 2) readonly buffer ShadeBlock { ivec4 shades[]; };
layout(std430, binding = 4) readonly buffer IndexBlock { int indices[]; };

// Between dispatches the airlight image holds what is summed, and the optical depth of the Gaussians that are behind. With lit parts the rays are
// taken once for each light, and for as many of its parts as fit; without, once for the lights whose volumes fit.
uniform int part;
uniform int last_part;

#ifdef WITH_LIT
int first_light() { return light; }
int end_light() { return light + 1; }
bool glows() { return light == 0 && first_lit == 0; }  // once is enough
bool is_first_of_light() { return part == 0 && first_lit == 0; }
#else
uniform int pass_first_light;
uniform int pass_end_light;
int first_light() { return pass_first_light; }
int end_light() { return pass_end_light; }
bool glows() { return pass_first_light == 0; }
bool is_first_of_light() { return part == 0; }
#endif

ivec2 pixel;
vec3 d;
float end;
float front = 0.0;
float most;
vec3 sum = vec3(0.0);

#include "gpu/bent_rays.glsl"

// Optical depth of a Gaussian up to t.
float depth_to(int g, float t) {
  vec3 c = center_radius(g).xyz;
  float radius = center_radius(g).w;
  float foot;
  float h;
  vec3 way = way_across(c, radius);
  perpendicular(way.x, way.y, way.z, c.x, c.y, c.z, 0.0, foot, h);
  if (h >= emission_reach(g).w) return 0.0;
  return gaussian_depth(GAUSSIAN_ERF, 1.0 / radius, h, -foot, t - foot) * gaussian_whole(albedo_extinction_of(g).w, radius);
}

struct Local {
  float extinction;
  vec3 scattering;
  vec3 emission;
  float depth;
};

int samples;  // of this panel

Local local_at(ivec2 meets, float t) {
  Local here = Local(albedo_extinction.w, albedo_extinction.xyz * albedo_extinction.w, emission_g.xyz, front);
  for (int n = meets.x; n < meets.y; ++n) {
    int g = indices[n];
    vec3 c = center_radius(g).xyz;
    float radius = center_radius(g).w;
    float inverse = 1.0 / radius;
    float foot;
    float h;
    vec3 way = way_across(c, radius);
    perpendicular(way.x, way.y, way.z, c.x, c.y, c.z, 0.0, foot, h);
    if (h >= emission_reach(g).w) continue;
    float past = t - foot;
    float lateral = gaussian_lateral(inverse, h);
#ifdef WITH_LIT
    float share = gaussian_between(lateral, gaussian_erf(GAUSSIAN_ERF, -foot * inverse), gaussian_erf(GAUSSIAN_ERF, past * inverse));
    here.depth = fma(share, gaussian_whole(albedo_extinction_of(g).w, radius), here.depth);
#endif
    float falloff = lateral * gaussian_falloff(inverse, past * past);
    float extinction = falloff * albedo_extinction_of(g).w;
    here.extinction += extinction;
    here.scattering += extinction * albedo_extinction_of(g).xyz;
    here.emission += falloff * emission_reach(g).xyz;
  }
  return here;
}

// Optical depth of Gaussians between a place and light k.
float shading(ivec4 shade, int k, vec3 vector, bool directional, vec3 place) {
#ifdef WITH_DEPTH_VOLUMES
  return shade.w == 0 ? 0.0 : depth_to_light(k, place);
#else
  float depth = 0.0;
  float length;
  vec3 way = toward_light(vector, directional, place, length);
  for (int n = shade.x; n < shade.y; ++n) {
    int index = indices[n];
    int g = index & ~int(AROUND_LIGHT);
    vec3 e = center_radius(g).xyz - place;
    float radius = center_radius(g).w;
    float foot;
    float h;
    perpendicular(way.x, way.y, way.z, e.x, e.y, e.z, 0.0, foot, h);
    if (h >= emission_reach(g).w) continue;
    bool whole_way = (index & int(AROUND_LIGHT)) == 0;  // the light stands beyond it
    float share = whole_way ? gaussian_depth_beyond(GAUSSIAN_ERF, 1.0 / radius, h, -foot)
                            : gaussian_depth(GAUSSIAN_ERF, 1.0 / radius, h, -foot, length - foot);
    depth = fma(share, gaussian_whole(albedo_extinction_of(g).w, radius), depth);
  }
  return depth;
#endif
}

void add(int k, vec3 scattered) {
  sum += scattered;
#ifdef WITH_PER_LIGHT
  ivec3 layer = ivec3(pixel, k);
  imageStore(per_light_image, layer, imageLoad(per_light_image, layer) + vec4(scattered, 0.0));
#endif
}

bool closed_form(ivec2 meets, ivec4 shade) { return meets.x == meets.y && shade.w == 0; }

// What a node sends: of the lights, and of what glows.
void take_node(ivec2 meets, int first_shade, float t, float weight, Local here, bool lights, bool glow) {
  for (int k = first_light(); k < end_light() && lights; ++k) {
    ivec4 shade = shades[first_shade + k];
    if (closed_form(meets, shade)) continue;
    vec4 vector_radius = light_values[2 * k];
    vec4 power_directional = light_values[2 * k + 1];
    bool directional = power_directional.w != 0.0;
    float more = here.depth + shading(shade, k, vector_radius.xyz, directional, d * t);
    float density;
    if (directional) {
      density = directional_density(phase_kind, emission_g.w, albedo_extinction.w, -dot3(vector_radius.xyz, d), t, more);
    } else {
      float foot;
      float h;
      beside_ray(vector_radius, d, foot, h);
      density = airlight_density(phase_kind, emission_g.w, albedo_extinction.w, foot, h, t, more);
    }
    add(k, here.scattering * (weight * density) * power_directional.xyz);
  }
  if (glow && meets.x < meets.y) sum += weight * transmittance(fma(t, albedo_extinction.w, here.depth)) * here.emission;
}

vec4 rule_of(int n) { return rules[samples * (samples - 1) / 2 + n]; }

#ifdef WITH_LIT
void take_samples(ivec2 meets, int first_shade, float from, float to, bool lights, bool glow) {
  float width = max(to - from, 0.0) * 0.5;
  float middle = (from + to) * 0.5;
  for (int n = 0; n < samples; ++n) {
    float t = fma(width, rule_of(n).x, middle);
    take_node(meets, first_shade, t, width * rule_of(n).y, local_at(meets, t), lights, glow);
  }
}
#else
// The depth comes from the nodes, too, as cpu/gaussian_airlight.cpp tells.
void take_samples(ivec2 meets, int first_shade, float from, float to) {
  float width = max(to - from, 0.0) * 0.5;
  float middle = (from + to) * 0.5;
  float uneven[16];
  vec3 scattering[16];
  vec3 emission[16];
  for (int n = 0; n < samples; ++n) {
    Local here = local_at(meets, fma(width, rule_of(n).x, middle));
    uneven[n] = (here.extinction - albedo_extinction.w) * width;
    scattering[n] = here.scattering;
    emission[n] = here.emission;
  }
  float whole = front;
  int row = (samples - 1) * samples * (2 * samples - 1) / 6;
  for (int n = 0; n < samples; ++n) {
    Local here = Local(0.0, scattering[n], emission[n], front);
    for (int k = 0; k < samples; ++k, ++row) here.depth = fma(uneven[k], before[row / 4][row % 4], here.depth);
    take_node(meets, first_shade, fma(width, rule_of(n).x, middle), width * rule_of(n).y, here, true, glows());
    whole = fma(uneven[n], rule_of(n).y, whole);
  }
  front = whole;
}
#endif

#ifdef WITH_TABLES
// Per unit of power and albedo, where only the homogeneous part is.
float closed_form_of(int k, float from, float to) {
  return airlight_of(light_values[2 * k], light_values[2 * k + 1].w != 0.0, d, phase_kind, emission_g.w, albedo_extinction.w, from, to);
}
#endif

// Where only the homogeneous part is.
void closed_forms(ivec2 meets, int first_shade, float from, float to) {
  float through = transmittance(front);
  float extinction = albedo_extinction.w;
#ifdef WITH_TABLES
  for (int k = first_light(); k < end_light(); ++k) {
    if (!closed_form(meets, shades[first_shade + k])) continue;
    float once = 0.0;
#ifdef WITH_LIT
    pass_lit(from);
    for (int n = lit_at; n < lit_end; ++n) {
      vec2 lit = lit_part(n);
      if (lit.x >= to) break;
      float begin_lit = max(lit.x, from);
      float end_of_lit = min(lit.y, to);
      if (begin_lit < end_of_lit) once += closed_form_of(k, begin_lit, end_of_lit);
    }
#else
    once = closed_form_of(k, from, to);
#endif
    add(k, once * through * (light_values[2 * k + 1].xyz * albedo_extinction.xyz));
  }
#endif
  if (!glows()) return;
  float length = to - from;
  sum += through * transmittance(from * extinction) * attenuated_length(length, extinction, optical_depth(length, extinction)) * emission_g.xyz;
}

float cut[MOST_CUTS];
int cut_count;

void add_cut(float t, float from, float to) { cut[cut_count++] = min(max(t, from), to); }

// Where a panel is cut, ascending, its ends among them.
void make_cuts(int first_shade, float panel_length, float from, float to) {
  cut_count = 0;
  add_cut(from, from, to);
  bool in_order = true;
  for (int k = 0; k < light_count.x; ++k) {
    int levels = shades[first_shade + k].z;
    if (levels == 0) continue;
    in_order = cut_count == 1;
    float foot;
    float h;
    beside_ray(light_values[2 * k], d, foot, h);
    float size = panel_length;
    for (int level = 0; level < levels; ++level) {
      size *= 1.0 / CUT_RATIO;
      add_cut(foot - size, from, to);
    }
    add_cut(foot, from, to);
    for (int level = 0; level < levels; ++level) {
      add_cut(foot + size, from, to);
      size *= CUT_RATIO;
    }
  }
  add_cut(to, from, to);
  for (int i = 1; i < cut_count && !in_order; ++i) {
    float one = cut[i];
    int hole = i;
    for (; hole > 0 && cut[hole - 1] > one; --hole) cut[hole] = cut[hole - 1];
    cut[hole] = one;
  }
}

#ifdef WITH_LIT
// Each lit part of it has nodes of its own.
void take_piece(ivec2 meets, int first_shade, float from, float to) {
  if (glows()) take_samples(meets, first_shade, from, to, false, true);
  if (closed_form(meets, shades[first_shade + light])) return;
  pass_lit(from);
  for (int n = lit_at; n < lit_end; ++n) {
    vec2 lit = lit_part(n);
    if (lit.x >= to) break;
    float begin_lit = max(lit.x, from);
    float end_of_lit = min(lit.y, to);
    if (begin_lit < end_of_lit) take_samples(meets, first_shade, begin_lit, end_of_lit, true, false);
  }
}
#else
void take_piece(ivec2 meets, int first_shade, float from, float to) { take_samples(meets, first_shade, from, to); }
#endif

// Pieces first to last of a panel.
void take_panel(int p, int first, int last) {
  ivec4 one = panels[2 * p];
  ivec4 two = panels[2 * p + 1];
  float from = intBitsToFloat(one.x);
  float panel_end = intBitsToFloat(one.y);
  ivec2 meets = one.zw;
  ivec2 passed = two.xy;
  int first_shade = two.z;
  samples = two.w;
#ifdef WITH_LIT
  if (first == 0) {
    for (int n = passed.x; n < passed.y; ++n) front += depth_to(indices[n], 1e15);
  }
#endif
  float to = min(panel_end, end);
  if (!(from < to) || ray_ended(fma(from, albedo_extinction.w, front), most, largest(sum))) return;
  bool empty = meets.x == meets.y;
  if (empty && first == 0) closed_forms(meets, first_shade, from, to);
  if (samples == 0) return;
  make_cuts(first_shade, panel_end - from, from, to);
  for (int k = first; k + 1 < cut_count && k < last; ++k) {
    if (cut[k] < cut[k + 1]) take_piece(meets, first_shade, cut[k], cut[k + 1]);
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
  if (store_no_airlight(at, length, first_light(), end_light())) return;
  end = min(length, 1e15);
  d = pixel_ray(pixel);
  ivec4 square = squares[pixel.x / square_side + square_columns * (in_image(pixel).y / square_side - first_square_row)];
  if (part > 0 || !glows()) {
    vec4 held = imageLoad(airlight_image, at);
    sum = held.xyz;
    if (part > 0) front = held.w;
  }
#ifdef WITH_PER_LIGHT
  if (is_first_of_light()) {
    for (int k = first_light(); k < end_light(); ++k) imageStore(per_light_image, ivec3(pixel, k), vec4(0.0));
  }
#endif
  if (square.x + part < square.y) {
    most = radiance_bound(phase_kind, emission_g, albedo_extinction.w, d);
    ivec4 mine = squares[square.x + part];
    for (int p = mine.x; p < mine.y; ++p) take_panel(p, mine.z, mine.w);
  }
  if (last_part == 0) {
    imageStore(airlight_image, at, vec4(sum, front));
    return;
  }
  float tau = optical_depth(length, albedo_extinction.w);
  for (int n = square.z; n < square.w; ++n) tau += depth_to(indices[n], end);
  imageStore(airlight_image, at, vec4(fma(vec3(opacity(tau)), ambient_sky_distance.xyz, sum), 0.0));
  imageStore(transmittance_image, at, vec4(transmittance(tau)));
#ifdef WITH_OPTICAL_DEPTH
  imageStore(optical_depth_image, at, vec4(min(tau, 1e30)));
#endif
}
