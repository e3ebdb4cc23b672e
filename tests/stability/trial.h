// One hostile scene rendered by one technique in every way that must agree, and held to the truth.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/airlight.h"
#include "common/techniques/choose.h"

namespace airlight {

// What renders the scene of a number: technique and settings are drawn as well, of those that take the scene.
struct Asked {
  std::string technique;
  Settings settings;
  std::vector<std::string> images;
  std::string text() const;  // "marching steps=32"
};
Asked asked_of(const Scene&, std::uint32_t number);

struct TrialOptions {
  bool gl = true;         // also on OpenGL
  int truth_pixels = 24;  // of the picture, 0: none
  double seconds = 0;     // that the truth may take; 0: no clock, and scenes that look long are left out
};

struct Trial {
  std::string refused;                // the InputError with which settings are refused, if they are
  std::vector<std::string> failures;  // one line each
  double gl_apart = 0;  // CPU and GL: largest difference of beauty off edges beside the larger of the two and the picture's mean
  bool truth = false;   // error and promise below are known
  double error = 0, promise = 0;  // relative RMSE of the pixels looked at, and what the technique's estimate says
  std::string why_no_truth;
};

class Trials {
 public:
  Trials();
  Trial run(const Scene&, const Asked&, std::uint32_t number, const TrialOptions&);

 private:
  void compare_gl(const Scene&, const RenderSettings&, const Frame& cpu, Trial&);
  Renderer scalar_, vector_;
  std::optional<Renderer> gl_;
};

}  // namespace airlight
