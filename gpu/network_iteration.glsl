// Eight programs. START: sources are the first ones. PHASES: the phase function between two directions, an invocation a pair. WEIGHTS: the area that a list stands for and the optical depth of
// each particle's share of its links, an invocation a list. SHARES: what the light that a particle takes is divided by, and what of it goes evenly in all directions (cpu/network_iteration.cpp). SWEEP: light along
// a list. SCATTER: the new source of a particle, in a direction unless ISOTROPIC. SUMS: what changed of
// a particle, and what it sends, over all directions and channels. TAKEN: what a particle takes along all lines, ISOTROPIC.
#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/network.glsl"

layout(std430, binding = 0) readonly buffer LinkBuffer { float links[]; };
layout(std430, binding = 3) buffer SourceBuffer { vec4 sources[]; };
layout(std430, binding = 4) buffer TakenBuffer { vec4 taken[]; };  // of each line and particle, or each direction and particle; a: a source's change
layout(std430, binding = 5) buffer WordBuffer { uint words[]; };   // change and sum of each particle, weights, shares, sky, areas
layout(std430, binding = 6) readonly buffer FirstBuffer { vec4 first_sources[]; };
layout(std430, binding = 7) buffer MatrixBuffer { float matrix_values[]; };

int weight_at(int line, int v) { return 2 * particle_count + line * particle_count + v; }
int share_at(int k) { return 2 * particle_count + line_count * particle_count + k; }
int rest_at(int k) { return share_at(line_count * particle_count + k); }
#ifdef ISOTROPIC
int sky_at(int d) { return share_at(particle_count) + 4 * d; }
#else
int sky_at(int d) { return share_at(2 * line_count * particle_count) + 4 * d; }
#endif
vec3 sky_of(int d) {
  int k = sky_at(d);
  return vec3(uintBitsToFloat(words[k]), uintBitsToFloat(words[k + 1]), uintBitsToFloat(words[k + 2]));
}
int particle_of(int line, int record) { return int(links[record_at(line, 0) + record]); }
int area_at(int line, int c) { return sky_at(2 * line_count) + line * slots + c; }

// Light along one way of a list of n particles from `record` on; what they take is set, or added to.
void sweep(int line, int c, int record, int n, bool backward, int source, int to, bool adds) {
  vec3 beam = sky_of(2 * line + (backward ? 1 : 0));
  vec3 waiting = vec3(0.0);  // of the particle that the last link led to
  float area = uintBitsToFloat(words[area_at(line, c)]);
  for (int step = 0; step <= n; ++step) {
    int k = record + (backward ? n - step : step);
    int before = particle_of(line, k == record ? k : k - 1);
    int after = particle_of(line, k == record + n ? k - 1 : k);
    float lost = links[record_at(line, 2) + k];
    float given = links[record_at(line, 3) + k];
    float kept = links[record_at(line, 4) + k];
    vec3 mean = 0.5 * (sources[source + before].xyz + sources[source + after].xyz);
    vec3 got = given * beam + kept * mean;
    beam += given * mean - lost * beam;
    if (step == 0) {
      waiting = got;
    } else {
      int left = backward ? after : before;
      vec3 sum = area * (waiting + (step == n ? got : 0.5 * got));
      taken[to + left] = vec4(adds ? taken[to + left].xyz + sum : sum, 0.0);
      waiting = 0.5 * got;
    }
  }
}

void main() {
  int n = item();
#ifdef START
#ifdef ISOTROPIC
  if (n >= particle_count) return;
#else
  if (n >= 2 * line_count * particle_count) return;
#endif
  sources[n] = first_sources[n];
#endif
#ifdef PHASES
  int directions = 2 * line_count;
  if (n >= directions * directions) return;
  matrix_values[n] = phase_value(phase_kind, phase_g, dot3(network_direction(n % directions), network_direction(n / directions)));
#endif
#ifdef WEIGHTS
  if (n >= line_count * slots) return;
  int line = n / slots;
  int c = n % slots;
  int first = int(links[begin_at(line, c)]);
  int last = int(links[begin_at(line, c + 1)]);
  float all = 0.0;
  float mass = 0.0;
  for (int k = first; k <= last; ++k) all += links[record_at(line, 1) + k + c];
  for (int k = first; k < last; ++k) mass += particle_plane(particle_mass, particle_of(line, k + c));
  float area = mass / max(all, 1e-30);
  words[area_at(line, c)] = floatBitsToUint(area);
  for (int k = first; k < last; ++k) {
    int record = record_at(line, 1) + k + c;
    float before = links[record] * (k == first ? 1.0 : 0.5);
    float after = links[record + 1] * (k + 1 == last ? 1.0 : 0.5);
    words[weight_at(line, particle_of(line, k + c))] = floatBitsToUint(area * (before + after));
  }
#endif
#ifdef SHARES
#ifdef ISOTROPIC
  if (n >= particle_count) return;
  float sum = 0.0;
  for (int line = 0; line < line_count; ++line) sum += uintBitsToFloat(words[weight_at(line, n)]);
  words[share_at(n)] = floatBitsToUint(0.5 / max(sum, 1e-30));
  words[n] = words[share_at(n)];  // where it can be read back: nothing has changed yet
#else
  if (n >= line_count * particle_count) return;
  int line = n / particle_count;
  float sum = 0.0;
  float of_phase = 0.0;
  float all_weights = 0.0;
  for (int j = 0; j < 2 * line_count; ++j) {
    float phase = matrix_values[2 * line + 2 * line_count * j];
    float weight = uintBitsToFloat(words[weight_at(j / 2, n % particle_count)]);
    sum += phase * weight;
    of_phase += phase;
    all_weights += weight;
  }
  float could = of_phase * uintBitsToFloat(words[weight_at(line, n % particle_count)]);
  words[share_at(n)] = floatBitsToUint(1.0 / max(could, 1e-30));
  words[rest_at(n)] = floatBitsToUint((could - sum) / max(all_weights, 1e-30));
#endif
#endif
#ifdef SWEEP
  int list = n / slots;
  int c = n % slots;
#ifdef ISOTROPIC
  int line = list;
#else
  int line = list / 2;
#endif
  if (line >= line_count) return;
  int first = int(links[begin_at(line, c)]);
  int count = int(links[begin_at(line, c + 1)]) - first;
  if (count == 0) return;
#ifdef ISOTROPIC
  sweep(line, c, first + c, count, false, 0, line * particle_count, false);
  sweep(line, c, first + c, count, true, 0, line * particle_count, true);
#else
  int at = list * particle_count;
  sweep(line, c, first + c, count, list % 2 == 1, at, at, false);
  for (int k = 0; k < count; ++k) {
    int v = particle_of(line, first + c + k);
    taken[at + v].xyz *= uintBitsToFloat(words[share_at(line * particle_count + v)]) * particle_rgb(particle_albedo, v);
  }
#endif
#endif
#ifdef SCATTER
  int v = n % particle_count;
  vec3 sum = vec3(0.0);
#ifdef ISOTROPIC
  if (n >= particle_count) return;
  for (int line = 0; line < line_count; ++line) sum += taken[line * particle_count + v].xyz;
  sum *= uintBitsToFloat(words[share_at(v)]) * particle_rgb(particle_albedo, v);
#else
  int directions = 2 * line_count;
  if (n >= directions * particle_count) return;
  int row = directions * (n / particle_count);
  for (int d = 0; d < directions; ++d) {
    float sent = matrix_values[row + d] + uintBitsToFloat(words[rest_at(d / 2 * particle_count + v)]);
    sum = fma(vec3(sent), taken[d * particle_count + v].xyz, sum);
  }
#endif
  vec3 now = first_sources[n].xyz + sum;
  vec3 change = abs(now - sources[n].xyz);
  sources[n] = vec4(now, 0.0);
  taken[n].w = change.x + change.y + change.z;
#endif
#ifdef TAKEN
  if (n >= particle_count) return;
  vec3 sum = taken[n].xyz;
  for (int line = 1; line < line_count; ++line) sum += taken[line * particle_count + n].xyz;
  taken[n] = vec4(sum, 0.0);
#endif
#ifdef SUMS
  if (n >= particle_count) return;
  float change = 0.0;
  float sum = 0.0;
#ifdef ISOTROPIC
  int directions = 1;
#else
  int directions = 2 * line_count;
#endif
  for (int d = 0; d < directions; ++d) {
    vec4 now = sources[d * particle_count + n];
    change += taken[d * particle_count + n].w;
    sum += now.x + now.y + now.z;
  }
  words[2 * n] = floatBitsToUint(change);
  words[2 * n + 1] = floatBitsToUint(sum);
#endif
}
