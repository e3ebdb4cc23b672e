#include "common/techniques/reference.h"

#include "common/plan/frame.h"
#include "common/plan/ray_noise.h"

namespace airlight {

Technique reference_technique() {
  Technique t;
  t.name = "reference";
  t.summary = "ground truth: double precision, adaptive quadrature, exact visibility; slow";
  t.knobs = {
      {.name = "tolerance",
       .kind = Knob::Kind::number,
       .standard = "1e-7",
       .least = 1e-12,
       .most = 1e-2,
       .choices = {},
       .meaning = "relative error of each pixel's integrals",
       .sweep = {"1e-3", "1e-5", "1e-7"}},
      {.name = "shadows",
       .kind = Knob::Kind::choice,
       .standard = "on",
       .choices = {"on", "off"},
       .meaning = "whether surfaces cast shadows on each other and into the medium",
       .sweep = {}},
      indirect_knob(),
  };
  t.refuses = refuses_noise;
  return t;
}

}  // namespace airlight
