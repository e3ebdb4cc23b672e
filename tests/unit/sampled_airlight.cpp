// Airlight of few pixels and what is between them: what DepthAwareUpsample may do, what a plan makes of the knob, what it leaves
// alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/airlight.h"
#include "common/techniques/technique.h"
#include "cpu/backend.h"
#include "gpu/backend.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

// Samples of a scene that is told by functions of the pixel, and what is made of them.
struct Pictures {
  std::vector<float> remaining, airlight, transmittance;
};

template <class Distance, class Airlight>
Pictures upsampled(Backend& backend, Extent extent, int stride, Distance&& distance, Airlight&& airlight) {
  const Extent few = subsampled(extent, stride);
  const DepthAwareUpsample a{.distance = {{1}, Format::r32f, extent, 1, false},
                             .sampled_distance = {{2}, Format::r32f, few, 1, false},
                             .sampled_airlight = {{3}, Format::rgb32f, few, 1, false},
                             .sampled_per_light = {},
                             .sampled_transmittance = {{4}, Format::r32f, few, 1, false},
                             .stride = stride,
                             .remaining = {{5}, Format::r32f, extent, 1, true},
                             .airlight = {{6}, Format::rgb32f, extent, 1, true},
                             .per_light = {},
                             .transmittance = {{7}, Format::r32f, extent, 1, true}};
  std::vector<float> all, some, light, through;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) all.push_back(distance(x, y));
  }
  for (int y = 0; y < extent.height; y += stride) {
    for (int x = 0; x < extent.width; x += stride) {
      some.push_back(distance(x, y));
      light.insert(light.end(), 3, airlight(x, y));
      through.push_back(airlight(x, y) * 0.25F);
    }
  }
  static std::uint64_t key = 0;  // of content that no backend has had yet
  ++key;
  backend.upload(a.distance, all, key);
  backend.upload(a.sampled_distance, some, key);
  backend.upload(a.sampled_airlight, light, key);
  backend.upload(a.sampled_transmittance, through, key);
  const Step step{a, ""};
  Stats stats;
  NoProgress progress;
  backend.run({&step, 1}, stats, progress);
  Pictures p{std::vector<float>(a.remaining.floats()), std::vector<float>(a.airlight.floats()),
             std::vector<float>(a.transmittance.floats())};
  backend.download(a.remaining, p.remaining);
  backend.download(a.airlight, p.airlight);
  backend.download(a.transmittance, p.transmittance);
  return p;
}

class Upsample : public testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  int stride = std::get<1>(GetParam());
  std::unique_ptr<Backend> backend =
      std::get<0>(GetParam()) == "cpu" ? std::make_unique<CpuBackend>(CpuOptions{}) : make_gl_backend({.context = "osmesa"});
  static constexpr Extent extent{77, 54};  // no stride divides it
  static std::size_t at(int x, int y) { return static_cast<std::size_t>(y) * 77 + static_cast<std::size_t>(x); }
};

// Over a plane and a background, with an edge between them: every pixel is served, and has what the samples have.
TEST_P(Upsample, AConstantStaysThatInEveryBit) {
  for (const float value : {0.3F, 1e-20F, 12345.678F, 0.0F}) {
    const Pictures p = upsampled(
        *backend, extent, stride, [](int, int y) { return y < 23 ? 1e30F : 40.0F / static_cast<float>(y - 20); },
        [&](int, int) { return value; });
    for (std::size_t i = 0; i < p.remaining.size(); ++i) {
      if (p.remaining[i] > 0) continue;
      EXPECT_EQ(p.airlight[3 * i], value) << i;
      EXPECT_EQ(p.transmittance[i], std::min(value * 0.25F, 1.0F)) << i;
    }
    const auto left = std::count_if(p.remaining.begin(), p.remaining.end(), [](float r) { return r > 0; });
    EXPECT_LE(left, 77 * stride) << "but for a row of edges";
  }
}

// A wall before a far one: whatever is served has the airlight of its own side, in every bit where they differ by much. Where
// they differ by 4 %, most of what is beside the edge is served, to 1 %.
TEST_P(Upsample, AnEdgeOfDepthDoesNotLeak) {
  for (const float beyond : {0.104F, 3.0F}) {
    const int edge = 31;
    const auto near = [&](int x, int y) { return x + y / 3 < edge; };
    const Pictures p = upsampled(
        *backend, extent, stride, [&](int x, int y) { return near(x, y) ? 2.0F : 50.0F; },
        [&](int x, int y) { return near(x, y) ? 0.1F : beyond; });
    int served_beside = 0, beside = 0;
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        const bool at_edge = std::abs(x + y / 3 - edge) < 2;
        beside += at_edge ? 1 : 0;
        if (p.remaining[at(x, y)] > 0) continue;
        const float own = near(x, y) ? 0.1F : beyond;
        EXPECT_NEAR(p.airlight[3 * at(x, y)], own, beyond < 1 ? 0.01 * own : 0) << x << ", " << y;
        served_beside += at_edge ? 1 : 0;
      }
    }
    EXPECT_EQ(2 * served_beside > beside, beyond < 1) << served_beside << " of " << beside;
  }
}

// A post between the samples, and a hole of one pixel in a wall: none of the samples can speak for them.
TEST_P(Upsample, WhatNoSampleSeesIsComputed) {
  const auto distance = [&](int x, int y) { return x == 4 * 9 + 1 ? 3.0F : x == 4 * 3 + 1 && y == 4 * 5 + 1 ? 90.0F : 20.0F; };
  const Pictures p = upsampled(*backend, extent, stride, distance, [](int, int) { return 0.5F; });
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const float d = distance(x, y);
      EXPECT_EQ(p.remaining[at(x, y)], d == 20.0F ? 0.0F : d) << x << ", " << y;
    }
  }
}

// An edge of a shaft of light, on one surface: pixels between samples on either side of it are computed, those two strides away
// are not.
TEST_P(Upsample, AnEdgeOfLightIsComputed) {
  const Pictures p = upsampled(
      *backend, extent, stride, [](int, int) { return 10.0F; }, [](int x, int) { return x < 38 ? 1.0F : 0.7F; });
  for (int x = 0; x < extent.width; ++x) {
    const int before = 37 / stride * stride, after = (38 + stride - 1) / stride * stride;
    const bool across = x > before && x < after, away = x <= before - stride || x >= after + stride;
    if (!across && !away) continue;
    EXPECT_EQ(p.remaining[at(x, 20)] > 0, across) << x;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, Upsample, testing::Combine(testing::Values("cpu", "gl"), testing::Values(2, 4)),
                         [](const auto& test) {
                           return std::get<0>(test.param) + (std::get<1>(test.param) == 2 ? "_half" : "_quarter");
                         });

// A caster, a floor, fog, Gaussians and three lights.
Scene scene_of(const std::string& technique) {
  Scene scene = test_scene(600);
  scene.medium.extinction = technique == "illumination-network" ? 0 : 0.02;
  scene.medium.gaussians = {{.center = {0.2, 0.4, 0}, .radius = 0.9, .extinction = 0.6},
                            {.center = {-0.8, 0.1, 0.5}, .radius = 0.6, .extinction = 0.9},
                            {.center = {0.9, 0.3, -0.6}, .radius = 0.7, .extinction = 0.5}};
  return scene;
}

RenderSettings settings_of(const std::string& technique, const std::string& resolution,
                           std::vector<std::string> images = {"beauty", "airlight", "transmittance"}) {
  RenderSettings settings;
  settings.technique = technique;
  settings.resolution = Extent{76, 57};
  settings.images = std::move(images);
  settings.knobs = {{"airlight_resolution", resolution}};
  if (technique == "marching" || technique == "opacity-propagation") settings.knobs.emplace_back("steps", "24");
  if (technique == "opacity-propagation") settings.knobs.emplace_back("resolution", "24");
  if (technique == "illumination-network") {
    settings.knobs.emplace_back("particles", "64");
    settings.knobs.emplace_back("directions", "16");
  }
  return settings;
}

// Of one technique both: that others' steps are the same on both is for the parity tests.
std::vector<const char*> backends(const std::string& technique) {
  return technique == "gaussian-airlight" ? std::vector<const char*>{"cpu", "gl"} : std::vector<const char*>{"cpu"};
}

class SampledAirlight : public testing::TestWithParam<std::string> {};

// Pixels that no sample serves are those of the full resolution, in every bit, and there are some of both; what is left of the
// difference is what samples may leave.
TEST_P(SampledAirlight, LeavesLittleAndSomePixelsAlone) {
  const Scene scene = scene_of(GetParam());
  for (const char* backend : backends(GetParam())) {
    Renderer renderer({.backend = backend, .gl_context = "osmesa"});
    const Frame full = renderer.render(scene, settings_of(GetParam(), "full"));
    for (const char* resolution : {"half", "quarter"}) {
      const Frame some = renderer.render(scene, settings_of(GetParam(), resolution));
      for (const std::string name : {"airlight", "transmittance"}) {
        const std::vector<float>&a = full.image(name).values, &b = some.image(name).values;
        double squares = 0, sum = 0;
        std::size_t same = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
          const double apart = static_cast<double>(a[i]) - static_cast<double>(b[i]);
          squares += apart * apart;
          sum += static_cast<double>(a[i]);
          same += a[i] == b[i] ? 1U : 0U;
        }
        const auto n = static_cast<double>(a.size());
        const double error = std::sqrt(squares / n) / (sum / n), share = static_cast<double>(same) / n;
        std::printf("%s, %s, %s: %s within %.4f %%, the same bits in %.1f %%\n", backend, GetParam().c_str(), resolution,
                    name.c_str(), 100 * error, 100 * share);
        EXPECT_FALSE(!(error < 0.01)) << name;
        EXPECT_GT(error, 0) << name;
        EXPECT_GT(share, 0.02) << name;
      }
    }
  }
}

// An optical depth is that of each pixel, and asking for more images changes none.
TEST_P(SampledAirlight, OpticalDepthsAreOfEveryPixel) {
  const Scene scene = scene_of(GetParam());
  const std::string light = light_image_name(scene, 0);
  const std::vector<std::string> more{"beauty", "airlight", "transmittance", "optical_depth", light};
  for (const char* backend : backends(GetParam())) {
    Renderer one({.backend = backend, .gl_context = "osmesa"}), other({.backend = backend, .gl_context = "osmesa"});
    const Frame full = one.render(scene, settings_of(GetParam(), "full", more));
    const Frame half = one.render(scene, settings_of(GetParam(), "half", more));
    EXPECT_EQ(half.image("optical_depth").values, full.image("optical_depth").values) << backend;
    const Frame few = other.render(scene, settings_of(GetParam(), "half"));
    for (const std::string name : {"beauty", "airlight", "transmittance"})
      EXPECT_EQ(half.image(name).values, few.image(name).values) << backend << ", " << name;
    // The lights' shares are served where the whole is.
    const std::vector<float>&share = half.image(light).values, &of_full = full.image(light).values;
    double worst = 0, largest = 0;
    for (std::size_t i = 0; i < share.size(); ++i) {
      worst = std::max(worst, static_cast<double>(std::fabs(share[i] - of_full[i])));
      largest = std::max(largest, static_cast<double>(of_full[i]));
    }
    EXPECT_LT(worst, 0.1 * largest) << backend;
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, SampledAirlight,
                         testing::Values("gaussian-airlight", "marching", "opacity-propagation", "illumination-network"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Where nothing is gained the plan is that of the full resolution, and says why.
// Under nothing but an environment: what it sends and what is left of it on its way come from few pixels, its depth too.
TEST(SampledAirlightPlan, TakesAnEnvironmentFromFewPixels) {
  Scene scene = scene_of("gaussian-airlight");
  scene.lights.clear();
  scene.medium.gaussians.clear();
  for (std::uint32_t i = 0; i < 30; ++i) {
    const auto number = [i](std::uint32_t k) { return uniform(910, 3 * i + k); };
    scene.medium.gaussians.push_back(
        {.center = {2 * number(0) - 1, number(1), 2 * number(2) - 1}, .radius = 0.6, .extinction = 0.1});
  }
  scene.environment = Environment{nullptr, {1, 2, 3}, 0};
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend, .gl_context = "osmesa"});
    const auto render = [&](const char* resolution, std::vector<std::string> images = {"beauty", "airlight", "transmittance"}) {
      return renderer.render(scene, settings_of("gaussian-airlight", resolution, std::move(images)));
    };
    const Frame full = render("full");
    for (const char* resolution : {"half", "quarter"}) {
      const Frame some = render(resolution);
      for (const StepStats& step : some.stats.steps) EXPECT_NE(step.why, "the optical depth of every pixel");
      for (const std::string name : {"airlight", "transmittance", "beauty"}) {
        const std::vector<float>&a = full.image(name).values, &b = some.image(name).values;
        double squares = 0, power = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
          const double apart = static_cast<double>(a[i]) - static_cast<double>(b[i]);
          squares += apart * apart, power += static_cast<double>(a[i]) * static_cast<double>(a[i]);
        }
        const double error = std::sqrt(squares / power);
        std::printf("%s, %s: %s within %.4f %%\n", backend, resolution, name.c_str(), 100 * error);
        EXPECT_FALSE(!(error < 0.01)) << name;
        EXPECT_GT(error, 0) << name;
      }
      const Frame told = render(resolution, {"beauty", "optical_depth"});
      EXPECT_EQ(told.image("optical_depth").values, render("full", {"optical_depth"}).image("optical_depth").values);
      EXPECT_EQ(told.image("beauty").values, some.image("beauty").values);
    }
  }
}

TEST(SampledAirlightPlan, SaysWhatItLeaves) {
  Scene scene = scene_of("gaussian-airlight");
  RenderSettings half = settings_of("gaussian-airlight", "half", {"beauty"}), full = half;
  full.knobs = {{"airlight_resolution", "full"}};
  Renderer renderer({.backend = "cpu"});
  EXPECT_NE(explain(scene, half).find("depth_aware_upsample"), std::string::npos) << explain(scene, half);
  EXPECT_EQ(explain(scene, full).find("depth_aware_upsample"), std::string::npos) << explain(scene, full);
  const auto left = [&](const char* why) {
    const std::string told = explain(scene, half);
    EXPECT_EQ(told.find("depth_aware_upsample"), std::string::npos) << told;
    EXPECT_NE(told.find(std::string("airlight_resolution = half: ") + why), std::string::npos) << told;
    EXPECT_EQ(renderer.render(scene, half).image("beauty").values, renderer.render(scene, full).image("beauty").values) << why;
  };
  half.resolution = full.resolution = Extent{40, 4};
  left("the image is too small");
  half.resolution = full.resolution = Extent{76, 57};
  const std::vector<Gaussian> gaussians = scene.medium.gaussians;
  scene.medium.gaussians.clear();
  left("closed forms are as fast");
  scene.medium.gaussians = gaussians;
  scene.lights.clear();
  left("closed forms are as fast");
  scene.medium.gaussians.clear();
  scene.medium.extinction = 0;
  left("no medium");
}

// Of a frame whose samples are shifted the few pixels are shifted as well: the mean of many is that of the full resolution.
TEST(SampledAirlightPlan, WorksWithSupersampling) {
  const Scene scene = scene_of("gaussian-airlight");
  Renderer renderer({.backend = "cpu"});
  const auto mean = [&](const char* resolution) {
    RenderSettings settings = settings_of("gaussian-airlight", resolution, {"airlight"});
    settings.supersample = 2;
    double sum = 0;
    const Frame frame = renderer.render(scene, settings);
    for (const float v : frame.image("airlight").values) sum += static_cast<double>(v);
    return sum;
  };
  EXPECT_NEAR(mean("quarter") / mean("full"), 1, 2e-3);
}

}  // namespace

}  // namespace airlight
