#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

// common/algorithms/hidden_environment.h
const int head_floats = 4;
const int vertex_floats = 5;
const int lobe_floats = 108;
uniform int first_vertex;
#ifdef WITH_BRDFS
uniform int brdf_floats;  // of the lobes of one reflectance
#endif

layout(binding = 0) uniform sampler2DArray normal_image;
layout(binding = 1) uniform sampler2DArray corners_image;
layout(binding = 0, rgba32f) uniform writeonly image2DArray diffuse_image;
#ifdef WITH_SPECULAR
layout(binding = 1, rgba32f) uniform writeonly image2DArray specular_image;
#endif
layout(std430, binding = 0) readonly buffer TriangleBlock { uvec4 triangles[]; };

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  ivec3 at = ivec3(p, 0);
  vec3 corners = texelFetch(corners_image, at, 0).xyz;
  int number = int(corners.x);
  vec3 diffuse = vec3(0.0);
  vec3 specular = vec3(0.0);
  if (number != 0) {
    uvec4 t = triangles[abs(number) - 1];
    int vertices = int(table_values[0]);
    ivec3 place = (ivec3(t.xyz) + (number < 0 ? vertices : 0)) * vertex_floats + first_vertex;
    for (int c = 0; c < 3; ++c)
      diffuse[c] = between_corners(table_values[place.x + c], table_values[place.y + c], table_values[place.z + c], corners.y, corners.z);
#ifdef WITH_SPECULAR
    vec3 weights = vec3(1.0 - corners.y - corners.z, corners.y, corners.z);
    vec3 d = pixel_ray(p);
    vec3 n = texelFetch(normal_image, at, 0).xyz;
    vec3 mirror = mirrored(n, d);
    float v[36];
    sh_basis(6, -mirror.z, mirror.x, mirror.y, v);
    int lobes = first_vertex + 2 * vertex_floats * vertices;
#ifdef WITH_BRDFS
    float tabulated = table_values[place.x + 4];
    real red[36];
    real green[36];
    real blue[36];
    for (int i = 0; i < 36; ++i) {
      red[i] = 0.0;
      green[i] = 0.0;
      blue[i] = 0.0;
    }
    bool hides = false;
#endif
    for (int k = 0; k < 3; ++k) {
      float lobe_number = table_values[place[k] + 3];
      if (lobe_number < 0.0) continue;
      int lobe = lobes + lobe_floats * int(lobe_number);
#ifdef WITH_BRDFS
      if (tabulated >= 0.0) {
        for (int i = 0; i < 36; ++i) {
          red[i] = fma(weights[k], table_values[lobe + i], red[i]);
          green[i] = fma(weights[k], table_values[lobe + 36 + i], green[i]);
          blue[i] = fma(weights[k], table_values[lobe + 72 + i], blue[i]);
        }
        hides = true;
        continue;
      }
#endif
      for (int c = 0; c < 3; ++c) specular[c] = fma(weights[k], sh_sum(lobe + 36 * c, 6, v), specular[c]);
    }
#ifdef WITH_BRDFS
    if (hides) {
      brdf_environment_part(red, green, blue, head_floats + brdf_floats * int(tabulated), n.x, n.y, n.z, -d.x, -d.y, -d.z, specular.x, specular.y,
                            specular.z);
    }
#endif
#endif
  }
  imageStore(diffuse_image, at, vec4(diffuse, 0.0));
#ifdef WITH_SPECULAR
  imageStore(specular_image, at, vec4(specular, 0.0));
#endif
}
