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

// [byte] at most of all that a plan uploads, before anything of it is made.
inline std::uint64_t bytes_of_uploads(const Plan& plan) {
  std::uint64_t bytes = 0;
  for (const Plan::Upload& upload : plan.uploads) bytes += upload.most ? upload.most() : upload.buffer.bytes;
  return bytes;
}

// And what of that is known at once.
inline std::uint64_t least_bytes_of_uploads(const Plan& plan) {
  std::uint64_t bytes = 0;
  for (const Plan::Upload& upload : plan.uploads) bytes += upload.most ? 0 : upload.buffer.bytes;
  return bytes;
}

}  // namespace airlight
