// What an algorithm that makes airlight and transmittance has for a pixel whose ray has no length. Included after its images.

// Stores it, and returns true, where the length is 0. Of lights `first` to `end`.
bool store_no_airlight(ivec3 at, float length, int first, int end) {
  if (length > 0.0) return false;
  imageStore(airlight_image, at, vec4(0.0));
  imageStore(transmittance_image, at, vec4(1.0));
#ifdef WITH_PER_LIGHT
  for (int k = first; k < end; ++k) imageStore(per_light_image, ivec3(at.xy, k), vec4(0.0));
#endif
#ifdef WITH_OPTICAL_DEPTH
  imageStore(optical_depth_image, at, vec4(0.0));
#endif
  return true;
}
