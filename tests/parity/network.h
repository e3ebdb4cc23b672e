// Illumination networks for the parity cases and the tests of their steps.
#pragma once

#include "common/plan/network.h"
#include "tests/parity/medium.h"

namespace airlight {

struct TestNetwork {
  VisibilityNetwork network;
  ParticleLight light;
  NetworkIteration iteration;
  SourceFunction source;
};

struct NetworkParts {
  int particles = 500, lines = 12, window = 8;
  Phase phase = {};
  float extinction = 0.1F;
  float tolerance = 1e-6F;
  int iterations = 300;
  DirectionSet set = DirectionSet::fibonacci;
  ParticleSet particle_set = ParticleSet::sampled;  // of Gaussians, as many as there are
  bool gradients = false;
  bool sparse = false;  // nodes as a plan has them, not one box
};

// All four steps for the scene's medium under these lights and its environment; their inputs become buffers 1 to 3 and 9 of the
// case, their outputs 4 to 8.
TestNetwork test_network(Case&, const Scene&, const std::vector<LightSource>&, const NetworkParts&);
// Two Gaussians of that albedo, unlike in radius and extinction.
Scene two_gaussians(double albedo);
// An uneven sky, turned, with a pixel that is brighter than all others.
Environment network_environment();
// Two small Gaussians far apart in a slanting direction.
Scene far_gaussians();
// A point light in the medium of test_gaussian_scene() and a directional one.
std::vector<LightSource> network_lights();

}  // namespace airlight
