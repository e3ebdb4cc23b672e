#include "common/algorithms/algorithm.h"

#include "common/algorithms/each_field.h"

namespace airlight {

std::string_view name_of(const Algorithm& a) {
  return std::visit([](const auto& x) { return x.name; }, a);
}

Domain domain_of(const Algorithm& a) {
  return std::visit([](const auto& x) { return x.domain; }, a);
}

std::vector<Handle> inputs_of(const Algorithm& a) {
  std::vector<Handle> found;
  each_input(a, [&](Handle input) { found.push_back(input); });
  return found;
}

std::vector<Image> outputs_of(const Algorithm& a) {
  std::vector<Image> found;
  each_made<Image>(a, [&](const Image& image) { found.push_back(image); });
  return found;
}

std::vector<Buffer> buffers_made_by(const Algorithm& a) {
  std::vector<Buffer> found;
  each_made<Buffer>(a, [&](const Buffer& buffer) { found.push_back(buffer); });
  return found;
}

}  // namespace airlight
