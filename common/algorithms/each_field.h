// What a step makes and reads, without a list of it.
#pragma once

#include <type_traits>
#include <variant>
#include <vector>

#include "common/algorithms/algorithm.h"

namespace airlight {

// visit(made) for each image (or buffer) that is made, in order of the fields; visit(handle) for each input.
template <class Made, class Visit>
void each_made(const Algorithm& a, Visit&& visit) {
  std::visit(
      [&](const auto& x) {
        x.fields(x, [&](const Field& field, const auto& value) {
          if constexpr (std::is_same_v<Made, std::remove_cvref_t<decltype(value)>>) {
            if (field.role == Role::output && value) visit(value);
          }
        });
      },
      a);
}
template <class Visit>
void each_input(const Algorithm& a, Visit&& visit) {
  std::visit(
      [&](const auto& x) {
        x.fields(x, [&](const Field& field, const auto& value) {
          using Value = std::remove_cvref_t<decltype(value)>;
          if (field.role != Role::input) return;
          if constexpr (std::is_base_of_v<Handle, Value>) {
            if (value) visit(Handle(value));
          } else if constexpr (std::is_same_v<std::vector<Buffer>, Value>) {
            for (const Buffer& b : value) visit(Handle(b));
          }
        });
      },
      a);
}

}  // namespace airlight
