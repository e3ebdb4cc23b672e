// The design tools of Zhou et al. 2007, section 6, on a list of Gaussians. Deterministic: random numbers are functions of an
// edit's seed and of a particle's number, and what is computed from them is + - * / and square roots, so that the same edits give
// the same bits on every machine. All throw InputError for what would be more than `most_gaussians`, or take too long.
#pragma once

#include <cstddef>
#include <vector>

#include "common/design/collisions.h"
#include "common/design/edits.h"
#include "common/design/screen.h"
#include "common/scene/scene.h"

namespace airlight {

inline constexpr std::size_t most_gaussians = 1'000'000;  // of a scene

std::vector<Gaussian> painted(const PaintEdit&, const Screen&, const Medium&);
std::vector<Gaussian> airbrushed(const AirbrushEdit&, const Collisions&, const Medium&);
// `later`: seconds after the edit's time.
std::vector<Gaussian> emitted(const EmitEdit&, double later, const Medium&);

// What is left; returns how many were covered.
std::size_t erase(const EraseEdit&, const Screen&, std::vector<Gaussian>&);

bool covers(const ScreenRectangle&, const Screen&, const glm::dvec3& center);

// [m] between a point and a line of one or more points.
double distance_to_line(const glm::dvec3& p, const std::vector<glm::dvec3>& line);

// Throws InputError where one more than most_gaussians would be asked for.
void check_count(double gaussians, const char* what);

// What a puff is in a medium.
Gaussian gaussian_of(const Puff&, const glm::dvec3& center, const Medium&);

}  // namespace airlight
