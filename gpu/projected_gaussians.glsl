#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/medium.glsl"

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
  int bin_side;
  int bin_columns;
  int gaussian_count;
};

layout(std430, binding = 0) readonly buffer BinBlock { int bins[]; };  // common/plan/gaussian_bins.h
// Optical depths of the others from each Gaussian's centre to the camera, then to each light; then from each light to the camera.
layout(std430, binding = 1) readonly buffer DepthBlock { float depths[]; };

// A dispatch takes some lights and, of each square's list, some Gaussians. Between dispatches the airlight image holds what is summed and the optical
// depth of the Gaussians behind.
uniform int first_light;
uniform int first_of_list;
uniform int most_of_list;
uniform int last_of_list;  // the last Gaussians of these lights
uniform int last_of_all;

int light_end() { return min(first_light + LIGHTS_A_PASS, light_count.x); }

void main() {
  ivec2 pixel = this_pixel();
  if (outside(pixel)) return;
  ivec3 at = ivec3(pixel, 0);
  float extinction = albedo_extinction.w;
  float length_of_ray = ray_length(texelFetch(distance_image, at, 0).x, ambient_sky_distance.w);
  float end = min(length_of_ray, 1e15);
  vec3 d = pixel_ray(pixel);
  bool first_lights = first_light == 0;
  vec4 held = vec4(0.0);
  if (!first_lights || first_of_list > 0) held = imageLoad(airlight_image, at);
  vec3 glow = vec3(0.0);
  float depths_on_ray = held.w;
  vec3 sums[LIGHTS_A_PASS];
  for (int n = 0; n < LIGHTS_A_PASS; ++n) sums[n] = vec3(0.0);

  int square = pixel.x / bin_side + bin_columns * (in_image(pixel).y / bin_side);
  int from = bins[square] + first_of_list;
  int to = min(bins[square + 1], from + most_of_list);
  for (int n = from; n < to; ++n) {
    int i = bins[n];
    vec3 c = center_radius(i).xyz;
    float radius = center_radius(i).w;
    float foot;
    float h;
    perpendicular(d.x, d.y, d.z, c.x, c.y, c.z, 0.0, foot, h);
    if (h >= emission_reach(i).w) continue;
    float inverse = 1.0 / radius;
    float whole = gaussian_whole(albedo_extinction_of(i).w, radius);
    float lateral = gaussian_lateral(inverse, h);
    float erf_from = gaussian_erf(GAUSSIAN_ERF, foot * -inverse);
    float erf_to = gaussian_erf(GAUSSIAN_ERF, (end - foot) * inverse);
    float depth = gaussian_between(lateral, erf_from, erf_to) * whole;
    float before = gaussian_between(lateral, erf_from, gaussian_nearest(erf_from, erf_to)) * whole;
    float t = min(max(foot, 0.0), end);
    vec3 place = d * t;
    vec3 e = c - place;
    float eye = depths[i] + extinction * length(c);
    if (first_lights) {
      depths_on_ray += depth;
      glow += depth * transmittance(before + eye) / albedo_extinction_of(i).w * emission_reach(i).xyz;
    }
    for (int k = first_light; k < light_end(); ++k) {
      vec4 vector_radius = light_values[2 * k];
      vec4 power_directional = light_values[2 * k + 1];
      bool directional = power_directional.w != 0.0;
      float way_length;
      float foot_of_way;
      float beside_way;
      vec3 way = toward_light(vector_radius.xyz, directional, place, way_length);
      perpendicular(way.x, way.y, way.z, e.x, e.y, e.z, 0.0, foot_of_way, beside_way);
      float all = before + gaussian_depth(GAUSSIAN_ERF, inverse, beside_way, -foot_of_way, way_length - foot_of_way) * whole;
      all += eye + depths[gaussian_count * (1 + k) + i];
      float density;
      if (directional) {
        density = directional_density(phase_kind, emission_g.w, 0.0, -dot3(vector_radius.xyz, d), t, all);
      } else {
        all += extinction * length(c - vector_radius.xyz);
        float foot_of_light;
        float beside_light;
        beside_ray(vector_radius, d, foot_of_light, beside_light);
        density = airlight_density(phase_kind, emission_g.w, 0.0, foot_of_light, beside_light, t, all);
      }
      sums[k - first_light] += min(depth * density, 1e20) * albedo_extinction_of(i).xyz * power_directional.xyz;
    }
  }

#ifdef WITH_TABLES
  // The homogeneous part.
  for (int k = first_light; k < light_end() && last_of_list != 0; ++k) {
    float once = airlight_of(light_values[2 * k], light_values[2 * k + 1].w != 0.0, d, phase_kind, emission_g.w, extinction, 0.0, length_of_ray);
    once *= transmittance(depths[gaussian_count * (1 + light_count.x) + k]);
    sums[k - first_light] += once * light_values[2 * k + 1].xyz * albedo_extinction.xyz;
  }
#endif
  vec3 sum = held.xyz + glow;
  for (int k = first_light; k < light_end(); ++k) {
    vec3 one = sums[k - first_light];
    sum += one;
#ifdef WITH_PER_LIGHT
    ivec3 layer = ivec3(pixel, k);
    if (first_of_list > 0) one += imageLoad(per_light_image, layer).xyz;
    imageStore(per_light_image, layer, vec4(one, 0.0));
#endif
  }
  if (last_of_all == 0) {
    imageStore(airlight_image, at, vec4(sum, depths_on_ray));
    return;
  }
  float tau = optical_depth(length_of_ray, extinction) + depths_on_ray;
  // As if the Gaussians were spread evenly over the ray.
  float emitting = attenuated_length(end, depths_on_ray / max(end, 1e-30) + extinction, tau);
  imageStore(airlight_image, at, vec4(sum + opacity(tau) * ambient_sky_distance.xyz + emitting * emission_g.xyz, 0.0));
  imageStore(transmittance_image, at, vec4(transmittance(tau)));
#ifdef WITH_OPTICAL_DEPTH
  imageStore(optical_depth_image, at, vec4(min(tau, 1e30)));
#endif
}
