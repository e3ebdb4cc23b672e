#include "common/techniques/reference.h"

#include "common/plan/frame.h"
#include "common/plan/ray_noise.h"

namespace airlight {

namespace {

Knob exact_indirect_knob() {
  Knob knob = indirect_knob();
  knob.choices = {"unbounded", "off", "exact"};
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
  t.summary = "ground truth: double precision, adaptive quadrature, exact visibility, random paths for multiple scattering; slow";
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
      environment_shadows_knob(),
      exact_indirect_knob(),
      {.name = "indirect_tolerance",
       .kind = Knob::Kind::number,
       .standard = "1e-3",
       .least = 1e-6,
       .most = 1e-1,
       .choices = {},
       .meaning = "relative error of what indirect=exact brings to a pixel from each light",
       .sweep = {}},
      {.name = "max_bounces",
       .kind = Knob::Kind::integer,
       .standard = "1",
       .least = 1,
       .most = 1000000,
       .choices = {},
       .meaning =
           "how often the medium scatters light at most on its way to the camera: those orders above 1 by random paths without "
           "bias, which surfaces block and end; a million is as good as all",
       .sweep = {}},
      {.name = "paths",
       .kind = Knob::Kind::integer,
       .standard = "256",
       .least = 2,
       .most = 1000000000,
       .choices = {},
       .meaning = "random paths a pixel; the image standard_error tells how far their mean is known",
       .sweep = {}},
      {.name = "single_scattering",
       .kind = Knob::Kind::choice,
       .standard = "quadrature",
       .choices = {"quadrature", "paths"},
       .meaning = "how the first order is found",
       .sweep = {}},
      {.name = "seed",
       .kind = Knob::Kind::integer,
       .standard = "0",
       .least = 0,
       .most = 4294967295,
       .choices = {},
       .meaning = "of the random paths: another one gives others",
       .sweep = {}},
  };
  t.own_images = {"standard_error"};
  t.refuses = refuses_noise;
  return t;
}

}  // namespace airlight
