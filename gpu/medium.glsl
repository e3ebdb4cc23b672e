// Gaussians and grid: the extinction at a place and along a way. After gpu/dialect.glsl and gpu/screen.glsl.

layout(std140, binding = 3) uniform MediumBlock {
  ivec4 medium_counts;  // Gaussians, steps to a light, where the bricks begin
  vec4 grid_cells[3];
  vec4 grid_size;  // and the unit of halves, 0 without
  vec4 grid_albedo;
#ifndef MANY_GAUSSIANS
  vec4 gaussian_values[384];
#endif
};
#ifdef MANY_GAUSSIANS
layout(std430, binding = 5) readonly buffer GaussianBuffer { vec4 gaussian_values[]; };
#endif

// Three vectors a Gaussian: centre and radius; albedo and extinction; emission and reach.
vec4 center_radius(int g) { return gaussian_values[3 * g]; }
vec4 albedo_extinction_of(int g) { return gaussian_values[3 * g + 1]; }
vec4 emission_reach(int g) { return gaussian_values[3 * g + 2]; }

// Extinction and emission beside those at the centre; 0 beyond its reach.
float gaussian_falloff_at(int g, vec3 p) {
  vec3 e = center_radius(g).xyz - p;
  float squared = dot3(e, e);
  float reach = emission_reach(g).w;
  if (squared >= reach * reach) return 0.0;
  return gaussian_falloff(1.0 / center_radius(g).w, squared);
}

float grid_coordinate_of(int axis, vec3 p) {
  vec4 row = grid_cells[axis];
  return fma(row.x, p.x, fma(row.y, p.y, fma(row.z, p.z, row.w)));
}

float grid_extinction_at(vec3 p) {
  float x = grid_coordinate_of(0, p);
  float y = grid_coordinate_of(1, p);
  float z = grid_coordinate_of(2, p);
  if (grid_bound(medium_counts.z, x, y, z, grid_size.x, grid_size.y, grid_size.z) <= 0.0) return 0.0;
  if (grid_size.w > 0.0) return grid_size.w * grid_extinction(0, 1, x, y, z);
  return grid_extinction(0, 0, x, y, z);
}

// Stretches are [begin, end] along a way, empty where end <= begin.
vec2 grid_stretch(vec3 from, vec3 direction, float length) {
  vec2 s = vec2(0.0, length);
  for (int axis = 0; axis < 3; ++axis) {
    vec4 row = grid_cells[axis];
    float start = grid_coordinate_of(axis, from);
    float slope = fma(row.x, direction.x, fma(row.y, direction.y, row.z * direction.z));
    float rate = abs(slope) > 1e-18 ? slope : 1e-18;
    float a = (-1.0 - start) / rate;
    float b = (grid_size[axis] - start) / rate;
    s = vec2(max(s.x, min(a, b)), min(s.y, max(a, b)));
  }
  return s;
}

vec2 gaussian_stretch(vec3 from, vec3 direction, float length) {
  vec2 all = vec2(1e30, -1e30);
  for (int g = 0; g < medium_counts.x; ++g) {
    vec3 e = center_radius(g).xyz - from;
    float reach = emission_reach(g).w;
    float foot;
    float h;
    perpendicular(direction.x, direction.y, direction.z, e.x, e.y, e.z, 0.0, foot, h);
    float chord = sqrt(max((reach - h) * (reach + h), 0.0));
    float begin = max(foot - chord, 0.0);
    float end = min(foot + chord, length);
    if (h < reach && begin < end) all = vec2(min(all.x, begin), max(all.y, end));
  }
  return all;
}

float gaussian_extinction_at(vec3 p) {
  float extinction = 0.0;
  for (int g = 0; g < medium_counts.x; ++g) extinction = fma(gaussian_falloff_at(g, p), albedo_extinction_of(g).w, extinction);
  return extinction;
}

// Optical depth of a stretch of a way through the grid or the Gaussians, by the midpoints of n steps.
float marched_depth(bool of_grid, vec2 s, vec3 from, vec3 direction, int n) {
  if (s.x >= s.y) return 0.0;
  float size = (s.y - s.x) * (1.0 / float(n));
  float extinction = 0.0;
  for (int k = 0; k < n; ++k) {
    vec3 p = fma(direction, vec3(fma(size, float(k) + 0.5, s.x)), from);
    extinction += of_grid ? grid_extinction_at(p) : gaussian_extinction_at(p);
  }
  return extinction * size;
}

// Optical depth of a way through Gaussians and grid.
float depth_of_way(vec3 from, vec3 direction, float length) {
  float sum = 0.0;
  int n = medium_counts.y;
#ifdef WITH_GAUSSIANS
#ifdef ANALYTIC_LIGHT_DEPTH
  for (int g = 0; g < medium_counts.x; ++g) {
    vec3 e = center_radius(g).xyz - from;
    float reach = emission_reach(g).w;
    float foot;
    float h;
    perpendicular(direction.x, direction.y, direction.z, e.x, e.y, e.z, 0.0, foot, h);
    if (h >= reach || foot <= -reach || foot - length >= reach) continue;
    float radius = center_radius(g).w;
    float whole = gaussian_whole(albedo_extinction_of(g).w, radius);
    sum += gaussian_depth(GAUSSIAN_ERF, 1.0 / radius, h, -foot, length - foot) * whole;
  }
#else
  sum += marched_depth(false, gaussian_stretch(from, direction, length), from, direction, n);
#endif
#endif
#ifdef WITH_GRID
  sum += marched_depth(true, grid_stretch(from, direction, length), from, direction, n);
#endif
  return sum;
}

#ifdef WITH_DEPTH_VOLUMES
uniform int depth_volumes_at;

// A light's head: the rows of its DepthVolume, its kind, where its table begins, whether it has halves.
float depth_to_light(int k, vec3 p) {
  int head = depth_volumes_at + 16 * k;
  vec3 q;
  for (int axis = 0; axis < 3; ++axis) {
    int row = head + 4 * axis;
    q[axis] = fma(table_values[row], p.x, fma(table_values[row + 1], p.y, fma(table_values[row + 2], p.z, table_values[row + 3])));
  }
  return depth_in_volume(floatBitsToInt(table_values[head + 13]), floatBitsToInt(table_values[head + 12]), floatBitsToInt(table_values[head + 14]), q.x, q.y, q.z);
}
#endif

// Optical depth of Gaussians and grid from p to light number k.
float depth_to(int k, vec3 light, bool directional, vec3 p) {
#ifdef WITH_DEPTH_VOLUMES
  return depth_to_light(k, p);
#else
  float length;
  vec3 way = toward_light(light, directional, p, length);
  return depth_of_way(p, way, length);
#endif
}

float largest(vec3 v) { return max(max(v.x, v.y), v.z); }

#if defined(MOST_LIGHTS) || defined(MANY_LIGHTS)
// What a ray through Gaussians and a homogeneous part can have at most, were it seen through nothing. emission_g: the homogeneous part's, and the phase
// function's g.
float radiance_bound(int phase_kind, vec4 emission_g, float extinction, vec3 d) {
  float phase_most = max(phase_value(phase_kind, emission_g.w, 1.0), phase_value(phase_kind, emission_g.w, -1.0));
  float most = largest(emission_g.xyz) > 0.0 ? largest(emission_g.xyz) / max(extinction, 1e-30) : 0.0;
#ifdef WITH_GAUSSIANS
  for (int g = 0; g < medium_counts.x; ++g) most += largest(emission_reach(g).xyz) / albedo_extinction_of(g).w;
#endif
  most = min(most, 1e30);
  for (int k = 0; k < light_count.x; ++k) {
    vec4 v = light_values[2 * k];
    float foot;
    float h = 1.0;
    if (light_values[2 * k + 1].w == 0.0) beside_ray(v, d, foot, h);
    most += largest(light_values[2 * k + 1].xyz) * phase_most / (h * h);
  }
  return most;
}
#endif
