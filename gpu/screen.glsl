// What every per-pixel shader shares: one invocation a pixel, the view, the lights.

layout(local_size_x = 16, local_size_y = 4) in;
uniform int first_row;  // of the band of rows that this dispatch covers, in the textures

layout(std140, binding = 0) uniform ViewBlock {
  vec4 view_right;    // w: width
  vec4 view_up;       // w: height
  vec4 view_forward;  // w: tangent of half the field of view
  vec4 view_offset;   // xy: sub-pixel shift; z: row of the image that is row 0 of the textures; w: the row of these where what is made ends
};

// A pixel in the textures, which may hold some rows of an image alone; the same in the image.
ivec2 this_pixel() { return ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row); }
bool outside(ivec2 p) { return p.x >= int(view_right.w) || p.y >= int(view_offset.w); }
ivec2 in_image(ivec2 p) { return p + ivec2(0, int(view_offset.z)); }

// Unit direction of a pixel's ray.
vec3 pixel_ray(ivec2 p) {
  float x = image_plane_x(float(p.x), view_offset.x, view_right.w, view_up.w, view_forward.w);
  float y = image_plane_y(float(in_image(p).y), view_offset.y, view_up.w, view_forward.w);
  vec3 d;
  view_ray(x, y, view_right.x, view_right.y, view_right.z, view_up.x, view_up.y, view_up.z, view_forward.x, view_forward.y,
           view_forward.z, d.x, d.y, d.z);
  return d;
}

// The same order as in the CPU kernels.
float dot3(vec3 a, vec3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
// A direction reflected by a surface of this unit normal.
vec3 mirrored(vec3 n, vec3 d) { return fma(vec3(-2.0 * dot3(n, d)), n, d); }

// Two vectors a light: position or direction of travel, and radius; power, and 1 for a directional light.
#if defined(MOST_LIGHTS) || defined(MANY_LIGHTS)
layout(std140, binding = 1) uniform LightBlock {
  ivec4 light_count;
#ifdef MOST_LIGHTS
  vec4 light_values[2 * MOST_LIGHTS];
#endif
};
#ifdef MANY_LIGHTS
layout(std430, binding = 6) readonly buffer LightBuffer { vec4 light_values[]; };
#endif
#endif

// A point light beside a ray from the camera: where its foot is, and how far it is from there, at least its radius.
void beside_ray(vec4 vector_radius, vec3 d, out float foot, out float h) {
  perpendicular(d.x, d.y, d.z, vector_radius.x, vector_radius.y, vector_radius.z, vector_radius.w, foot, h);
}

// What a light of unit power scatters into a ray on [x0, x1] in a homogeneous medium of albedo 1; its tables are those at 0.
float airlight_of(vec4 vector_radius, bool directional, vec3 d, int phase_kind, float g, float extinction, float x0, float x1) {
  if (directional) return directional_airlight(phase_kind, g, extinction, -dot3(vector_radius.xyz, d), x0, x1);
  float foot;
  float h;
  beside_ray(vector_radius, d, foot, h);
  return point_airlight(0, phase_kind, g, extinction, foot, h, x0, x1);
}

// A light seen from p: unit direction toward it, and how far it is; 1e15 for a directional one.
vec3 toward_light(vec3 vector, bool directional, vec3 p, out float length) {
  length = 1e15;
  if (directional) return -vector;
  vec3 way = vector - p;
  length = sqrt(max(dot3(way, way), 1e-37));
  return way * (1.0 / length);
}
