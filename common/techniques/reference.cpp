#include "common/techniques/reference.h"

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
      {.name = "indirect",
       .kind = Knob::Kind::choice,
       .standard = "unbounded",
       .least = 0,
       .most = 0,
       .choices = {"unbounded", "off"},
       .meaning = "light scattered once on its way to surfaces, as of an unbounded homogeneous medium without shadows",
       .sweep = {}},
  };
  t.refuses = [](const Scene&) { return std::optional<std::string>(); };
  return t;
}

}  // namespace airlight
