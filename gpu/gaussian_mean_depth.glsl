// Mean optical depth of Gaussians over all directions from a place. Two vectors a Gaussian: centre and 1 / radius; extinction times radius.
layout(std430, binding = 1) readonly buffer GaussianBlock { vec4 gaussians[]; };

float gaussian_mean_depth(int count, vec3 place) {
  float depth = 0.0;
  for (int g = 0; g < count; ++g) {
    vec3 e = (gaussians[2 * g].xyz - place) * gaussians[2 * g].w;
    depth = fma(average_gaussian_depth(dot3(e, e)), gaussians[2 * g + 1].x, depth);
  }
  return depth;
}
