#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/environment_lobes.glsl"

layout(binding = 1) uniform sampler2DArray normal_image;
layout(binding = 2) uniform sampler2DArray material_image;
layout(binding = 3) uniform sampler2DArray transmittance_image;
#ifdef WITH_MORE
layout(binding = 4) uniform sampler2DArray scattered_image;
#endif
#ifdef WITH_MEDIUM
layout(binding = 5) uniform sampler2DArray mean_depth_image;
#endif
layout(binding = 0, rgba32f) uniform writeonly image2DArray indirect_image;

layout(std140, binding = 2) uniform Knobs {
  vec4 albedo;
  vec4 gaussian_albedo_share;  // floats of a share
};

// Two vectors a material: diffuse; specular and where its lobe's table begins.
layout(std430, binding = 0) readonly buffer MaterialBlock { vec4 materials[]; };

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
    sum = diffuse * environment_lobe(0, int(gaussian_albedo_share.w), n);
    if (specular_table.xyz != vec3(0.0)) {
      sum += specular_table.xyz * environment_mirrored(int(specular_table.w), int(gaussian_albedo_share.w), n, d);
    }
    float depth = 0.0;
#ifdef WITH_MEDIUM
    depth = texelFetch(mean_depth_image, at, 0).x;
#endif
    float of_homogeneous;
    float of_rest;
#ifdef PUBLISHED
    of_homogeneous = 0.0;
    of_rest = environment_scattered_published(depth);
#else
    environment_scattered_to_surface(depth, of_homogeneous, of_rest);
#endif
    sum *= fma(vec3(of_homogeneous), albedo.xyz, of_rest * gaussian_albedo_share.xyz) * texelFetch(transmittance_image, at, 0).x;
  }
#ifdef WITH_MORE
  sum += texelFetch(scattered_image, at, 0).xyz;
#endif
  imageStore(indirect_image, at, vec4(sum, 0.0));
}
