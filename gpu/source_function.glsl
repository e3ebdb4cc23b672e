// Four programs. BEAMS: the radiance on each link of some lines, an invocation a list. NODES: what of it arrives at a node, added.
// MEANS: the mean over all lines; HEAD: the table's beginning, an invocation a float.
#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/network.glsl"

layout(std430, binding = 0) readonly buffer LinkBuffer { float links[]; };
layout(std430, binding = 3) readonly buffer SourceBuffer { vec4 particle_sources[]; };
layout(std430, binding = 5) buffer SumBuffer { vec4 sums[]; };  // rgb and weights of nodes, then where bricks are
layout(std430, binding = 6) buffer TableBuffer { float table_of_sources[]; };
#if defined(BEAMS) || defined(NODES)
layout(std430, binding = 4) buffer BeamBuffer { vec4 beams[]; };        // of each record: along the line, against it
layout(std430, binding = 7) readonly buffer SkyBuffer { vec4 sky[]; };  // of each direction
#else
layout(std430, binding = 4) readonly buffer HeadBuffer { float head[]; };
layout(std430, binding = 7) buffer MostBuffer { uint most; };
#endif

uniform vec3 first_node;
uniform vec3 nodes;   // of a brick
uniform vec3 bricks;
uniform int all_nodes;
uniform int head_size;
uniform int stride;
uniform int first_line;  // of this dispatch
uniform int end_line;

vec3 mean_of(int node) { return sums[node].xyz / sums[node].w; }
ivec3 brick_of(int brick) { return ivec3(sums[all_nodes + brick].xyz); }
int dot_of(ivec3 a, ivec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
int particle_of(int line, int record) { return int(links[record_at(line, 0) + record]); }
int beam_at(int line, int record, int way) { return 2 * ((line - first_line) * (particle_count + slots) + record) + way; }
int along_of(int line, int record) { return dot_of(line_axis(line, 0), ivec3(particle_rgb(0, particle_of(line, record)))); }

#if defined(BEAMS) || defined(NODES)
void sweep(int line, int at, int n, int way) {
  int source = phase_kind == 0 ? 0 : (2 * line + way) * particle_count;
  vec3 beam = sky[2 * line + way].xyz;
  for (int step = 0; step <= n; ++step) {
    int k = at + (way == 1 ? n - step : step);
    vec3 a = particle_sources[source + particle_of(line, k == at ? k : k - 1)].xyz;
    vec3 b = particle_sources[source + particle_of(line, k == at + n ? k - 1 : k)].xyz;
    beam += links[record_at(line, 3) + k] * 0.5 * (a + b) - links[record_at(line, 2) + k] * beam;
    beams[beam_at(line, k, way)] = vec4(beam, 0.0);
  }
}

// What arrives at a place along one bundle, each way with its weight.
vec3 arriving(int line, ivec3 place, float forward, float backward) {
  vec3 into = sky[2 * line].xyz;
  vec3 back = sky[2 * line + 1].xyz;
  ivec2 pixel;
  for (int k = 0; k < 2; ++k) {
    int across = dot_of(line_axis(line, 3 + 3 * k), place);
    int first = first_edge(line, k);
    if (across < edge_of(line, first) || across >= edge_of(line, first + pixels_of(line, k))) return forward * into + backward * back;
    pixel[k] = pixel_of(line, k, across);
  }
  int c = pixel.x + pixels_of(line, 0) * pixel.y;
  int first = int(links[begin_at(line, c)]);
  int n = int(links[begin_at(line, c + 1)]) - first;
  if (n == 0) return forward * into + backward * back;
  int at = first + c;
  int here = dot_of(line_axis(line, 0), place);
  int k = 0;  // how many particles lie before it
  int end = n;
  while (k < end) {
    int middle = (k + end) / 2;
    if (along_of(line, at + middle) <= here) {
      k = middle + 1;
    } else {
      end = middle;
    }
  }
  float width = float(edge_of(line, pixel.x + 1) - edge_of(line, pixel.x));
  if (k == 0) {
    float away = float(along_of(line, at) - here);
    float share = away / (away + width);
    return forward * share * into + forward * (1.0 - share) * beams[beam_at(line, at, 0)].xyz + backward * (1.0 - share) * beams[beam_at(line, at + 1, 1)].xyz +
           backward * share * beams[beam_at(line, at, 1)].xyz;
  }
  if (k == n) {
    float away = float(here - along_of(line, at + n - 1));
    float share = away / (away + width);
    return forward * (1.0 - share) * beams[beam_at(line, at + n - 1, 0)].xyz + forward * share * beams[beam_at(line, at + n, 0)].xyz +
           backward * (1.0 - share) * beams[beam_at(line, at + n, 1)].xyz + backward * share * back;
  }
  int before = along_of(line, at + k - 1);
  float share = float(here - before) / float(along_of(line, at + k) - before);
  return forward * mix(beams[beam_at(line, at + k - 1, 0)].xyz, beams[beam_at(line, at + k, 0)].xyz, share) +
         backward * mix(beams[beam_at(line, at + k, 1)].xyz, beams[beam_at(line, at + k + 1, 1)].xyz, share);
}
#endif

#ifdef MEANS
int node_at(int brick, ivec3 number) {
  ivec3 size = ivec3(nodes);
  return number.x + size.x * (number.y + size.y * (number.z + size.z * brick));
}
// The node beside one along an axis, in the next brick if need be. Itself where there is none.
int beside(int brick, ivec3 number, int axis, int way) {
  int here = node_at(brick, number);
  int last = int(nodes[axis]) - 1;
  if (number[axis] != (way > 0 ? last : 0)) {
    number[axis] += way;
    return node_at(brick, number);
  }
  ivec3 next = brick_of(brick);
  next[axis] += way;
  if (next[axis] < 0 || next[axis] >= int(bricks[axis])) return here;
  int found = int(head[8 + next.x + int(bricks.x) * (next.y + int(bricks.y) * next.z)]);
  if (found < 0) return here;
  number[axis] = way > 0 ? 1 : last - 1;
  return node_at(found, number);
}
#endif

void main() {
  int n = item();
  ivec3 size = ivec3(nodes);
  int of_brick = size.x * size.y * size.z;
  ivec3 number = ivec3(n % size.x, n / size.x % size.y, n / size.x / size.y % size.z);
#ifdef BEAMS
  int line = first_line + n / slots;
  int c = n % slots;
  if (line >= end_line) return;
  int first = int(links[begin_at(line, c)]);
  int count = int(links[begin_at(line, c + 1)]) - first;
  if (count == 0) return;
  sweep(line, first + c, count, 0);
  sweep(line, first + c, count, 1);
#endif
#ifdef NODES
  if (n >= all_nodes) return;
  ivec3 place = ivec3(first_node) + stride * (brick_of(n / of_brick) * (size - 1) + number);
  vec3 way = camera.xyz - vec3(place) * unit;
  way *= 1.0 / sqrt(max(dot3(way, way), 1e-30));
  vec4 sum = first_line == 0 ? vec4(0.0) : sums[n];
  for (int line = first_line; line < end_line; ++line) {
    float forward = 1.0;
    float backward = 1.0;
    if (phase_kind != 0) {
      float mu = dot3(network_direction(2 * line), way);
      forward = phase_value(phase_kind, phase_g, mu);
      backward = phase_value(phase_kind, phase_g, -mu);
    }
    sum += vec4(arriving(line, place, forward, backward), forward + backward);
  }
  sums[n] = sum;
#endif
#ifdef MEANS
  if (n >= all_nodes) return;
  int brick = n / of_brick;
  vec3 mean = mean_of(n);
  vec3 bent = vec3(0.0);  // second differences
  for (int axis = 0; axis < 3; ++axis) {
    int before = beside(brick, number, axis, -1);
    int after = beside(brick, number, axis, 1);
    if (before != n && after != n) bent += mean_of(before) - 2.0 * mean + mean_of(after);
  }
  mean = max(mean - bent / 12.0, 0.5 * mean);
  for (int c = 0; c < 3; ++c) table_of_sources[head_size + of_brick * (3 * brick + c) + n % of_brick] = mean[c];
  atomicMax(most, floatBitsToUint(max(mean.x, max(mean.y, mean.z))));
#endif
#ifdef HEAD
  if (n < head_size) table_of_sources[n] = n == 3 ? uintBitsToFloat(most) : head[n];
#endif
}
