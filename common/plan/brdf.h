// Tabulated reflectances as the kernels take them (common/formulas/brdf.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

// A scene's reflectances, each once, and for each surface the number of its own, -1 where it has none.
struct SceneBrdfs {
  std::vector<std::shared_ptr<const Brdf>> all;
  std::vector<int> of_surface;
  std::uint64_t key = 0;  // of all that is in their tables

  // The surfaces' materials, for those who ask the tables: where there is one, without the Phong lobe, which it stands for.
  std::vector<Material> without_lobes(std::vector<Material>) const;
};
SceneBrdfs brdfs_of(const Scene&);

// The table of brdf_reflection(), for many one after another; brdf_places() tells where each begins, and throws InputError beyond
// 2^30 values in all.
std::vector<float> brdf_tables(std::span<const std::shared_ptr<const Brdf>>);
std::vector<int> brdf_places(std::span<const std::shared_ptr<const Brdf>>);

// The `lobes` of brdf_environment(): the reflectance times the cosine projected onto harmonics of order 6 for each viewing
// angle, by the reflectance's own cells of the half vector, those of theta_half cut where there are few.
std::vector<float> brdf_lobes(const Brdf&);

}  // namespace airlight
