#include "gpu/dialect.glsl"
#include "gpu/screen.glsl"

layout(binding = 0) uniform sampler2DArray distance_image;
layout(binding = 1) uniform sampler2DArray sampled_distance;
layout(binding = 2) uniform sampler2DArray sampled_airlight;
layout(binding = 3) uniform sampler2DArray sampled_transmittance;
layout(binding = 4) uniform sampler2DArray sampled_per_light;
layout(binding = 0, rgba32f) uniform writeonly image2DArray airlight_image;
layout(binding = 1, rgba32f) uniform writeonly image2DArray per_light_image;
layout(binding = 2, r32f) uniform writeonly image2DArray remaining_image;
layout(binding = 3, r32f) uniform writeonly image2DArray transmittance_image;

layout(std140, binding = 2) uniform Knobs {
  int columns;  // of samples
  int rows;
  int layers;
  int sampled_row;  // of samples, that is row 0 of their textures
  float step_size;
  float tolerance;
};

ivec2 first;  // the upper left one of four samples
float u;
float v;
vec4 weights;  // where the pixel is not smooth; their sum is 1
bool smooth_here;
bool served;

// One channel of the four samples, their bends, and the sizes of these: above, below, left, right.
struct Channel {
  vec4 four;
  vec4 bends;
  vec4 sizes;
};

// Three channels of an image around the pixel.
Channel[3] channels_of(sampler2DArray samples, int layer) {
  ivec3 last = ivec3(columns - 1, rows - 1, layer);
  vec3 s[16];
  for (int k = 0; k < 16; ++k) {
    ivec3 at = clamp(ivec3(first + ivec2(k % 4 - 1, k / 4 - 1), layer), ivec3(0, 0, layer), last);
    s[k] = texelFetch(samples, at - ivec3(0, sampled_row, 0), 0).xyz;
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
                             bend_between(s[2][c], s[6][c], s[10][c], s[14][c], has_above, has_below)),
                        vec4(bend_size(s[4][c], s[5][c], s[6][c], s[7][c], has_left, has_right),
                             bend_size(s[8][c], s[9][c], s[10][c], s[11][c], has_left, has_right),
                             bend_size(s[1][c], s[5][c], s[9][c], s[13][c], has_above, has_below),
                             bend_size(s[2][c], s[6][c], s[10][c], s[14][c], has_above, has_below)));
  }
  return result;
}

float most_of(vec4 x) { return max(max(x.x, x.y), max(x.z, x.w)); }
float least_of(vec4 x) { return min(min(x.x, x.y), min(x.z, x.w)); }

// What is known of the samples' values: the largest, and the error of each way.
struct Errors {
  float most;
  float most_fitting;
  float flat_error;
  float spread;
  float spread_fitting;
};

void add_errors(inout Errors e, Channel channel, vec4 fit) {
  vec4 four = channel.four;
  vec4 sizes = channel.sizes;
  e.flat_error = max(e.flat_error, upsampling_error(sizes.x, sizes.y, sizes.z, sizes.w, u, v));
  float high = most_of(four);
  e.most = max(e.most, high);
  e.spread = max(e.spread, high - least_of(four));
  float high_fitting = 0.0;
  float low_fitting = 1e30;
  for (int k = 0; k < 4; ++k) {
    if (fit[k] > 0.0) {
      high_fitting = max(high_fitting, four[k]);
      low_fitting = min(low_fitting, four[k]);
    }
  }
  e.most_fitting = max(e.most_fitting, high_fitting);
  e.spread_fitting = max(e.spread_fitting, high_fitting - low_fitting);
}

void find_serving(float distance, Channel[3] channels, Channel transmittances) {
  float inverse = 1.0 / distance;
  vec4 end;
  vec4 fit;
  float x = min(u, 1.0);
  float y = min(v, 1.0);
  vec4 bilinear = vec4((1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y);
  float fitting = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 at = min(first + ivec2(k % 2, k / 2), ivec2(columns - 1, rows - 1));
    end[k] = 1.0 / texelFetch(sampled_distance, ivec3(at.x, at.y - sampled_row, 0), 0).x;
    fit[k] = bilinear[k] * depth_fit(inverse, end[k], tolerance);
    fitting += fit[k];
  }
  Errors light = Errors(0.0, 0.0, 0.0, 0.0, 0.0);
  Errors through = light;
  for (int c = 0; c < 3; ++c) add_errors(light, channels[c], fit);
  add_errors(through, transmittances, fit);
  through.most = max(through.most, least_transmittance());
  through.most_fitting = max(through.most_fitting, least_transmittance());

  float flat_end = between(between(end.x, end.y, u), between(end.z, end.w, u), v);
  float most = light.most * tolerance;
  float most_through = through.most * tolerance;
  smooth_here = abs(flat_end - inverse) <= inverse * tolerance && light.flat_error <= most && through.flat_error <= most_through;
  bool within = inverse >= least_of(end) * (1.0 - tolerance) && inverse <= most_of(end) * (1.0 + tolerance) &&
                light.spread + light.flat_error <= most && through.spread + through.flat_error <= most_through;
  bool fits = fitting >= least_fit() && light.spread_fitting + light.flat_error <= light.most_fitting * tolerance &&
              through.spread_fitting + through.flat_error <= through.most_fitting * tolerance;
  served = smooth_here || within || fits;
  weights = within ? bilinear : fit * (1.0 / max(fitting, 1e-6));
}

float value_of(Channel channel) {
  if (!served) return 0.0;
  vec4 four = channel.four;
  vec4 bends = channel.bends;
  if (smooth_here) return upsampled(four.x, four.y, four.z, four.w, bends.x, bends.y, bends.z, bends.w, u, v);
  return weighted_mean(four.x, four.y, four.z, four.w, weights.x, weights.y, weights.z, weights.w);
}
vec4 values_of(Channel[3] channels) { return vec4(value_of(channels[0]), value_of(channels[1]), value_of(channels[2]), 0.0); }

void main() {
  ivec2 p = this_pixel();
  if (outside(p)) return;
  vec2 place = vec2(in_image(p)) * step_size;
  vec2 corner = min(floor(place), vec2(max(columns - 2, 0), max(rows - 2, 0)));
  first = ivec2(corner);
  u = place.x - corner.x;
  v = place.y - corner.y;
  ivec3 at = ivec3(p, 0);
  float distance = texelFetch(distance_image, at, 0).x;
  Channel channels[3] = channels_of(sampled_airlight, 0);
  Channel transmittances = channels_of(sampled_transmittance, 0)[0];
  find_serving(distance, channels, transmittances);
  imageStore(remaining_image, at, vec4(served ? 0.0 : distance));
  imageStore(airlight_image, at, values_of(channels));
  imageStore(transmittance_image, at, vec4(min(value_of(transmittances), 1.0)));
#ifdef WITH_PER_LIGHT
  for (int k = 0; k < layers; ++k) imageStore(per_light_image, ivec3(p, k), values_of(channels_of(sampled_per_light, k)));
#endif
}
