#include "tests/parity/case.h"

namespace airlight {

std::vector<NamedCase> all_cases() {
  std::vector<NamedCase> all;
  for (const auto list : {surface_visibility_cases(), view_transmittance_cases(), surface_shading_cases(),
                          homogeneous_airlight_cases(), compose_cases(), frame_cases()}) {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

void upload(Backend& backend, const Case& c) {
  std::uint64_t key = 1;  // any that differ: a case's backend sees no other content under its handles
  for (const auto& [buffer, bytes] : c.buffers) backend.upload(buffer, bytes, key++);
  for (const auto& [image, values] : c.images) backend.upload(image, values, key++);
}

std::vector<float> download(Backend& backend, const Image& image) {
  std::vector<float> values(image.floats());
  backend.download(image, values);
  return values;
}

}  // namespace airlight
