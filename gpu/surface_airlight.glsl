#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray normal_image;
layout(binding = 2) uniform sampler2DArray material_image;
layout(binding = 3) uniform sampler2DArray transmittance_image;
#ifdef WITH_DEPTH
layout(binding = 4) uniform sampler2DArray depth_image;
#endif
layout(binding = 0, rgba32f) uniform writeonly image2DArray indirect_image;

layout(std140, binding = 2) uniform Knobs {
  vec4 albedo_extinction;
  vec4 rest_albedo;
};

// Two vectors a material: diffuse; specular and where its table begins.
layout(std430, binding = 0) readonly buffer MaterialBlock { vec4 materials[]; };

// Sine of half the angle between two unit vectors.
float half_angle_sine(vec3 a, vec3 b) { return min(sqrt(unit_distance(a.x, a.y, a.z, b.x, b.y, b.z) * 0.5), 1.0); }

// What a table's lobe about an axis sends on of the light from `l`: of a lamp, or of Gaussians and grid before a sun; of fog under a sun.
float once(int t, vec3 axis, vec3 l, float lambda) {
#ifdef WITH_PSF
  return surface_airlight_psf(t, lambda, dot3(axis, l));
#else
  return surface_airlight_point(t, lambda, half_angle_sine(axis, l));
#endif
}
float once_in_fog(int t, vec3 axis, vec3 l) { return surface_airlight_directional(t, half_angle_sine(axis, l)); }

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  float index = texelFetch(material_image, at, 0).x;
  vec3 sum = vec3(0.0);
  float through = texelFetch(transmittance_image, at, 0).x;
  if (index >= 0.0 && through > 0.0) {  // nothing is seen behind opaque fog
    vec3 diffuse = materials[2 * int(index)].xyz;
    vec4 specular_table = materials[2 * int(index) + 1];
    bool glossy = specular_table.xyz != vec3(0.0);
    int t = int(specular_table.w);
    vec3 d = pixel_ray(p);
    vec3 n = texelFetch(normal_image, at, 0).xyz;
    vec3 point = d * texelFetch(distance_image, at, 0).x;
    vec3 mirror = mirrored(n, d);
    for (int k = 0; k < light_count.x; ++k) {
      vec4 vector_radius = light_values[2 * k];
      vec4 power_directional = light_values[2 * k + 1];
      bool directional = power_directional.w != 0.0;
      float length;
      vec3 l = toward_light(vector_radius.xyz, directional, point, length);
      float lambda = 0.0;
      float fall_off = 1.0;
      if (!directional) {
        float r = max(length, vector_radius.w);
        lambda = length * albedo_extinction.w;
        fall_off = 1.0 / (r * r);
      }
      vec3 albedo = albedo_extinction.xyz;
      float rest = 0.0;
      bool of_depth = !directional;
#ifdef WITH_DEPTH
      rest = texelFetch(depth_image, ivec3(p, k), 0).x;
      lambda += rest;
      albedo = fma(vec3(rest / max(lambda, 1e-30)), rest_albedo.xyz - albedo, albedo);
      of_depth = true;
#endif
#ifdef WITH_PSF
      bool in_fog = false;
#else
      bool in_fog = directional && albedo_extinction.w > 0.0;
#endif
      if (of_depth) {
        vec3 reflected = diffuse * (once(0, n, l, lambda) * fall_off * 0.31830988618379067);
        if (glossy) reflected += specular_table.xyz * (once(t, mirror, l, lambda) * fall_off);
        sum += reflected * (power_directional.xyz * albedo);
      }
      if (in_fog) {
        float attenuation = transmittance(rest);
        vec3 reflected = diffuse * (once_in_fog(0, n, l) * attenuation * 0.31830988618379067);
        if (glossy) reflected += specular_table.xyz * (once_in_fog(t, mirror, l) * attenuation);
        sum += reflected * (power_directional.xyz * albedo_extinction.xyz);
      }
    }
    sum *= through;
  }
  imageStore(indirect_image, at, vec4(sum, 0.0));
}
