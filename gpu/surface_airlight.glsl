#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray normal_image;
layout(binding = 2) uniform sampler2DArray material_image;
layout(binding = 3) uniform sampler2DArray transmittance_image;
layout(binding = 0, rgba32f) uniform writeonly image2DArray indirect_image;

layout(std140, binding = 2) uniform Knobs { vec4 albedo_extinction; };

// Two vectors a material: diffuse; specular and where its table begins.
layout(std430, binding = 0) readonly buffer MaterialBlock { vec4 materials[]; };

// Sine of half the angle between two unit vectors.
float half_angle_sine(vec3 a, vec3 b) { return min(sqrt(unit_distance(a.x, a.y, a.z, b.x, b.y, b.z) * 0.5), 1.0); }

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  float index = texelFetch(material_image, at, 0).x;
  vec3 sum = vec3(0.0);
  if (index >= 0.0) {
    vec3 diffuse = materials[2 * int(index)].xyz;
    vec4 specular_table = materials[2 * int(index) + 1];
    vec3 d = pixel_ray(p);
    vec3 n = texelFetch(normal_image, at, 0).xyz;
    vec3 point = d * texelFetch(distance_image, at, 0).x;
    vec3 mirror = fma(vec3(-2.0 * dot3(n, d)), n, d);
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
      float s = half_angle_sine(n, l);
      float once = directional ? surface_airlight_directional(0, s) : surface_airlight_point(0, lambda, s) * fall_off;
      vec3 reflected = diffuse * (once * 0.31830988618379067);
      if (specular_table.xyz != vec3(0.0)) {
        int t = int(specular_table.w);
        s = half_angle_sine(mirror, l);
        reflected += specular_table.xyz * (directional ? surface_airlight_directional(t, s) : surface_airlight_point(t, lambda, s) * fall_off);
      }
      sum += reflected * (power_directional.xyz * albedo_extinction.xyz);
    }
    sum *= texelFetch(transmittance_image, at, 0).x;
  }
  imageStore(indirect_image, at, vec4(sum, 0.0));
}
