// Four programs: GRID, an invocation a ray of the light's; GAUSSIANS and SHARPEN, one a node, after it; CELLS, one a row of cells, for each distance
// from the light's cell.
#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/medium.glsl"

layout(std430, binding = 0) buffer DepthBuffer { float depths[]; };  // laid out as common/formulas/depth_volume.h tells

layout(std140, binding = 2) uniform Knobs {
  vec4 rows[3];
  vec4 first_kind;
  vec4 scale_samples;
  vec4 nodes_scheme;
  vec4 light_directional;
};

uniform int first_item;

int item() { return first_item + int(gl_WorkGroupID.x) * 64 + int(gl_LocalInvocationIndex); }
ivec3 nodes() { return ivec3(nodes_scheme.xyz); }

#if defined(GRID) || defined(GAUSSIANS)
float plane_distance(int k) {
  return first_kind.w == 3.0 ? cube_plane_distance(float(k)) * (1.0 / scale_samples.z) : fma(float(k), 1.0 / scale_samples.z, first_kind.z);
}

// The light's ray through a node, as in cpu/optical_depth_propagation.cpp: from + t d, planes `rate` z apart.
void light_ray(int face, int i, int j, out vec3 from, out vec3 d, out float rate) {
  float u = fma(float(i), 1.0 / scale_samples.x, first_kind.x);
  float w = fma(float(j), 1.0 / scale_samples.y, first_kind.y);
  int kind = int(first_kind.w);
  vec3 q = vec3(u, w, 1.0);
  if (kind == 1) {
    q = vec3(u - rows[0].w, w - rows[1].w, -rows[2].w);
    rate = 1.0;
  } else {
    if (kind == 3) {
      int axis = face / 2;
      q[axis] = face % 2 == 0 ? 1.0 : -1.0;
      q[(axis + 1) % 3] = u;
      q[(axis + 2) % 3] = w;
    }
    rate = sqrt(fma(u, u, fma(w, w, 1.0)));
    q *= 1.0 / rate;
  }
  vec3 turned = fma(vec3(q.x), rows[0].xyz, fma(vec3(q.y), rows[1].xyz, q.z * rows[2].xyz));
  from = kind == 1 ? turned : light_directional.xyz;
  d = kind == 1 ? rows[2].xyz : turned;
}
#endif

#ifdef GRID
void main() {
  ivec3 n = nodes();
  int faces = first_kind.w == 3.0 ? 6 : 1;
  int at = item();
  if (at >= n.x * n.y * faces) return;
  if (at == 0) {
    for (int axis = 0; axis < 3; ++axis) {
      depths[axis] = first_kind[axis];
      depths[3 + axis] = scale_samples[axis];
      depths[6 + axis] = nodes_scheme[axis];
    }
  }
  int i = at % n.x;
  int j = at / n.x % n.y;
  int face = at / n.x / n.y;
  vec3 from;
  vec3 d;
  float rate;
  light_ray(face, i, j, from, d, rate);
  int samples = int(scale_samples.w);
  float part = 1.0 / float(samples);
  float sum = 0.0;
#ifdef WITH_GRID
  vec2 inside = grid_stretch(from, d, 1e15);
#endif
  for (int k = 0; k < n.z; ++k) {
#ifdef WITH_GRID
    float met = 0.0;
    float start = k > 0 ? plane_distance(k - 1) * rate : 0.0;
    float size = plane_distance(k) * rate - start;
    bool meets = k > 0 && start + size > inside.x && start < inside.y;
    for (int m = 0; meets && m < samples; ++m) {
      float t = fma(size, (float(m) + 0.5) * part, start);
      met += grid_extinction_at(fma(d, vec3(t), from));
    }
    sum = fma(met, size * part, sum);
#endif
    depths[9 + i + n.x * (j + n.y * (k + n.z * face))] = sum;
  }
}
#endif

#ifdef GAUSSIANS
uniform int first_gaussian;  // of this dispatch
uniform int end_gaussian;

void main() {
  ivec3 n = nodes();
  int faces = first_kind.w == 3.0 ? 6 : 1;
  int at = item();
  if (at >= n.x * n.y * n.z * faces) return;
  int k = at / n.x / n.y % n.z;
  vec3 from;
  vec3 d;
  float rate;
  light_ray(at / n.x / n.y / n.z, at % n.x, at / n.x % n.y, from, d, rate);
  float t = plane_distance(k) * rate;
  float sum = 0.0;
  for (int g = first_gaussian; g < end_gaussian; ++g) {
    vec3 e = center_radius(g).xyz - from;
    float reach = emission_reach(g).w;
    float foot;
    float h;
    perpendicular(d.x, d.y, d.z, e.x, e.y, e.z, 0.0, foot, h);
    if (h >= reach || foot + reach <= 0.0 || t <= foot - reach) continue;
    float radius = center_radius(g).w;
    float inverse = 1.0 / radius;
    float lateral = gaussian_lateral(inverse, h) * gaussian_whole(albedo_extinction_of(g).w, radius);
    sum += gaussian_between(lateral, erf_(-foot * inverse), erf_(min(t - foot, reach) * inverse));
  }
  depths[9 + at] += sum;
}
#endif

#ifdef SHARPEN
layout(std430, binding = 1) buffer SharpenedBuffer { float sharpened[]; };  // in the same layout

uniform int axis;

// As the volume holds it: of a cube the first pass divides by the distance in cells.
float held(int at, int k, int layer) {
  if (axis != 2 || first_kind.w != 3.0) return depths[9 + at];
  if (k > 0) return depths[9 + at] / cube_plane_distance(float(k));
  float first = depths[9 + at + layer] / cube_plane_distance(1.0);
  return depth_at_light(first, nodes().z > 2 ? depths[9 + at + 2 * layer] / cube_plane_distance(2.0) : first);
}

void main() {
  ivec3 n = nodes();
  int faces = first_kind.w == 3.0 ? 6 : 1;
  int at = item();
  if (at >= n.x * n.y * n.z * faces) return;
  if (at < 9) sharpened[at] = depths[at];
  int stride = axis == 0 ? 1 : axis == 1 ? n.x : n.x * n.y;
  int along = at / stride % n[axis];
  float here = held(at, along, stride);
  if (along > 0 && along < n[axis] - 1) here = sharpened_depth(held(at - stride, along - 1, stride), here, held(at + stride, along + 1, stride));
  sharpened[9 + at] = here;
}
#endif

#ifdef CELLS
uniform int level;  // how many cells away from the light's, an axis after the other
uniform int light_x;
uniform int light_y;
uniform int light_z;

int steps_from(int i, int light_at, int n) { return i >= light_at ? i - max(light_at, 0) : min(light_at, n) - i; }

float from_light(int axis, int i, float cell) {
  return light_directional.w != 0.0 ? light_directional[axis] : (float(i) + 0.5) * cell - light_directional[axis];
}

float depth_of(ivec3 p, ivec3 n) {
  if (any(lessThan(p, ivec3(0))) || any(greaterThanEqual(p, n))) return 0.0;
  return depths[9 + p.x + n.x * (p.y + n.y * p.z)];
}

// Toward the light along an axis.
ivec3 nearer(ivec3 p, int axis, int light_at) {
  p[axis] += p[axis] > light_at ? -1 : 1;
  return p;
}

void cell_depth(ivec3 p, ivec3 n) {
  float cell = 1.0 / rows[0].x;
  vec3 way = vec3(from_light(0, p.x, cell), from_light(1, p.y, cell), from_light(2, p.z, cell));
  float length = sqrt(fma(way.x, way.x, fma(way.y, way.y, way.z * way.z)));
  vec3 w = abs(way) * (1.0 / max(length, 1e-15));
  for (int axis = 0; axis < 3; ++axis) {
    if (light_directional.w == 0.0 && abs(way[axis]) <= slab_share() * cell) w[axis] = 0.0;
  }
  float others = fma(w.y, depth_of(nearer(p, 1, light_y), n), w.z * depth_of(nearer(p, 2, light_z), n));
  float weights = (w.x + w.y) + w.z;
  float extinction = table_values[3 + (p.x + 1) + (n.x + 2) * ((p.y + 1) + (n.y + 2) * (p.z + 1))];
  float depth = extinction * length;
  if (weights > 0.0)
    depth = fma(w.x / weights, depth_of(nearer(p, 0, light_x), n), depth_beside(int(nodes_scheme.w), extinction * cell, others, weights));
  depths[9 + p.x + n.x * (p.y + n.y * p.z)] = depth;
}

void main() {
  ivec3 n = nodes();
  int at = item();
  if (at >= n.y * n.z) return;
  if (at == 0 && level == 0) {
    for (int axis = 0; axis < 3; ++axis) {
      depths[axis] = first_kind[axis];
      depths[3 + axis] = scale_samples[axis];
      depths[6 + axis] = nodes_scheme[axis];
    }
  }
  int j = at % n.y;
  int k = at / n.y;
  int away = level - steps_from(j, light_y, n.y) - steps_from(k, light_z, n.z);
  if (away < 0) return;
  int behind = max(light_x, 0) + away;
  if (behind < n.x && light_x < n.x) cell_depth(ivec3(behind, j, k), n);
  int before = min(light_x, n.x) - away;
  if (away > 0 && before >= 0) cell_depth(ivec3(before, j, k), n);
}
#endif
