#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/mean_depth.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray normal_image;
layout(binding = 2) uniform sampler2DArray material_image;
layout(binding = 3) uniform sampler2DArray transmittance_image;
layout(binding = 0, rgba32f) uniform writeonly image2DArray environment_image;

layout(std140, binding = 2) uniform Knobs { ivec4 counts; };  // Gaussians, where the image begins, floats of a share

// Two vectors a material: diffuse; specular and where its lobe's table begins.
layout(std430, binding = 0) readonly buffer MaterialBlock { vec4 materials[]; };
vec3 lobe(int t, vec3 about) {
  vec3 radiance;
  environment_reflection(t + counts.z, about.x, about.y, about.z, radiance.x, radiance.y, radiance.z);
  return radiance;
}

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  float index = texelFetch(material_image, at, 0).x;
  vec3 d = pixel_ray(p);
  vec3 light;
  if (index >= 0.0) {
    vec3 diffuse = materials[2 * int(index)].xyz;
    vec4 specular_table = materials[2 * int(index) + 1];
    vec3 n = texelFetch(normal_image, at, 0).xyz;
    light = diffuse * lobe(0, n);
    if (specular_table.xyz != vec3(0.0)) {
      vec3 mirror = fma(vec3(-2.0 * dot3(n, d)), n, d);
      int t = int(specular_table.w);
      light += specular_table.xyz * (lobe(t, mirror) * environment_share(t, dot3(n, mirror)));
    }
    light *= transmittance(mean_depth(counts.x, d * texelFetch(distance_image, at, 0).x));
  } else {
    float turns;
    float polar;
    environment_place(d.x, d.y, d.z, turns, polar);
    light.x = environment_value(counts.y, 0, turns, polar);
    light.y = environment_value(counts.y, 1, turns, polar);
    light.z = environment_value(counts.y, 2, turns, polar);
  }
  imageStore(environment_image, at, vec4(light * texelFetch(transmittance_image, at, 0).x, 0.0));
}
