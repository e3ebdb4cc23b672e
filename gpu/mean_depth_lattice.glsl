// An invocation a node of one lattice.
#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"
#include "gpu/gaussian_mean_depth.glsl"

layout(std430, binding = 0) buffer DepthBuffer { float depths[]; };

uniform int first_item;  // of this dispatch
uniform int gaussian_count;
uniform int nodes_x;
uniform int nodes_y;
uniform int node_count;  // in all
uniform int first_node;
uniform int padding;  // floats behind the last of all nodes; 0 where others follow
uniform vec3 corner;
uniform float spacing;

void main() {
  int n = first_item + int(gl_WorkGroupID.x) * 64 + int(gl_LocalInvocationIndex);
  if (n >= node_count + padding) return;
  float depth = 0.0;
  if (n < node_count) {
    vec3 at = vec3(float(n % nodes_x), float(n / nodes_x % nodes_y), float(n / nodes_x / nodes_y));
    depth = gaussian_mean_depth(gaussian_count, fma(at, vec3(spacing), corner));
  }
  depths[first_node + n] = depth;
}
