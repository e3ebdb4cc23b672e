// How a hand moves the camera.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/scene/scene.h"

namespace airlight {

// About what it looks at, by angles [rad] to the right and up; never over the poles of `up`.
Camera orbited(Camera, const glm::dvec2& angles);
// About its own place.
Camera turned(Camera, const glm::dvec2& angles);
// By halves of the screen's height at the depth of what it looks at.
Camera panned(Camera, const glm::dvec2& by);
// `factor` times as far from what it looks at.
Camera dollied(Camera, double factor);
// Right, up and forward [m]; what it looks at goes with it.
Camera moved(Camera, const glm::dvec3& by);

// So far away, in its own direction, that all that matters is seen: casters and Gaussians, other surfaces and point lights where
// there are none.
Camera framing(const Scene&, double aspect);

}  // namespace airlight
