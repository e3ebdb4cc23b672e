#include "common/scene/brdf_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "common/error.h"
#include "common/scene/brdf.h"
#include "common/scene/files.h"
#include "common/scene/sha256.h"

namespace airlight {

namespace {

constexpr std::size_t header_bytes = 12;
constexpr std::array scale{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
constexpr double most_reflectance = 1e6;  // [1/sr]

// Little-endian on every machine.
template <class Integer>
Integer integer_at(std::string_view bytes, std::size_t at) {
  Integer value = 0;
  for (std::size_t k = 0; k < sizeof(Integer); ++k)
    value |= static_cast<Integer>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  return value;
}

// Checks the size before anything is allocated for it.
glm::ivec3 size_of(const std::string& path, std::string_view bytes) {
  if (bytes.size() < header_bytes)
    throw InputError(fmt::format("{}: {} bytes, expected a header of {}", path, bytes.size(), header_bytes));
  std::array<std::int64_t, 3> cells{};
  for (std::size_t k = 0; k < 3; ++k) cells[k] = static_cast<std::int32_t>(integer_at<std::uint32_t>(bytes, 4 * k));
  for (const std::int64_t n : cells) {
    if (n < 2 || n > most_brdf_cells) {
      throw InputError(
          fmt::format("{}: {} x {} x {} cells, expected 2 to {} an axis", path, cells[0], cells[1], cells[2], most_brdf_cells));
    }
  }
  const std::int64_t values = cells[0] * cells[1] * cells[2];
  if (values > most_brdf_values) {
    throw InputError(
        fmt::format("{}: {} x {} x {} cells, expected at most {} in all", path, cells[0], cells[1], cells[2], most_brdf_values));
  }
  const std::uint64_t expected = header_bytes + static_cast<std::uint64_t>(values) * 3 * sizeof(double);
  if (bytes.size() != expected) {
    throw InputError(fmt::format("{}: {} bytes, expected {} for {} x {} x {} cells", path, bytes.size(), expected, cells[0],
                                 cells[1], cells[2]));
  }
  return {static_cast<int>(cells[0]), static_cast<int>(cells[1]), static_cast<int>(cells[2])};
}

std::shared_ptr<const Brdf> values_of(const std::string& path, std::string_view bytes, const glm::ivec3& size) {
  auto brdf = std::make_shared<Brdf>();
  brdf->size = size;
  const auto phis = static_cast<std::size_t>(size.z), differences = static_cast<std::size_t>(size.y);
  const std::size_t colour = static_cast<std::size_t>(size.x) * differences * phis;
  brdf->values.resize(3 * colour);
  for (std::size_t i = 0; i < brdf->values.size(); ++i) {
    const double value = std::bit_cast<double>(integer_at<std::uint64_t>(bytes, header_bytes + i * sizeof(double)));
    const double reflectance = value * scale[i / colour];
    const std::size_t cell = i % colour, difference = cell / phis % differences;
    if (!std::isfinite(value) || reflectance > most_reflectance) {
      throw InputError(fmt::format("{}: {} /sr in {} of cell {}, {}, {}, expected a finite number of at most {} /sr", path,
                                   reflectance, std::array{"red", "green", "blue"}[i / colour], cell / phis / differences,
                                   difference, cell % phis, most_reflectance));
    }
    if (value >= 0) {
      brdf->values[i] = static_cast<float>(reflectance);
    } else if (difference > 0) {
      brdf->values[i] = brdf->values[i - phis];
    }
  }
  return brdf;
}

}  // namespace

BrdfFile read_brdf_file(const std::string& path) {
  const std::string bytes = read_file(path, header_bytes + std::uint64_t{3} * most_brdf_values * sizeof(double));
  BrdfFile file;
  file.brdf = values_of(path, bytes, size_of(path, bytes));
  file.material = brdf_material(*file.brdf);
  Sha256 hash;
  hash.add(bytes);
  file.content_hash = hash.hex();
  return file;
}

}  // namespace airlight
