// Two programs: ARRIVING, what arrives of a light at a particle, divided by what all directions have of the phase function, an invocation a light and a particle; FIRST, what is scattered of
// all lights, an invocation a direction and a particle.
#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/medium.glsl"
#include "gpu/network.glsl"

layout(std430, binding = 0) buffer FirstBuffer { vec4 first_sources[]; };
layout(std430, binding = 3) buffer ArrivingBuffer { float arriving[]; };

void main() {
  int n = item();
  int k = n / particle_count;
  int v = n % particle_count;
  vec3 place = particle_place(v);
#ifdef ARRIVING
  if (k >= light_count.x) return;
  vec4 vector_radius = light_values[2 * k];
  bool directional = light_values[2 * k + 1].w != 0.0;
  float length;
  vec3 way = toward_light(vector_radius.xyz, directional, place, length);
  float depth = depth_of_way(place, way, length);
  float value = 1.0;
  if (!directional) {
    float r = max(length, vector_radius.w);
    depth = fma(length, network_extinction, depth);
    value = 1.0 / (r * r);
  }
  value *= transmittance(depth);
  if (phase_kind != 0) {
    float sum = 0.0;
    for (int d = 0; d < 2 * line_count; ++d) sum += phase_value(phase_kind, phase_g, -dot3(way, network_direction(d)));
    value *= float(2 * line_count) * phase_isotropic() / sum;
  }
  arriving[n] = value;
#endif
#ifdef FIRST
  if (n >= particle_count * (phase_kind == 0 ? 1 : 2 * line_count)) return;
  vec3 sum = particle_rgb(particle_glow, v);
  vec3 albedo = particle_rgb(particle_albedo, v);
  for (int l = 0; l < light_count.x; ++l) {
    float phase = phase_isotropic();
    if (phase_kind != 0) {
      float length;
      vec3 way = toward_light(light_values[2 * l].xyz, light_values[2 * l + 1].w != 0.0, place, length);
      phase = phase_value(phase_kind, phase_g, -dot3(way, network_direction(k)));
    }
    sum += arriving[l * particle_count + v] * phase * light_values[2 * l + 1].xyz * albedo;
  }
  first_sources[n] = vec4(sum, 0.0);
#endif
}
