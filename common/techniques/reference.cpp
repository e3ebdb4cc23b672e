#include "common/techniques/reference.h"

#include "common/plan/frame.h"
#include "common/plan/ray_noise.h"

namespace airlight {

namespace {

Knob exact_indirect_knob() {
  Knob knob = indirect_knob();
  knob.choices.push_back("exact");
  knob.meaning =
      "light scattered once on its way to surfaces: of an unbounded homogeneous medium without shadows, as techniques render it, "
      "or "
      "of what there is (seconds a pixel)";
  return knob;
}

}  // namespace

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
      exact_indirect_knob(),
      {.name = "indirect_tolerance",
       .kind = Knob::Kind::number,
       .standard = "1e-3",
       .least = 1e-6,
       .most = 1e-1,
       .choices = {},
       .meaning = "relative error of what indirect=exact brings to a pixel from each light",
       .sweep = {}},
  };
  t.refuses = refuses_noise;
  return t;
}

}  // namespace airlight
