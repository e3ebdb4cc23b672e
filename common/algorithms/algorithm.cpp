#include "common/algorithms/algorithm.h"

namespace airlight {

std::string_view name_of(const Algorithm& a) {
  return std::visit([](const auto& x) { return x.name; }, a);
}

Domain domain_of(const Algorithm& a) {
  return std::visit([](const auto& x) { return x.domain; }, a);
}

std::vector<Handle> inputs_of(const Algorithm& a) {
  std::vector<Handle> found;
  std::visit(
      [&](const auto& x) {
        x.fields(x, [&](const Field& field, const auto& value) {
          if constexpr (std::is_base_of_v<Handle, std::remove_cvref_t<decltype(value)>>) {
            if (field.role == Role::input && value) found.push_back(value);
          }
        });
      },
      a);
  return found;
}

std::vector<Image> outputs_of(const Algorithm& a) {
  std::vector<Image> found;
  std::visit(
      [&](const auto& x) {
        x.fields(x, [&](const Field& field, const auto& value) {
          if constexpr (std::is_same_v<Image, std::remove_cvref_t<decltype(value)>>) {
            if (field.role == Role::output && value) found.push_back(value);
          }
        });
      },
      a);
  return found;
}

}  // namespace airlight
