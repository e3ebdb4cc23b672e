// Two programs. RADIANCE: what each splat sends toward the camera, an invocation a splat. Without it: the image.
#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(std140, binding = 2) uniform Knobs {
  vec4 ambient_sky_distance;
  float extinction;
  float inverse_reach;
  float least_seen;
  int particle_count;
  int line_count;
  int bin_side;
  int bin_columns;
};

// Two vectors a splat (common/algorithms/particle_splats.h): centre, 1 / support; peak, particle.
layout(std430, binding = 0) readonly buffer SplatBuffer { vec4 splats[]; };
layout(std430, binding = 1) buffer RadianceBuffer { vec4 radiances[]; };

#ifdef RADIANCE
layout(std430, binding = 2) readonly buffer SourceBuffer { vec4 particle_sources[]; };
layout(std430, binding = 3) readonly buffer LineBuffer { ivec4 lines[]; };  // three a line (common/algorithms/network.h)

uniform int first_item;  // of this dispatch

void main() {
  int n = first_item + int(gl_WorkGroupID.x) * 64 + int(gl_LocalInvocationIndex);
  if (n >= particle_count) return;
  int particle = int(splats[2 * n + 1].y);
#ifdef ISOTROPIC
  vec3 sent = particle_sources[particle].xyz;
#else
  vec3 center = splats[2 * n].xyz;
  vec3 to = center * (-1.0 / sqrt(max(dot3(center, center), 1e-37)));
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int line = 0; line < line_count; ++line) {
    vec3 w = vec3(lines[3 * line].xyz);
    float mu = dot3(w * (1.0 / sqrt(dot3(w, w))), to);
    float along = direction_weight(mu, inverse_reach);
    float against = direction_weight(-mu, inverse_reach);
    sum += along * particle_sources[2 * line * particle_count + particle].xyz;
    sum += against * particle_sources[(2 * line + 1) * particle_count + particle].xyz;
    weights += along + against;
  }
  vec3 sent = sum / max(weights, 1e-30);
#endif
  radiances[n] = vec4(sent + ambient_sky_distance.xyz, 0.0);
}
#else
layout(std430, binding = 2) readonly buffer BinBlock { int bins[]; };  // common/plan/gaussian_bins.h

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray scattered_image;
layout(binding = 0, rgba32f) uniform writeonly image2DArray airlight_image;
layout(binding = 1, r32f) uniform writeonly image2DArray transmittance_image;
layout(binding = 2, r32f) uniform writeonly image2DArray optical_depth_image;

void main() {
  ivec2 pixel = this_pixel();
  if (outside(pixel)) return;
  ivec3 at = ivec3(pixel, 0);
  float length_of_ray = ray_length(texelFetch(distance_image, at, 0).x, ambient_sky_distance.w);
  float end = min(length_of_ray, 1e15);
  vec3 d = pixel_ray(pixel);
  vec3 sum = vec3(0.0);
  float depth = 0.0;
  float left = 1.0;
  int square = pixel.x / bin_side + bin_columns * (in_image(pixel).y / bin_side);
  int to = bins[square + 1];
  for (int n = bins[square]; n < to; ++n) {
    vec4 center = splats[2 * bins[n]];
    float foot;
    float tau = splat_depth(d.x, d.y, d.z, center.x, center.y, center.z, center.w, splats[2 * bins[n] + 1].x, end, foot);
    if (tau <= 0.0) continue;
    depth += tau;
    if (left > least_seen) {
      float hidden = left * splat_opacity(tau);
      left -= hidden;
      if (extinction > 0.0) hidden *= transmittance(min(max(foot, 0.0), end) * extinction);
      sum += hidden * radiances[bins[n]].xyz;
    }
#ifndef WITH_OPTICAL_DEPTH
    if (left <= least_seen) break;
#endif
  }
#ifdef WITH_SCATTERED
  sum += texelFetch(scattered_image, at, 0).xyz;
#endif
  float of_fog = optical_depth(length_of_ray, extinction);
  imageStore(airlight_image, at, vec4(sum, 0.0));
  imageStore(transmittance_image, at, vec4(left * transmittance(of_fog)));
#ifdef WITH_OPTICAL_DEPTH
  imageStore(optical_depth_image, at, vec4(min(depth + of_fog, 1e30)));
#endif
}
#endif
