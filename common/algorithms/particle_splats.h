#pragma once

#include <cmath>
#include <cstddef>

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"
#include "common/image.h"

namespace airlight {

// A splat of the buffer `splats`, floats: where its particle is [m] from the camera, 1 / support [1/m], the optical depth at its
// middle, and which particle it is (common/formulas/splats.h tells what the middle ones mean). Splats stand in order of distance.
enum SplatField : int { splat_center = 0, splat_inverse_support = 3, splat_peak = 4, splat_particle = 5, splat_fields = 8 };

// The particles of an illumination network, sorted and splatted with alpha blending, as Szirmay-Kalos et al. 2005 publish it
// (3.3): from the nearest on, each hides what is behind it by the opacity of its splat on the ray, and adds what it sends toward
// the camera as much as it hides. What it sends, all orders of scattering and emission together, is interpolated between the
// directions that the network has; each splat sends its light from its middle, and is cut where a surface or the camera is in it.
// Once less than `least_seen` is to be seen of what comes, it is left out. A baseline beside SourceFunction and RayMarch.
struct ParticleSplats {
  Image distance;           // r32f [m], 1e30 on a miss
  Image scattered;          // rgb32f, airlight of the homogeneous part as it arrives, which is added; optional
  Buffer lines;             // common/algorithms/network.h; read where sources differ by direction
  Buffer particle_sources;  // as NetworkIteration's
  Buffer splats;            // particle_count times splat_fields floats
  Buffer bins;              // which splats the squares of the screen meet (common/plan/gaussian_bins.h), nearest first
  View view;
  Phase phase;
  int particle_count = 1, line_count = 1;
  bool random_directions = false;  // not evenly spread ones
  float extinction = 0;            // [1/m] of the homogeneous part, which attenuates them
  float sky_distance = 1e30F;      // [m]; 1e30 and above stand for infinity
  glm::vec3 ambient{0, 0, 0};      // [W/m^2/sr] source radiance L_a of the particles

  Image airlight;       // rgb32f
  Image transmittance;  // r32f, 0..1
  Image optical_depth;  // r32f, optional; 1e30 where it is infinite

  static constexpr float least_seen = 4.5e-5F;  // about exp(-10)

  int directions() const { return phase.kind == PhaseKind::isotropic ? 1 : 2 * line_count; }
  // 1 / the reach of direction_weight(): half as far again as directions lie apart, so that some are always within it; three
  // times as far where they lie at random, where 28 are within it in the mean. 0.188: 1 / (1.5 sqrt(4 pi)).
  float inverse_reach() const { return std::sqrt(static_cast<float>(directions())) * (random_directions ? 0.094F : 0.188F); }

  static constexpr std::string_view name = "particle_splats";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("scattered", "W/m^2/sr"), s.scattered);
    v(in("lines"), s.lines);
    v(in("particle_sources", "W/m^2/sr"), s.particle_sources);
    v(in("splats"), s.splats);
    v(in("bins"), s.bins);
    v(knob("view"), s.view);
    v(knob("phase"), s.phase);
    v(knob("particle_count"), s.particle_count);
    v(knob("line_count"), s.line_count);
    v(knob("random_directions"), s.random_directions);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("sky_distance", "m"), s.sky_distance);
    v(knob("ambient", "W/m^2/sr"), s.ambient);
    v(out("airlight", "W/m^2/sr"), s.airlight);
    v(out("transmittance"), s.transmittance);
    v(out("optical_depth"), s.optical_depth);
  }
};

}  // namespace airlight
