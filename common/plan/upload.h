// Uploads of tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/plan/plan.h"

namespace airlight {

// `make`: gives the table as a vector of floats, when it is wanted.
template <class Make>
Plan::Upload table_upload(Buffer buffer, std::uint64_t key, Make make) {
  return {buffer, key, [make = std::move(make)] {
            const std::vector<float>& values = make();
            const auto bytes = std::as_bytes(std::span(values));
            return std::vector<std::byte>(bytes.begin(), bytes.end());
          }};
}

}  // namespace airlight
