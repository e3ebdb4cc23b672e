// The library keeps no global state: renderers side by side in threads, use after an error, what the caller had set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <thread>

#include "app/airlight.h"
#include "gpu/context.h"
#include "tests/unit/lamp_in_fog.h"

namespace airlight {

namespace {

std::vector<float> beauty(Renderer& renderer, const Scene& scene) { return renderer.render(scene, {}).image("beauty").values; }

class RendererOn : public testing::TestWithParam<std::string> {
 protected:
  RendererOptions options() const {
    RendererOptions o;
    o.backend = GetParam();
    o.gl_context = "osmesa";
    return o;
  }
};

TEST_P(RendererOn, TwoInTwoThreadsDoNotDisturbEachOther) {
  const Scene thin = lamp_in_fog(0.05), dense = lamp_in_fog(0.8);
  Renderer alone(options());
  const std::vector<float> expected_thin = beauty(alone, thin), expected_dense = beauty(alone, dense);
  ASSERT_NE(expected_thin, expected_dense);
  const auto work = [&](const Scene& scene, const std::vector<float>& expected, int& wrong) {
    Renderer renderer(options());
    for (int i = 0; i < 10; ++i) wrong += beauty(renderer, scene) != expected;
  };
  int wrong_thin = 0, wrong_dense = 0;
  std::thread first([&] { work(thin, expected_thin, wrong_thin); }), second([&] { work(dense, expected_dense, wrong_dense); });
  first.join();
  second.join();
  EXPECT_EQ(wrong_thin + wrong_dense, 0);
}

TEST_P(RendererOn, WorksAfterAnError) {
  Renderer renderer(options());
  const Scene scene = lamp_in_fog(0.2);
  const std::vector<float> expected = beauty(renderer, scene);
  RenderSettings wrong;
  wrong.images = {"no such image"};
  EXPECT_THROW(renderer.render(scene, wrong), InputError);
  wrong = {};
  wrong.resolution = Extent{0, 7};
  EXPECT_THROW(renderer.render(scene, wrong), InputError);
  Scene gaussian = scene;
  gaussian.medium.gaussians.emplace_back();
  wrong = {};
  wrong.technique = "shadow-planes";
  EXPECT_THROW(renderer.render(gaussian, wrong), InputError);
  struct Stopped final : Progress {
    void report(std::string_view, double) override {}
    bool stop_requested() const override { return true; }
  } stopped;
  EXPECT_THROW(renderer.render(lamp_in_fog(0.3), {}, stopped), Interrupted);
  EXPECT_EQ(beauty(renderer, scene), expected);
}

TEST_P(RendererOn, LeavesTheCallersRoundingAlone) {
  Renderer renderer(options());
  const Scene scene = lamp_in_fog(0.2);
  const std::vector<float> expected = beauty(renderer, scene);
  std::fesetround(FE_DOWNWARD);
  const std::vector<float> found = beauty(renderer, lamp_in_fog(0.2));
  const int after = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(after, FE_DOWNWARD);
  EXPECT_EQ(found, expected);
}

TEST_P(RendererOn, MovesBetweenThreads) {
  Renderer renderer(options());
  const Scene scene = lamp_in_fog(0.2);
  const std::vector<float> expected = beauty(renderer, scene);
  std::vector<float> found;
  Scene brighter = scene;
  brighter.lights[0].power *= 2;
  std::thread([&] {
    beauty(renderer, brighter);
    found = beauty(renderer, scene);
  }).join();
  EXPECT_EQ(found, expected);
}

// What a plan leaves out would not have changed a bit.
TEST_P(RendererOn, SkipsWhatChangesNothing) {
  Renderer renderer(options());
  const Scene scene = lamp_in_fog(0.2);
  Scene with_black_lamp = scene;
  with_black_lamp.lights.insert(with_black_lamp.lights.begin(), with_black_lamp.lights[0]);
  with_black_lamp.lights[0].power = {0, 0, 0};
  EXPECT_NE(explain(with_black_lamp, {}).find("lights of zero power"), std::string::npos);
  EXPECT_EQ(explain(scene, {}).find("lights of zero power"), std::string::npos);
  EXPECT_EQ(beauty(renderer, with_black_lamp), beauty(renderer, scene));

  // The smallest albedo has its airlight computed, none has not.
  Scene faint = scene, black = scene;
  faint.medium.albedo = glm::dvec3(1e-30);
  black.medium.albedo = glm::dvec3(0);
  EXPECT_EQ(explain(faint, {}).find("scatters nothing"), std::string::npos);
  EXPECT_NE(explain(black, {}).find("scatters nothing"), std::string::npos);
  const std::vector<float> computed = beauty(renderer, faint), skipped = beauty(renderer, black);
  for (std::size_t i = 0; i < computed.size(); ++i) ASSERT_NEAR(computed[i], skipped[i], 1e-28F);

  // A directional light needs no tables: the image is that of a scene where they are there for a lamp that lights nothing.
  Scene sun = scene;
  sun.lights[0].type = LightType::directional;
  sun.lights[0].direction = {0, -1, 0};
  Scene sun_and_lamp = sun;
  sun_and_lamp.lights.push_back(scene.lights[0]);
  sun_and_lamp.lights[1].power = glm::dvec3(1e-35);
  EXPECT_NE(explain(sun, {}).find("no point light"), std::string::npos);
  EXPECT_EQ(explain(sun_and_lamp, {}).find("no point light"), std::string::npos);
  const std::vector<float> without = beauty(renderer, sun), with = beauty(renderer, sun_and_lamp);
  for (std::size_t i = 0; i < with.size(); ++i) ASSERT_NEAR(without[i], with[i], 1e-28F);
}

INSTANTIATE_TEST_SUITE_P(Backends, RendererOn, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

// What GL says of the buffer that the caller has bound in its own context.
GLint bound_buffer(const GlContext& context) {
  GLint name = 0;
  context.gl().GetIntegerv(0x8894, &name);  // GL_ARRAY_BUFFER_BINDING
  return name;
}

TEST(GlContext, TheCallersIsCurrentAgainAfterAFrame) {
  for (const std::string mine : {"osmesa", "egl"}) {
    std::unique_ptr<GlContext> callers;
    try {
      callers = make_context({.context = mine});
    } catch (const MachineError& e) {
      std::printf("skipped: %s\n", e.what());
      continue;
    }
    for (const std::string its : {"osmesa", "egl"}) {
      const GlContext::Current current(*callers);
      GLuint buffer = 0;
      callers->gl().CreateBuffers(1, &buffer);
      callers->gl().BindBuffer(0x8892, buffer);  // GL_ARRAY_BUFFER
      ASSERT_EQ(bound_buffer(*callers), static_cast<GLint>(buffer));
      try {
        Renderer renderer({.backend = "gl", .gl_context = its});
        beauty(renderer, lamp_in_fog(0.2));
        EXPECT_EQ(bound_buffer(*callers), static_cast<GLint>(buffer)) << "a frame by " << its << " within " << mine;
      } catch (const MachineError& e) {
        std::printf("skipped: %s\n", e.what());
      }
      EXPECT_EQ(bound_buffer(*callers), static_cast<GLint>(buffer));
    }
  }
}

TEST(GlContext, EglGivesTheSameImageAsOsmesa) {
  try {
    Renderer egl({.backend = "gl", .gl_context = "egl"}), osmesa({.backend = "gl", .gl_context = "osmesa"});
    std::printf("%s\n%s\n", egl.describe().c_str(), osmesa.describe().c_str());
    const std::vector<float> a = beauty(egl, lamp_in_fog(0.2)), b = beauty(osmesa, lamp_in_fog(0.2));
    double largest = 0, worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      largest = std::max(largest, static_cast<double>(b[i]));
      worst = std::max(worst, std::fabs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    }
    std::printf("largest difference %.3g of the image's maximum\n", worst / largest);
    EXPECT_FALSE(!(worst <= 1e-4 * largest));
  } catch (const MachineError& e) {
    GTEST_SKIP() << "skipped: " << e.what();
  }
}

}  // namespace

}  // namespace airlight
