#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Case fog(Extent extent, float extinction, float sky_distance) {
  Case c;
  const TestSurfaces surfaces = sphere_on_plane(test_view(extent), 1);
  add_to(c, surfaces);
  const Image transmittance{{5}, Format::r32f, extent, 1, true}, depth{{6}, Format::r32f, extent, 1, true};
  c.steps = {{ViewTransmittance{surfaces.distance, extinction, sky_distance, transmittance, depth}, ""}};
  c.results = {{"transmittance", transmittance}, {"optical_depth", depth}};
  return c;
}

Case thin(Extent e) { return fog(e, 0.02F, 1e30F); }
Case dense(Extent e) { return fog(e, 8, 200); }
Case none(Extent e) { return fog(e, 0, 1e30F); }

}  // namespace

std::span<const NamedCase> view_transmittance_cases() {
  static constexpr NamedCase cases[] = {{"view_transmittance/thin_fog_infinite_sky", thin},
                                        {"view_transmittance/dense_fog_finite_sky", dense},
                                        {"view_transmittance/no_fog", none}};
  return cases;
}

}  // namespace airlight
