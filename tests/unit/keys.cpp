// What makes a step stale, and nothing else.
#include "common/plan/keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "common/algorithms/algorithm.h"

namespace airlight {

namespace {

constexpr Extent extent{8, 4};

struct Chain {  // a: distance -> transmittance; b: with the surface -> beauty
  Image distance{{1}, Format::r32f, extent, 1, false};
  Image transmittance{{2}, Format::r32f, extent, 1, true};
  Image surface{{3}, Format::rgb32f, extent, 1, false};
  Image airlight{{4}, Format::rgb32f, extent, 1, false};
  Image beauty{{5}, Format::rgb32f, extent, 1, true};
  float extinction = 0.1F;

  std::vector<Step> steps() const {
    return {{ViewTransmittance{distance, extinction, 1e30F, transmittance, {}}, ""},
            {SurfaceShading{.distance = distance,
                            .normal = surface,
                            .material = distance,
                            .transmittance = transmittance,
                            .light_transmittance = {},
                            .indirect = {},
                            .environment = {},
                            .brdfs = {},
                            .materials = {},
                            .brdf = {},
                            .brdf_at = {},
                            .lights = {},
                            .view = {},
                            .surface = airlight,
                            .surface_direct = {},
                            .surface_ambient = {}},
             ""},
            {Compose{surface, airlight, beauty}, ""}};
  }
};

std::vector<std::uint64_t> keys_of(const Chain& chain, std::uint64_t surface_key = 7) {
  return step_keys(chain.steps(), [=](Handle h) { return h.id == 3 ? surface_key : h.id; });
}

TEST(Keys, SameStepsHaveTheSameKeys) { EXPECT_EQ(keys_of({}), keys_of({})); }

TEST(Keys, AKnobChangesItsStepAndWhatReadsIt) {
  Chain other;
  other.extinction = std::nextafter(other.extinction, 1.0F);
  const auto a = keys_of({}), b = keys_of(other);
  EXPECT_NE(a[0], b[0]);
  EXPECT_NE(a[1], b[1]);  // reads the transmittance
  EXPECT_NE(a[2], b[2]);  // reads what that made
}

TEST(Keys, AnInputChangesOnlyItsReaders) {
  const auto a = keys_of({}), b = keys_of({}, 8);
  EXPECT_EQ(a[0], b[0]);
  EXPECT_NE(a[1], b[1]);
  EXPECT_NE(a[2], b[2]);
}

TEST(Keys, NegativeZeroIsZero) {
  Chain plus, minus;
  plus.extinction = 0.0F;
  minus.extinction = -0.0F;
  EXPECT_EQ(keys_of(plus), keys_of(minus));
}

TEST(Keys, OnlyStaleStepsRunAndWhatTheyNeed) {
  const Chain chain;
  const auto steps = chain.steps();
  const auto keys = keys_of(chain);
  const auto run = [&](bool beauty, bool transmittance) {
    return steps_to_run(steps, keys, [=](Handle made, std::uint64_t) { return made.id == 5 ? beauty : transmittance; });
  };
  EXPECT_EQ(run(true, true), (std::vector{false, false, false}));
  EXPECT_EQ(run(false, true), (std::vector{false, true, true}));
  EXPECT_EQ(run(true, false), (std::vector{true, false, false}));
  EXPECT_EQ(run(false, false), (std::vector{true, true, true}));
}

TEST(Keys, AnInputThatNobodyMadeIsAnError) {
  EXPECT_THROW(step_keys(Chain().steps(), [](Handle) -> std::uint64_t { throw std::logic_error("unknown"); }), std::logic_error);
}

}  // namespace

}  // namespace airlight
