// How the rays of a small square of the screen are cut where they run through Gaussians: panels in which everything along the ray
// is smooth, each with the few Gaussians that matter there. Only + - * / and square roots: the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "common/algorithms/gaussian_airlight.h"
#include "common/plan/gauss_legendre.h"

namespace airlight {

constexpr int bin_side = 16;  // pixels of a square; quarters of it and theirs where small Gaussians crowd it

// Whether anything along rays through these Gaussians, or through all that there are, is lit or glows; else depths are all that
// is asked for.
bool shines(const GaussianAirlight&, std::span<const std::uint32_t> met);
bool shines(const GaussianAirlight&);

// The panels of one square, in order along the rays; none where nothing is lit and nothing glows.
class GaussianPanels {
 public:
  struct Range {  // of indices()
    std::uint32_t begin = 0, end = 0;
  };
  // A light, seen from one panel.
  struct Shade {
    Range shading;        // Gaussians that may stand between it and the panel; empty where volumes hold the depths
    bool shaded = false;  // something may stand there
    std::uint32_t levels =
        0;  // > 0: it is so near that the panel is cut at its foot and at length / cut_ratio^1..levels to both sides
  };
  struct Panel {
    float begin = 0, end = 0;  // [m] along the rays
    Range active;              // which of met() rays may meet within
    Range passed;              // which were active before and are no more
    std::uint32_t shades = 0;  // the first of its Shades, one a light
    int samples = 0;  // how many nodes it has: fewer than the algorithm's where it is short, or where many Gaussians share
                      // in what is seen, so that their errors cancel; 0: every light has the closed form
  };
  // What of indices() belongs to a Shade is a Gaussian's number, with this bit where the light stands within its reach.
  static constexpr std::uint32_t around_light = 1U << 31U;
  static constexpr int most_cuts = 96;  // of a panel, over all lights
  static constexpr float cut_ratio = 3;

  GaussianPanels();
  explicit GaussianPanels(const GaussianAirlight& a) : GaussianPanels() { begin(a); }
  ~GaussianPanels();

  // What is made from here on is of this algorithm, which must outlive it; memory is kept.
  void begin(const GaussianAirlight&);

  // For the square whose upper left pixel is (x, y). What was held before is forgotten. Squares of a neighbourhood, one after the
  // other, look through its Gaussians alone. False where the lists are so long that quarters of the square, whose rays meet fewer
  // Gaussians each, are less to do: what is held then is of no use.
  bool make(int x, int y, int side = bin_side);

  // The same for the square or as many of its parts as it takes: use(x, y, side) after each.
  template <class Use>
  void each(int x, int y, int side, Use&& use) {
    if (make(x, y, side)) return use(x, y, side);
    const int half = side / 2;
    for (const int down : {0, half}) {
      for (const int across : {0, half}) each(x + across, y + down, half, use);
    }
  }

  std::span<const Panel> panels() const { return panels_; }
  std::span<const Shade> shades() const { return shades_; }
  std::span<const std::uint32_t> indices() const { return indices_; }
  // All Gaussians that rays of the square may meet, ascending.
  std::span<const std::uint32_t> met() const { return met_; }
  // What a panel shows without sampling: no Gaussian within, none before this light.
  static bool closed_form(const Panel& p, const Shade& s) { return p.active.begin == p.active.end && !s.shaded; }

 private:
  struct Met;  // a Gaussian as the cone of the square's rays meets it
  struct Build;
  struct Neighbourhood;
  bool quarters_meet_fewer(int x, int y, int side) const;

  const GaussianAirlight* algorithm_ = nullptr;
  std::unique_ptr<Neighbourhood> near_;
  std::vector<Panel> panels_;
  std::vector<Shade> shades_;
  std::vector<std::uint32_t> indices_, met_;
};

}  // namespace airlight
