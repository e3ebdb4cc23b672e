#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray sampled_distance;
layout(binding = 2) uniform sampler2DArray sampled_airlight;
layout(binding = 3) uniform sampler2DArray sampled_per_light;
layout(binding = 0, rgba32f) uniform writeonly image2DArray airlight_image;
layout(binding = 1, rgba32f) uniform writeonly image2DArray per_light_image;

layout(std140, binding = 2) uniform Knobs {
  int columns;  // of samples
  int rows;
  int layers;
  int unused;
  float step_size;
  float tolerance;
};

ivec2 first;  // the upper left one of four samples
float u;
float v;
vec4 weights;  // where the pixel is not smooth; their sum is 1
bool smooth_here;
bool served;

// One channel of the four samples, and their bends: above, below, left, right.
struct Channel {
  vec4 four;
  vec4 bends;
};

// Three channels of an image around the pixel.
Channel[3] channels_of(sampler2DArray samples, int layer) {
  ivec3 last = ivec3(columns - 1, rows - 1, layer);
  vec3 s[16];
  for (int k = 0; k < 16; ++k) {
    s[k] = texelFetch(samples, clamp(ivec3(first + ivec2(k % 4 - 1, k / 4 - 1), layer), ivec3(0, 0, layer), last), 0).xyz;
  }
  bool has_left = first.x > 0;
  bool has_right = first.x < columns - 2;
  bool has_above = first.y > 0;
  bool has_below = first.y < rows - 2;
  Channel result[3];
  for (int c = 0; c < 3; ++c) {
    result[c] = Channel(vec4(s[5][c], s[6][c], s[9][c], s[10][c]),
                        vec4(bend_between(s[4][c], s[5][c], s[6][c], s[7][c], has_left, has_right),
                             bend_between(s[8][c], s[9][c], s[10][c], s[11][c], has_left, has_right),
                             bend_between(s[1][c], s[5][c], s[9][c], s[13][c], has_above, has_below),
                             bend_between(s[2][c], s[6][c], s[10][c], s[14][c], has_above, has_below)));
  }
  return result;
}

float most_of(vec4 x) { return max(max(x.x, x.y), max(x.z, x.w)); }
float least_of(vec4 x) { return min(min(x.x, x.y), min(x.z, x.w)); }

void find_serving(float distance, Channel[3] channels) {
  float inverse = 1.0 / distance;
  vec4 end;
  vec4 fit;
  float x = min(u, 1.0);
  float y = min(v, 1.0);
  vec4 bilinear = vec4((1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y);
  float fitting = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 at = min(first + ivec2(k % 2, k / 2), ivec2(columns - 1, rows - 1));
    end[k] = 1.0 / texelFetch(sampled_distance, ivec3(at, 0), 0).x;
    fit[k] = bilinear[k] * depth_fit(inverse, end[k], tolerance);
    fitting += fit[k];
  }
  float most = 0.0;
  float most_fitting = 0.0;
  float error = 0.0;
  float spread = 0.0;
  float spread_fitting = 0.0;
  for (int c = 0; c < 3; ++c) {
    vec4 four = channels[c].four;
    vec4 bends = channels[c].bends;
    error = max(error, upsampling_error(bends.x, bends.y, bends.z, bends.w, u, v));
    float high = most_of(four);
    most = max(most, high);
    spread = max(spread, high - least_of(four));
    float high_fitting = 0.0;
    float low_fitting = 1e30;
    for (int k = 0; k < 4; ++k) {
      if (fit[k] > 0.0) {
        high_fitting = max(high_fitting, four[k]);
        low_fitting = min(low_fitting, four[k]);
      }
    }
    most_fitting = max(most_fitting, high_fitting);
    spread_fitting = max(spread_fitting, high_fitting - low_fitting);
  }
  float flat_end = between(between(end.x, end.y, u), between(end.z, end.w, u), v);
  smooth_here = abs(flat_end - inverse) <= inverse * tolerance && error <= most * tolerance;
  bool within = inverse >= least_of(end) * (1.0 - tolerance) && inverse <= most_of(end) * (1.0 + tolerance) && spread <= most * tolerance;
  bool fits = fitting >= least_fit() && spread_fitting <= most_fitting * tolerance;
  served = smooth_here || within || fits;
  weights = within ? bilinear : fit * (1.0 / max(fitting, 1e-6));
}

vec4 value_of(Channel[3] channels) {
  vec4 value = vec4(-1.0, -1.0, -1.0, 0.0);
  for (int c = 0; c < 3 && served; ++c) {
    vec4 four = channels[c].four;
    vec4 bends = channels[c].bends;
    if (smooth_here) {
      value[c] = upsampled(four.x, four.y, four.z, four.w, bends.x, bends.y, bends.z, bends.w, u, v);
    } else {
      value[c] = fma(weights.x, four.x, fma(weights.y, four.y, fma(weights.z, four.z, weights.w * four.w)));
    }
  }
  return value;
}

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  vec2 place = vec2(p) * step_size;
  vec2 corner = min(floor(place), vec2(max(columns - 2, 0), max(rows - 2, 0)));
  first = ivec2(corner);
  u = place.x - corner.x;
  v = place.y - corner.y;
  Channel[3] channels = channels_of(sampled_airlight, 0);
  find_serving(texelFetch(distance_image, ivec3(p, 0), 0).x, channels);
  imageStore(airlight_image, ivec3(p, 0), value_of(channels));
#ifdef WITH_PER_LIGHT
  for (int k = 0; k < layers; ++k) imageStore(per_light_image, ivec3(p, k), value_of(channels_of(sampled_per_light, k)));
#endif
}
