// Five programs. Lists are sorted by counting: COUNT, the particles of each pixel; BEGIN, a line's lists one behind another; FILL,
// each list in any order; RANK, its particles in order; LINKS, what is between them. An invocation of the others is a line and a
// particle, or a place in its lists.
#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/medium.glsl"
#include "gpu/network.glsl"

layout(std430, binding = 0) buffer LinkBuffer { float links[]; };
layout(std430, binding = 3) buffer Scratch { int scratch[]; };

const int sum_unit = lattice_length / 8;  // as cpu/visibility_network.cpp's

// Of a pixel: how many particles; how many have been put in its list; where in it they are, summed up, across and down. Of a particle: its pixel and where along the line it is. Of
// a place in the lists: a particle of that list; its pixel.
int count_at(int line, int c) { return line * slots + c; }
int given_at(int line, int c) { return (line_count + line) * slots + c; }
int within_at(int which, int line, int c) { return ((2 + which) * line_count + line) * slots + c; }
int pair_at(int which, int line, int k) { return 4 * line_count * slots + (which * line_count + line) * particle_count + k; }

int dot_of(ivec3 a, ivec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

bool is_before(int line, int a, int b) {
  int za = scratch[pair_at(1, line, a)];
  int zb = scratch[pair_at(1, line, b)];
  return za < zb || (za == zb && a < b);
}

void set_link(int line, int record, float depth, float other) {
  float lost;
  float given;
  float kept;
  link_shares(depth, depth + other, lost, given, kept);
  links[record_at(line, 1) + record] = depth;
  links[record_at(line, 2) + record] = lost;
  links[record_at(line, 3) + record] = given;
  links[record_at(line, 4) + record] = kept;
}

float along_at(int line, int record) {
  int v = int(links[record_at(line, 0) + record]);
  return float(scratch[pair_at(1, line, v)]) * (unit / float(lattice_length));
}

vec3 axis_of(int line, int k) { return vec3(line_axis(line, k)) * (1.0 / float(lattice_length)); }

// Optical depth of pixel c's line between two places; `open_before`, `open_after`: without that end.
float depth_between(int line, int c, bool open_before, float before, bool open_after, float after) {
  vec3 across = axis_of(line, 3);
  vec3 down = axis_of(line, 6);
  vec3 way = axis_of(line, 0);
  int columns = pixels_of(line, 0);
  ivec2 number = ivec2(c % columns, c / columns);
  vec2 at;
  for (int k = 0; k < 2; ++k) {
    float within = (float(scratch[within_at(k, line, c)]) / float(scratch[count_at(line, c)]) + 0.5) * float(sum_unit);
    at[k] = (float(edge_of(line, first_edge(line, k) + number[k])) + within) * (unit / float(lattice_length));
  }
  float depth = 0.0;
#ifdef WITH_GAUSSIANS
  for (int g = 0; g < medium_counts.x; ++g) {
    vec4 c_r = center_radius(g);
    float x = dot(across, c_r.xyz) - at.x;
    float y = dot(down, c_r.xyz) - at.y;
    float h = sqrt(fma(x, x, y * y));
    if (h >= emission_reach(g).w) continue;
    float inverse = 1.0 / c_r.w;
    float lateral = gaussian_lateral(inverse, h) * gaussian_whole(albedo_extinction_of(g).w, c_r.w);
    float z = dot(way, c_r.xyz);
    float from = open_before ? -1.0 : erf_((before - z) * inverse);
    float to = open_after ? 1.0 : erf_((after - z) * inverse);
    depth += gaussian_between(lateral, from, to);
  }
#endif
#ifdef WITH_GRID
  vec3 start = across * at.x + down * at.y;
  float far = 2.0 * unit * float(lattice_length);
  vec2 inside = grid_stretch(start - way * far, way, 2.0 * far);
  float begin = inside.x - far;
  float from = open_before ? begin : before;
  float to = open_after ? max(inside.y - far, begin) : after;
  float length = max(to - from, 0.0);
  float met = 0.0;
  for (int i = 0; i < samples; ++i) {
    float t = fma(length, (float(i) + 0.5) / float(samples), from);
    met += grid_extinction_at(fma(way, vec3(t), start));
  }
  depth = fma(met / float(samples), length, depth);
#endif
  return depth;
}

void main() {
  int n = item();
#ifdef BEGIN
  if (n >= line_count) return;
  int first = 0;
  for (int c = 0; c < slots; ++c) {
    int count = scratch[count_at(n, c)];
    links[begin_at(n, c)] = float(first);
    links[record_at(n, 0) + first + count + c] = -1.0;
    if (count == 0) {
      for (int plane = 1; plane < link_planes; ++plane) links[record_at(n, plane) + first + c] = 0.0;
    }
    first += count;
  }
  links[begin_at(n, slots)] = float(first);
#else
  if (n >= line_count * particle_count) return;
  int line = n / particle_count;
  int k = n % particle_count;
#endif
#ifdef COUNT
  ivec3 p = ivec3(particle_rgb(0, k));
  int across = dot_of(line_axis(line, 3), p);
  int down = dot_of(line_axis(line, 6), p);
  int column = pixel_of(line, 0, across);
  int row = pixel_of(line, 1, down);
  int c = column + pixels_of(line, 0) * row;
  scratch[pair_at(0, line, k)] = c;
  scratch[pair_at(1, line, k)] = dot_of(line_axis(line, 0), p);
  atomicAdd(scratch[count_at(line, c)], 1);
  atomicAdd(scratch[within_at(0, line, c)], (across - edge_of(line, column)) / sum_unit);
  atomicAdd(scratch[within_at(1, line, c)], (down - edge_of(line, first_edge(line, 1) + row)) / sum_unit);
#endif
#ifdef FILL
  int c = scratch[pair_at(0, line, k)];
  int place = int(links[begin_at(line, c)]) + atomicAdd(scratch[given_at(line, c)], 1);
  scratch[pair_at(2, line, place)] = k;
  scratch[pair_at(3, line, place)] = c;
#endif
#ifdef RANK
  int c = scratch[pair_at(0, line, k)];
  int first = int(links[begin_at(line, c)]);
  int last = int(links[begin_at(line, c + 1)]);
  int rank = 0;
  for (int place = first; place < last; ++place) rank += is_before(line, scratch[pair_at(2, line, place)], k) ? 1 : 0;
  links[record_at(line, 0) + first + c + rank] = float(k);
#endif
#ifdef LINKS
  int c = scratch[pair_at(3, line, k)];
  bool is_first = k == int(links[begin_at(line, c)]);
  bool is_last = k + 1 == int(links[begin_at(line, c + 1)]);
  float here = along_at(line, k + c);
  float before = is_first ? here : along_at(line, k + c - 1);
  set_link(line, k + c, depth_between(line, c, is_first, before, false, here), max(here - before, 0.0) * network_extinction);
  if (is_last) set_link(line, k + c + 1, depth_between(line, c, false, here, true, here), 0.0);
#endif
}
