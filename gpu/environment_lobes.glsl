// What a lobe about a direction reflects of an environment: t is where its table begins, of which `share` floats come first.
vec3 environment_lobe(int t, int share, vec3 about) {
  vec3 radiance;
  environment_reflection(t + share, about.x, about.y, about.z, radiance.x, radiance.y, radiance.z);
  return radiance;
}

// The same of a material's lobe about the mirror direction of d, seen by a surface of this normal.
vec3 environment_mirrored(int t, int share, vec3 n, vec3 d) {
  vec3 mirror = mirrored(n, d);
  return environment_lobe(t, share, mirror) * environment_share(t, dot3(n, mirror));
}
