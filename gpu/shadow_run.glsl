// One light over one run of tiles, a rectangle of the screen (gpu/shadow_runs.h).

layout(std140, binding = 4) uniform Run {
  ivec4 corner_size;  // of the rectangle [pixel], in the textures
  int tile_side;
  int light;
  int covering;   // triangles between camera and light
  int capacity;   // crossings that the list of a pixel holds
  int any_plane;  // 0: no plane touches the rectangle, and there are no lists
  float run_sky_distance;
};

// Slot by slot, in each a pixel of the rectangle after the other: 1/z and change of a crossing, or begin and end of a lit part. In the slot behind
// `capacity` stands how many lit parts there are.
layout(std430, binding = 3) buffer ListBlock { uvec2 lists[]; };

ivec2 in_run() { return ivec2(gl_GlobalInvocationID.xy); }
bool outside_run(ivec2 p) { return p.x >= corner_size.z || p.y >= corner_size.w; }
// Of slot n of a pixel.
int list_at(int n) { return n * corner_size.z * corner_size.w + in_run().y * corner_size.z + in_run().x; }
