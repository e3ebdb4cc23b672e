// Conjugate gradients for light that goes among particles and scatters evenly (NetworkIteration).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace airlight {

// The sources x of one channel are x = first + M x, M = diag(share albedo) T, T what particles take of what particles send. T is
// symmetric: it is the mean over both ways along lists, of which a link takes of another as much as that one of it. So M is
// symmetric in the inner product <x, y> = sum of x y / (share albedo), and its eigenvalues lie between 0, for it sums up
// exp(-|t - t'|) over links, and 1, for no light is made. Particles that scatter nothing have their first sources and take no
// part. Each channel is a system of its own; one sweep serves all three. Sums are made in double, one particle after the other.
class Gradients {
 public:
  // first: rgb and an unused float a particle. albedo: three planes. share: 1 over half of all that a particle could take.
  Gradients(std::span<const float> first, std::span<const float> albedo, std::span<const float> share);

  // What is swept next, rgb and an unused float a particle: the first sources, under a sky if there is one; then ways in which
  // sources change, which know no sky.
  std::span<const float> way() const { return way_; }
  // What particles took of it, laid out alike, both ways along all lines.
  void take(std::span<const float> taken);

  // Of the sources as finish() gives them: what another round of plain scattering changed last, beside their sum.
  double change() const { return change_; }
  // How much more light particles would send after all further rounds, at most, beside what they send: of each the source times
  // all that it could take. See gradients.cpp.
  double left_out() const { return left_out_; }

  // Sources after a plain round with what is known, never below the first ones: rgb and an unused float a particle.
  void finish(std::span<float> sources) const;

 private:
  struct Channel {
    double most_albedo = 0;
    double albedos = 0;   // squared norm of the particles' albedos in the inner product
    double residual = 0;  // that of what a plain round would change
    std::vector<double> steps, turns;

    double smallest_eigenvalue() const;
    double left_out() const;
  };

  void begin(std::span<const float> taken);
  void step(std::span<const float> taken);
  void measure();

  std::size_t particles_;
  std::vector<float> first_, way_;
  std::vector<double> share_;                                       // a particle
  std::vector<double> factor_, source_, residual_, change_of_way_;  // of a channel and a particle
  std::array<Channel, 3> channels_;
  bool begun_ = false;
  double change_ = 0, left_out_ = 0;
};

}  // namespace airlight
