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
      number_knob("tolerance", "1e-7", 1e-12, 1e-2, "relative error of each pixel's integrals", {"1e-3", "1e-5", "1e-7"}),
      choice_knob("shadows", {"on", "off"}, "whether surfaces cast shadows on each other and into the medium"),
      environment_shadows_knob(),
      exact_indirect_knob(),
      number_knob("indirect_tolerance", "1e-3", 1e-6, 1e-1,
                  "relative error of what indirect=exact brings to a pixel from each light"),
      integer_knob("max_bounces", "1", 1, 1000000,
                   "how often the medium scatters light at most on its way to the camera: those orders above 1 by random paths "
                   "without bias, which surfaces block and end; a million is as good as all"),
      integer_knob("paths", "256", 2, 1000000000,
                   "random paths a pixel; the image standard_error tells how far their mean is known"),
      choice_knob("single_scattering", {"quadrature", "paths"}, "how the first order is found"),
      integer_knob("seed", "0", 0, 4294967295, "of the random paths: another one gives others"),
  };
  t.own_images = {"standard_error"};
  t.refuses = refuses_noise;
  return t;
}

}  // namespace airlight
