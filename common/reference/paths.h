// Multiple scattering by random paths in double, without bias.
//
// What is transported: light of the lamps that the medium scatters n times, n = 1..max_bounces, the last time toward the camera;
// what Gaussians emit, scattered fewer than max_bounces times but at least once, for the rest is no matter of paths; and light of
// an environment, which arrives unattenuated by the homogeneous part and is hidden by nothing. Surfaces that cast
// shadows end paths and block lights, black on this account: light that they reflect into the medium and light that the medium
// scatters more than once onto them are not in it, nor is scattered ambient or what the homogeneous part emits.
//
// A path starts along the view ray; at each vertex it goes on by the phase function. The free flight is drawn by inverting the
// exact optical depth (LineInMedium::place()), given that it ends in the medium, whose probability is the path's weight. What a
// flight's line scatters of a lamp is estimated at the flight's end or, half the time, at a place that is drawn evenly in the
// angle at the lamp (Kulla and Fajardo: Importance sampling techniques for path tracing in participating media, 2012,
// section 3.1), weighed by the balance heuristic (Veach 1997, section 9.2.2): without it 1/r^2 has no bounded variance.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/progress.h"
#include "common/random.h"
#include "common/reference/environment.h"
#include "common/reference/line.h"
#include "common/reference/visibility.h"

namespace airlight {

struct PathSettings {
  int max_bounces = 1;     // >= 1
  int paths = 256;         // a pixel, >= 2
  bool single = false;     // whether the first order is in it
  bool shadows = true;     // off: surfaces neither block lights nor end paths
  std::uint32_t seed = 0;  // another one gives other paths
};

// Means over a pixel's paths [W/m^2/sr].
struct PathEstimate {
  std::vector<glm::dvec3> of_light;
  glm::dvec3 of_others{0};       // the environment, and what Gaussians emit
  glm::dvec3 standard_error{0};  // of their sum
};

class Paths {
 public:
  // All must outlive this. Lights of no power are given to keep the order; without an environment it is null.
  Paths(const RelativeMedium&, const Visibility&, const std::vector<RelativeLight>&, const EnvironmentLighting*,
        const PathSettings&);

  // The light that arrives along a line from the camera. `at` names the stream of random numbers, a pixel's place in the image.
  // Throws Interrupted when `stop` (may be null) asks for it.
  PathEstimate along(const LineInMedium&, const glm::dvec2& at, const Progress* stop) const;

 private:
  struct Vertex {
    double t = 0;           // [m] along the line
    double extinction = 0;  // [1/m]
    glm::dvec3 scattering{0};
    double met = 0;  // probability that a flight along the line ends in the medium
  };
  void walk(const LineInMedium&, Random&, std::vector<glm::dvec3>& of_light, glm::dvec3& of_others) const;
  glm::dvec3 scattered_environment(const LineInMedium&, double t, Random&) const;
  Vertex free_flight(const LineInMedium&, Random&) const;
  glm::dvec3 scattered(const LineInMedium&, const Vertex&, const RelativeLight&, Random&) const;
  glm::dvec3 scattered_at(const LineInMedium&, double t, const glm::dvec3& scattering, const RelativeLight&) const;
  double importance(const glm::dvec3& point) const;

  const RelativeMedium& medium_;
  const Visibility& visibility_;
  const std::vector<RelativeLight>& lights_;
  const EnvironmentLighting* environment_;
  PathSettings settings_;
  std::vector<glm::dvec3> begins_;  // where light does: point lights, and the middle of what glows
  double near_ = 0;                 // [m] of importance(); infinite where it is 1
};

}  // namespace airlight
