#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray normal_image;
layout(binding = 2) uniform sampler2DArray material_image;
layout(binding = 3) uniform sampler2DArray transmittance_image;
layout(binding = 4) uniform sampler2DArray light_transmittance_image;
layout(binding = 5) uniform sampler2DArray indirect_image;
layout(binding = 6) uniform sampler2DArray environment_image;
layout(binding = 0, rgba32f) uniform writeonly image2DArray surface_image;
layout(binding = 1, rgba32f) uniform writeonly image2DArray direct_image;
layout(binding = 2, rgba32f) uniform writeonly image2DArray ambient_image;

layout(std140, binding = 2) uniform Knobs {
  vec4 ambient_extinction;
  vec4 background;
};

// Seven floats a material: diffuse, specular, shininess.
layout(std430, binding = 0) readonly buffer MaterialBlock { float materials[]; };
#ifdef WITH_BRDFS
// Where the table of each material's reflectance begins, -1: it has none.
layout(std430, binding = 1) readonly buffer BrdfBlock { int brdfs[]; };
#endif

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  float index = texelFetch(material_image, at, 0).x;
  float through = texelFetch(transmittance_image, at, 0).x;
  vec3 direct = vec3(0.0);
  vec3 ambient = vec3(0.0);
  if (index >= 0.0 && through > 0.0) {  // nothing is seen behind opaque fog
    int m = int(index) * 7;
    vec3 diffuse = vec3(materials[m], materials[m + 1], materials[m + 2]);
    vec3 specular = vec3(materials[m + 3], materials[m + 4], materials[m + 5]);
    float shininess = materials[m + 6];
    bool glossy = specular != vec3(0.0);
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
      float irradiance = directional ? 1.0 : point_irradiance(length, vector_radius.w, ambient_extinction.w);
#ifdef WITH_LIGHT_TRANSMITTANCE
      irradiance *= texelFetch(light_transmittance_image, ivec3(p, k), 0).x;
#endif
#ifdef WITH_BRDFS
      int t = brdfs[int(index)];
      if (t >= 0) {
        vec3 sent;
        brdf_reflection(t, n.x, n.y, n.z, l.x, l.y, l.z, -d.x, -d.y, -d.z, sent.x, sent.y, sent.z);
        direct += sent * irradiance * power_directional.xyz;
        continue;
      }
#endif
      float cosine = dot3(n, l);
      direct += diffuse * (lambert(cosine) * irradiance) * power_directional.xyz;
      if (glossy) direct += specular * (phong(cosine, unit_distance(mirror.x, mirror.y, mirror.z, l.x, l.y, l.z), shininess) * irradiance) * power_directional.xyz;
    }
    direct *= through;
    ambient = diffuse * ambient_extinction.xyz * through;
  }
  vec3 indirect = vec3(0.0);
#ifdef WITH_INDIRECT
  indirect = texelFetch(indirect_image, at, 0).xyz;
#endif
  vec3 surface = index >= 0.0 ? direct + indirect + ambient : background.xyz * through;
#ifdef WITH_ENVIRONMENT
  surface += texelFetch(environment_image, at, 0).xyz;
#endif
  imageStore(surface_image, at, vec4(surface, 0.0));
#ifdef WITH_DIRECT
  imageStore(direct_image, at, vec4(direct, 0.0));
#endif
#ifdef WITH_AMBIENT
  imageStore(ambient_image, at, vec4(ambient, 0.0));
#endif
}
