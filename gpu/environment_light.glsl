#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/environment_lobes.glsl"

layout(binding = 1) uniform sampler2DArray normal_image;
layout(binding = 2) uniform sampler2DArray material_image;
layout(binding = 3) uniform sampler2DArray transmittance_image;
#ifdef WITH_HIDDEN_DIFFUSE
layout(binding = 4) uniform sampler2DArray hidden_diffuse_image;
#endif
#ifdef WITH_HIDDEN_SPECULAR
layout(binding = 5) uniform sampler2DArray hidden_specular_image;
#endif
#ifdef WITH_MEDIUM
layout(binding = 6) uniform sampler2DArray mean_depth_image;
#endif
layout(binding = 0, rgba32f) uniform writeonly image2DArray environment_image;

// Where the image begins, floats of a share, where the harmonics begin.
layout(std140, binding = 2) uniform Knobs { ivec4 counts; };

// Two vectors a material: diffuse; specular and where its lobe's table begins.
layout(std430, binding = 0) readonly buffer MaterialBlock { vec4 materials[]; };
#ifdef WITH_BRDFS
// Where the lobes of each material's reflectance begin, -1: it has none.
layout(std430, binding = 2) readonly buffer BrdfBlock { int lobes[]; };
#endif

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
    vec3 radiance = environment_lobe(0, counts.y, n);
#ifdef WITH_HIDDEN_DIFFUSE
    radiance = max(radiance - texelFetch(hidden_diffuse_image, at, 0).xyz, 0.0);
#endif
    light = diffuse * radiance;
    if (specular_table.xyz != vec3(0.0)) {
      radiance = environment_mirrored(int(specular_table.w), counts.y, n, d);
#ifdef WITH_HIDDEN_SPECULAR
      radiance = max(radiance - texelFetch(hidden_specular_image, at, 0).xyz, 0.0);
#endif
      light += specular_table.xyz * radiance;
    }
#ifdef WITH_BRDFS
    int tabulated = lobes[int(index)];
    if (tabulated >= 0) {
      brdf_environment(counts.z, tabulated, n.x, n.y, n.z, -d.x, -d.y, -d.z, light.x, light.y, light.z);
#ifdef WITH_HIDDEN_SPECULAR
      light = max(light - texelFetch(hidden_specular_image, at, 0).xyz, 0.0);
#endif
    }
#endif
#ifdef WITH_MEDIUM
    light *= transmittance(texelFetch(mean_depth_image, at, 0).x);
#endif
  } else {
    float turns;
    float polar;
    environment_place(d.x, d.y, d.z, turns, polar);
    light.x = environment_value(counts.x, 0, turns, polar);
    light.y = environment_value(counts.x, 1, turns, polar);
    light.z = environment_value(counts.x, 2, turns, polar);
  }
  imageStore(environment_image, at, vec4(light * texelFetch(transmittance_image, at, 0).x, 0.0));
}
