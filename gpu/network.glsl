// Particles, lines and links of an illumination network (common/algorithms/network.h). After gpu/dialect.glsl and
// gpu/screen.glsl.

layout(std430, binding = 1) readonly buffer ParticleBuffer { float particle_values[]; };
layout(std430, binding = 2) readonly buffer LineBuffer { int line_values[]; };

layout(std140, binding = 2) uniform NetworkKnobs {
  int particle_count;
  int line_count;
  int slots;
  int phase_kind;
  float phase_g;
  float unit;
  float network_extinction;
  int samples;
  vec4 camera;
};

uniform int first_item;  // of this dispatch
int item() { return first_item + int(gl_WorkGroupID.x) * 64 + int(gl_LocalInvocationIndex); }

const int lattice_length = 8192;
const int line_fields = 12;
const int particle_albedo = 3;
const int particle_glow = 6;
const int particle_mass = 10;
const int link_planes = 5;

int line_field(int line, int k) { return line_values[line * line_fields + k]; }
ivec3 line_axis(int line, int k) { return ivec3(line_field(line, k), line_field(line, k + 1), line_field(line, k + 2)); }
// Edge number k of a line's pixels, those across before those down.
int edge_of(int line, int k) { return line_values[line_count * line_fields + line * (slots + 3) + k]; }
// Where a line's pixels across (0) or down (1) begin among its edges, and how many there are.
int first_edge(int line, int which) { return which == 0 ? 0 : line_field(line, 9) + 1; }
int pixels_of(int line, int which) { return line_field(line, 9 + which); }
// The pixel that holds a place between the first edge and the last.
int pixel_of(int line, int which, int place) {
  int first = first_edge(line, which);
  int low = 0;
  int high = pixels_of(line, which);
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (edge_of(line, first + middle) <= place) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}
// Unit direction number d: both ways of each line in turn.
vec3 network_direction(int d) {
  vec3 w = vec3(line_axis(d / 2, 0));
  w *= 1.0 / sqrt(dot3(w, w));
  return d % 2 == 0 ? w : -w;
}
float particle_plane(int k, int v) { return particle_values[k * particle_count + v]; }
vec3 particle_rgb(int k, int v) { return vec3(particle_plane(k, v), particle_plane(k + 1, v), particle_plane(k + 2, v)); }
vec3 particle_place(int v) { return particle_rgb(0, v) * unit; }

int begin_at(int line, int c) { return line * (slots + 1) + c; }
int record_at(int line, int plane) { return line_count * (slots + 1) + (line * link_planes + plane) * (particle_count + slots); }
