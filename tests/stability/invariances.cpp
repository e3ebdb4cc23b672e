// What must not change a picture, or must change it in a known way, whatever the scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/airlight.h"
#include "common/relative_rmse.h"
#include "tests/parity/compare.h"
#include "tests/stability/draw.h"
#include "tests/stability/hostile.h"
#include "tests/stability/trial.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

Renderer& renderer() {
  static Renderer cpu({.backend = "cpu"});
  return cpu;
}

const std::vector<std::string> everything{"beauty", "surface", "airlight", "transmittance", "optical_depth", "depth"};

Frame render(const Scene& scene, const Asked& asked) {
  RenderSettings settings;
  settings.technique = asked.technique, settings.knobs = asked.settings;
  settings.images = everything;
  return renderer().render(scene, settings);
}

// Relative RMSE of beauty and the largest difference of transmittance, where neither has an edge.
struct Apart {
  double beauty = 0, transmittance = 0;
};
Apart apart(const Frame& a, const Frame& b) {
  const HostImage& depth = a.image("depth");
  const std::vector<bool> in_a = edges_of(depth.extent, depth.values), in_b = edges_of(depth.extent, b.image("depth").values);
  RelativeRmse beauty;
  Apart all;
  for (std::size_t pixel = 0; pixel < in_a.size(); ++pixel) {
    if (in_a[pixel] || in_b[pixel]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      beauty.add(static_cast<double>(b.image("beauty").values[3 * pixel + c]),
                 static_cast<double>(a.image("beauty").values[3 * pixel + c]));
    }
    const double x = static_cast<double>(a.image("transmittance").values[pixel]),
                 y = static_cast<double>(b.image("transmittance").values[pixel]);
    all.transmittance = std::max(all.transmittance, std::fabs(x - y));
  }
  all.beauty = beauty.mean_truth() == 0 ? beauty.rmse() : beauty.value();
  return all;
}

constexpr std::uint32_t first_scene = 700000000;  // beside those of the other tests

// Each of some hostile scenes that `takes` accepts, and how it is asked, before and after `change`.
void hold(const char* what, std::string_view bound, int scenes, const std::function<bool(const Scene&, const Asked&)>& takes,
          const std::function<void(Scene&, Draw&)>& change) {
  int tried = 0;
  Apart worst;
  std::uint32_t worst_number = 0;
  for (std::uint32_t number = first_scene; tried < scenes; ++number) {
    HostileScene hostile = hostile_scene(number);
    const Asked asked = asked_of(hostile.scene, number);
    if (asked.technique.empty() || hostile.scene.camera.resolution.width > 100 || !takes(hostile.scene, asked)) continue;
    Frame before;
    try {
      before = render(hostile.scene, asked);
    } catch (const InputError&) {
      continue;  // settings that this scene refuses
    }
    Draw draw(number);
    Scene changed = hostile.scene;
    change(changed, draw);
    const Apart found = apart(before, render(changed, asked));
    ++tried;
    if (found.beauty > worst.beauty) worst_number = number;
    worst.beauty = std::max(worst.beauty, found.beauty), worst.transmittance = std::max(worst.transmittance, found.transmittance);
    EXPECT_FALSE(!(found.beauty <= tolerance(bound)) || !(found.transmittance <= tolerance(bound)))
        << what << ", scene " << number << ": " << found.beauty << " of beauty, " << found.transmittance << " of transmittance; "
        << asked.text() << "; " << hostile.traits;
  }
  std::printf("%s: %d scenes, relative RMSE at most %.3g (scene %u), transmittance %.3g apart, allowed %.3g\n", what, tried,
              worst.beauty, worst_number, worst.transmittance, tolerance(bound));
}

bool settled(const Asked& asked) {  // particles are drawn anew where anything moves, samples tell just enough or not
  return asked.technique != "illumination-network" &&
         std::none_of(asked.settings.begin(), asked.settings.end(), [](const auto& s) {
           return s.first == "airlight_resolution" || s == std::pair<std::string, std::string>("steps", "1");
         });
}

void move(Scene& s, const std::function<glm::dvec3(const glm::dvec3&)>& place,
          const std::function<glm::dvec3(const glm::dvec3&)>& turn) {
  s.camera.position = place(s.camera.position), s.camera.look_at = place(s.camera.look_at), s.camera.up = turn(s.camera.up);
  for (Gaussian& g : s.medium.gaussians) g.center = place(g.center);
  const auto transform = [&](glm::dmat4& m) {
    for (int k = 0; k < 3; ++k) m[k] = glm::dvec4(turn(glm::dvec3(m[k])), 0);
    m[3] = glm::dvec4(place(glm::dvec3(m[3])), 1);
  };
  if (s.medium.grid) transform(s.medium.grid->transform);
  for (LightSource& l : s.lights) l.position = place(l.position), l.direction = turn(l.direction);
  for (Surface& surface : s.surfaces) transform(surface.transform);
}

TEST(Invariance, Translation) {
  hold(
      "moved", "invariance_moved", 25,
      [](const Scene& s, const Asked& a) { return settled(a) && glm::length(s.camera.position) < 100; },
      [](Scene& s, Draw& draw) {
        const glm::dvec3 by = draw.of(std::array{1.0, 1e3, 1e5}) * draw.direction();
        move(
            s, [&](const glm::dvec3& p) { return p + by; }, [](const glm::dvec3& d) { return d; });
      });
}

TEST(Invariance, QuarterTurns) {
  hold(
      "turned", "invariance_moved", 25,
      [](const Scene& s, const Asked& a) { return settled(a) && !s.environment && glm::length(s.camera.position) < 100; },
      [](Scene& s, Draw& draw) {
        const int axis = draw.whole(0, 2);
        const auto turn = [axis](const glm::dvec3& d) {
          return axis == 0 ? glm::dvec3(d.x, -d.z, d.y) : axis == 1 ? glm::dvec3(d.z, d.y, -d.x) : glm::dvec3(-d.y, d.x, d.z);
        };
        move(s, turn, turn);
      });
}

// By a power of 2, so that nothing is rounded otherwise but what has a unit of its own.
TEST(Invariance, Units) {
  hold(
      "scaled", "invariance_scaled", 25, [](const Scene&, const Asked& a) { return settled(a); },
      [](Scene& s, Draw& draw) {
        double f = draw.of(std::array{0.125, 8.0, 64.0});
        double least = 1e300, most = 0;  // what must stay within the limits of a scene
        for (const Gaussian& g : s.medium.gaussians) least = std::min(least, g.radius), most = std::max(most, g.radius);
        for (const LightSource& l : s.lights) least = std::min(least, l.radius), most = std::max(most, l.radius);
        if (least * f < 1e-6 || most * f > 1e6) f = 1;
        move(
            s, [f](const glm::dvec3& p) { return f * p; }, [](const glm::dvec3& d) { return d; });
        Medium& m = s.medium;
        m.extinction /= f, m.emission /= f, s.sky_distance *= f;
        for (Gaussian& g : m.gaussians) g.radius *= f, g.extinction /= f, g.emission /= f;
        if (m.grid) {
          m.grid->scale /= f;
          for (int k = 0; k < 3; ++k) m.grid->transform[k] *= f;
        }
        for (LightSource& l : s.lights) {
          l.radius *= f;
          if (l.type == LightType::point) l.power *= f * f;
        }
        for (Surface& surface : s.surfaces) {
          for (int k = 0; k < 3; ++k) surface.transform[k] *= f;
        }
      });
}

TEST(Invariance, HalvesOfAGaussian) {
  hold(
      "halved", "invariance_halves", 15,
      [](const Scene& s, const Asked& a) {
        // Halves reach less far, so that cells about them lie elsewhere: of two along an edge that is 1.7 % of the picture.
        const bool few_cells = std::any_of(a.settings.begin(), a.settings.end(), [](const auto& set) {
          return set == std::pair<std::string, std::string>("resolution", "2");
        });
        return settled(a) && !few_cells && !s.medium.gaussians.empty() && s.medium.gaussians.size() < 10 &&
               s.medium.gaussians[0].extinction > 0;
      },
      [](Scene& s, Draw&) {
        Gaussian half = s.medium.gaussians[0];
        half.extinction *= 0.5, half.emission *= 0.5;
        s.medium.gaussians[0] = half;
        half.radius *= 1 + 1e-12;  // or plans add it to the other
        s.medium.gaussians.push_back(half);
      });
}

TEST(Invariance, OrderOfLights) {
  hold(
      "reversed", "invariance_order", 20, [](const Scene& s, const Asked&) { return s.lights.size() > 1; },
      [](Scene& s, Draw&) { std::reverse(s.lights.begin(), s.lights.end()); });
}

// In every bit, whatever the technique.
TEST(Invariance, TwiceTheLight) {
  int tried = 0;
  for (std::uint32_t number = first_scene; tried < 30; ++number) {
    HostileScene hostile = hostile_scene(number);
    const Asked asked = asked_of(hostile.scene, number);
    if (asked.technique.empty() || hostile.scene.camera.resolution.width > 100 || hostile.scene.lights.empty()) continue;
    Frame before, after;
    try {
      before = render(hostile.scene, asked);
      Scene& s = hostile.scene;
      for (LightSource& l : s.lights) l.power *= 2;
      s.medium.ambient *= 2, s.medium.emission *= 2, s.background *= 2;
      for (Gaussian& g : s.medium.gaussians) g.emission *= 2;
      if (s.environment) s.environment->radiance *= 2;
      after = render(s, asked);
    } catch (const InputError&) {
      continue;
    }
    ++tried;
    std::size_t apart = 0, first = 0;
    const std::vector<float>&a = before.image("beauty").values, &b = after.image("beauty").values;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (2 * a[i] != b[i] && apart++ == 0) first = i;
    }
    EXPECT_EQ(apart, 0U) << "scene " << number << ": " << asked.text() << "; " << hostile.traits << ": " << a[first] << " and "
                         << b[first];
  }
}

// One pixel from A to B, and from B to A.
TEST(Invariance, RaysReversed) {
  double worst = 0;
  int tried = 0;
  for (std::uint32_t number = first_scene; tried < 60; ++number) {
    HostileScene hostile = hostile_scene(number);
    Scene& s = hostile.scene;
    s.surfaces.clear(), s.lights.clear(), s.environment.reset();
    s.camera.resolution = {1, 1};
    if (s.medium.empty()) continue;
    Asked asked;
    asked.technique = s.medium.grid ? "marching" : "gaussian-airlight";
    if (s.medium.grid) asked.settings = {{"steps", "256"}};
    Draw draw(number);
    const double length = glm::distance(s.camera.position, s.camera.look_at) * draw.between(0.5, 3);
    const glm::dvec3 a = s.camera.position, b = a + length * glm::normalize(s.camera.look_at - a);
    s.sky_distance = length;
    s.camera.look_at = b;
    const double there = static_cast<double>(render(s, asked).image("optical_depth").values[0]);
    s.camera.position = b, s.camera.look_at = a;
    const double back = static_cast<double>(render(s, asked).image("optical_depth").values[0]);
    ++tried;
    const double apart = std::fabs(there - back) / (1e-2 + std::max(there, back));
    worst = std::max(worst, apart);
    EXPECT_FALSE(!(apart <= tolerance("invariance_reversed")))
        << "scene " << number << ": " << there << " and " << back << "; " << hostile.traits;
  }
  std::printf("reversed rays: %d scenes, depths at most %.3g apart, allowed %.3g\n", tried, worst,
              tolerance("invariance_reversed"));
}

// Light that nothing scatters: what is behind more medium is no brighter, to rounding.
TEST(Invariance, MoreDensityIsNeverBrighter) {
  int tried = 0;
  double worst = 0;
  for (std::uint32_t number = first_scene; tried < 25; ++number) {
    HostileScene hostile = hostile_scene(number);
    Scene& s = hostile.scene;
    const Asked asked = asked_of(s, number);
    if (asked.technique.empty() || s.camera.resolution.width > 100 || s.medium.empty()) continue;
    if (asked.technique == "illumination-network") continue;  // splats stand elsewhere where there is more
    Asked without = asked;
    std::erase_if(without.settings, [](const auto& k) { return k.first == "indirect" || k.first == "airlight_resolution"; });
    without.settings.emplace_back("indirect", "off");
    if (s.environment) without.settings.emplace_back("environment_indirect", "off");
    s.medium.ambient = glm::dvec3(0);
    Frame before, after;
    try {
      before = render(s, without);
      Draw draw(number);
      const int what = draw.whole(0, 2);
      if (what == 0 || s.medium.gaussians.empty()) s.medium.extinction *= 1.5;
      if (what == 1 && !s.medium.gaussians.empty()) s.medium.gaussians[0].extinction *= 1.3;
      if (what == 2 && s.medium.grid) s.medium.grid->scale *= 2;
      after = render(s, without);
    } catch (const InputError&) {
      continue;
    }
    ++tried;
    for (const char* name : {"surface", "transmittance"}) {
      const std::vector<float>&a = before.image(name).values, &b = after.image(name).values;
      const double most = static_cast<double>(*std::max_element(a.begin(), a.end()));
      for (std::size_t i = 0; i < a.size(); ++i) {
        const double more = (static_cast<double>(b[i]) - static_cast<double>(a[i])) / std::max(most, 1e-30);
        worst = std::max(worst, more);
        EXPECT_FALSE(!(more <= tolerance("invariance_darker"))) << name << ", scene " << number << ": " << a[i] << " becomes "
                                                                << b[i] << "; " << without.text() << "; " << hostile.traits;
        if (!(more <= tolerance("invariance_darker"))) break;
      }
    }
  }
  std::printf("more density: %d scenes, at most %.3g of the brightest brighter, allowed %.3g\n", tried, worst,
              tolerance("invariance_darker"));
}

// A grid of one value about all that is seen and lit.
TEST(Invariance, HomogeneousGridIsFog) {
  for (std::uint32_t number = 0; number < 6; ++number) {
    Draw draw(first_scene + number);
    Scene fog;
    fog.camera.position = draw.vector(0.5), fog.camera.look_at = draw.vector(3);
    fog.camera.resolution = {24, 16};
    fog.sky_distance = draw.between(2, 6);
    fog.medium.extinction = draw.magnitude(0.02, 0.5);
    fog.medium.albedo = glm::dvec3(0.9, 0.5, 1);
    fog.medium.phase = {PhaseKind::henyey_greenstein, draw.between(-0.6, 0.6)};
    LightSource lamp;
    lamp.position = draw.vector(3), lamp.power = glm::dvec3(3);
    fog.lights = {lamp};
    Scene grid = fog;
    grid.medium.extinction = 0;
    auto voxels = std::make_shared<VoxelGrid>();
    voxels->size = {draw.whole(2, 9), draw.whole(2, 9), draw.whole(2, 9)};
    voxels->values.assign(static_cast<std::size_t>(voxels->size.x * voxels->size.y * voxels->size.z), 0.5F);
    GridMedium medium{.voxels = voxels, .scale = 2 * fog.medium.extinction, .albedo = fog.medium.albedo};
    for (int k = 0; k < 3; ++k) medium.transform[k] *= 30.0 / voxels->size[k];
    medium.transform[3] = glm::dvec4(-15, -15, -15, 1);
    grid.medium.grid = medium;
    for (const char* technique : {"marching", "opacity-propagation"}) {
      Asked asked;
      asked.technique = technique;
      asked.settings = {{"steps", "256"}};
      if (asked.technique == "opacity-propagation") asked.settings.emplace_back("resolution", "64");
      const Apart found = apart(render(fog, asked), render(grid, asked));
      std::printf("grid of one value, %s: relative RMSE %.3g, transmittance %.3g apart\n", technique, found.beauty,
                  found.transmittance);
      EXPECT_FALSE(!(found.beauty <= tolerance("invariance_grid"))) << technique << ' ' << number;
      EXPECT_FALSE(!(found.transmittance <= tolerance("invariance_grid"))) << technique << ' ' << number;
    }
  }
}

}  // namespace
}  // namespace airlight
