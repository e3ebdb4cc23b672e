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
          using Value = std::remove_cvref_t<decltype(value)>;
          if (field.role != Role::input) return;
          if constexpr (std::is_base_of_v<Handle, Value>) {
            if (value) found.push_back(value);
          } else if constexpr (std::is_same_v<std::vector<Buffer>, Value>) {
            found.insert(found.end(), value.begin(), value.end());
          }
        });
      },
      a);
  return found;
}

namespace {

template <class Made>
std::vector<Made> made_by(const Algorithm& a) {
  std::vector<Made> found;
  std::visit(
      [&](const auto& x) {
        x.fields(x, [&](const Field& field, const auto& value) {
          if constexpr (std::is_same_v<Made, std::remove_cvref_t<decltype(value)>>) {
            if (field.role == Role::output && value) found.push_back(value);
          }
        });
      },
      a);
  return found;
}

}  // namespace

std::vector<Image> outputs_of(const Algorithm& a) { return made_by<Image>(a); }
std::vector<Buffer> buffers_made_by(const Algorithm& a) { return made_by<Buffer>(a); }

}  // namespace airlight
