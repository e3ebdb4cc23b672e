// airlight-shadows: shadow planes beside brute force, as tables for docs/RESULTS.md: time against error beside marching with
// shadow rays, beside the published order and beside OpenGL; the rows of Biri et al. 2006, table II; how times scale; what skips
// gain.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <thread>

#include "app/airlight.h"
#include "bench/brute_force.h"
#include "common/reference/reference.h"
#include "common/relative_rmse.h"
#include "common/scene/load.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

constexpr Extent full{800, 600}, small{160, 120};
const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

RelativeRmse error_of(const HostImage& image, const ReferenceFrame& truth) {
  RelativeRmse error;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    if (truth.edges[i]) continue;
    for (int c = 0; c < 3; ++c)
      error.add(static_cast<double>(image.values[3 * i + static_cast<std::size_t>(c)]), truth.pixels[i].beauty()[c]);
  }
  return error;
}

RenderSettings settings_of(Extent extent, const char* shadows, const char* indirect) {
  RenderSettings settings;
  settings.technique = "shadow-planes";
  settings.resolution = extent;
  settings.knobs = {{"shadows", shadows}, {"indirect", indirect}};
  return settings;
}

// A frame in which the first light flickers, so that all but the visible surfaces is computed again.
class Flicker {
 public:
  Flicker(const Scene& scene, const RenderSettings& settings, const std::string& backend)
      : scene_(scene), settings_(settings), renderer_({.backend = backend, .keep = 0}) {}
  Frame frame() {
    scene_.lights[0].power *= 1 + 1e-6;
    return renderer_.render(scene_, settings_);
  }

 private:
  Scene scene_;
  RenderSettings settings_;
  Renderer renderer_;
};

void against_brute_force(const std::string& path) {
  const Scene scene = load_scene(path);
  NoProgress progress;
  const ReferenceFrame truth = reference_frame(scene, small, {1e-6, true, Indirect::off}, true, threads, progress);
  struct Row {
    std::string name;
    double error;
    std::function<void()> frame;
    std::vector<double> times;
  };
  std::vector<Row> rows;
  const BruteForce brute(scene, threads);
  for (const int steps : {8, 32, 128, 512}) {
    rows.push_back({fmt::format("Embree, {} steps", steps),
                    error_of(brute.render(small, steps), truth).value(),
                    [&brute, steps] { brute.render(full, steps); },
                    {}});
  }
  for (const auto& [name, backend, shadows] :
       {std::array{"shadow planes", "cpu", "on"}, std::array{"the published order", "cpu", "published"},
        std::array{"shadow planes, OpenGL", "gl", "on"}}) {
    Renderer renderer({.backend = backend});
    const HostImage image = renderer.render(scene, settings_of(small, shadows, "off")).image("beauty");
    auto flicker = std::make_shared<Flicker>(scene, settings_of(full, shadows, "off"), backend);
    rows.push_back({name, error_of(image, truth).value(), [flicker] { flicker->frame(); }, {}});
  }
  for (int round = 0; round < 5; ++round) {
    for (Row& row : rows) {
      if (row.times.empty()) row.frame();
      if (row.times.empty() || row.times[0] < 2000) row.times.push_back(milliseconds(row.frame));
    }
  }
  fmt::print("\n{}, 800 x 600, without indirect light; error off edges at 160 x 120:\n\n| | error | ms |\n|---|---|---|\n", path);
  for (const Row& row : rows) fmt::print("| {} | {:.3g} % | {:.4g} |\n", row.name, 100 * row.error, median(row.times));
}

// Eight tori over a floor between two lamps, and as many single triangles as the number asked for leaves.
Scene hall(std::size_t triangles) {
  Scene scene;
  scene.camera = {.position = {0.5, 3.2, 9}, .look_at = {0, 0.6, 0}, .vertical_fov = 48};
  scene.sky_distance = 60;
  scene.medium.extinction = 0.07;
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.3};
  scene.lights = {{.name = "", .position = {-1.1, 3.4, 1.2}, .power = {40, 34, 26}},
                  {.name = "", .position = {2.6, 2.8, -2.2}, .power = {22, 28, 38}}};
  scene.surfaces = {{.mesh = square(12), .material = {.diffuse = {0.4F, 0.4F, 0.38F}}}};
  const std::shared_ptr<const Mesh> torus = wavy_torus((triangles - 2) / 8);
  std::size_t left = triangles - 2;
  for (int i = 0; i < 8; ++i) {
    Surface s{.mesh = torus, .material = {.diffuse = {0.5F, 0.4F, 0.35F}, .specular = {0.1F, 0.1F, 0.1F}}};
    s.transform = glm::dmat4(0.8);
    s.transform[3] = {-4.2 + 2.8 * (i % 4), 0.9 + 0.35 * (i % 3), -2.4 + 3.2 * (i / 4), 1};
    scene.surfaces.push_back(s);
    left -= torus->triangles.size();
  }
  Mesh leaves;
  for (unsigned i = 0; i < left; ++i) {
    const double a = 2 * std::numbers::pi * i / static_cast<double>(left);
    const glm::dvec3 at(5 * std::cos(a), 0.1, 5 * std::sin(a));
    for (const glm::dvec3& corner : {glm::dvec3(0, 0, 0), glm::dvec3(0.05, 0.02, 0), glm::dvec3(0, 0.06, 0.03)}) {
      leaves.positions.push_back(at + corner);
      leaves.normals.push_back({0, 1, 0});
    }
    leaves.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  scene.surfaces.push_back({.mesh = std::make_shared<Mesh>(leaves), .material = {.diffuse = {0.2F, 0.4F, 0.1F}}});
  return scene;
}

std::size_t triangles_of(const Scene& scene) {
  std::size_t n = 0;
  for (const Surface& s : scene.surfaces) n += s.mesh->triangles.size();
  return n;
}

struct Timed {
  double frame = 0;
  std::vector<std::pair<std::string, double>> steps;  // [ms] of thread time
};

Timed timed(Scene scene, const RenderSettings& settings, const std::function<void(Scene&, int)>& change, int frames) {
  Renderer renderer({.backend = "cpu", .keep = 0});
  std::vector<double> wall;
  std::vector<std::vector<double>> steps;
  Timed result;
  for (int i = 0; i <= frames; ++i) {
    change(scene, i);
    Frame frame;
    const double ms = milliseconds([&] { frame = renderer.render(scene, settings); });
    if (i == 0) continue;
    wall.push_back(ms);
    steps.resize(frame.stats.steps.size());
    result.steps.resize(steps.size());
    for (std::size_t k = 0; k < steps.size(); ++k) {
      steps[k].push_back(1e3 * frame.stats.steps[k].seconds);
      result.steps[k] = {frame.stats.steps[k].name, median(steps[k])};
    }
  }
  result.frame = median(wall);
  return result;
}

double step(const Timed& t, const std::string& name) {
  for (const auto& [known, ms] : t.steps) {
    if (known == name) return ms;
  }
  return 0;
}

void move_camera(Scene& scene, int i) { scene.camera.position.x = 0.5 + 0.01 * i; }
void move_light(Scene& scene, int i) { scene.lights[0].position.x = -1.1 + 0.01 * i; }
void flicker(Scene& scene, int i) { scene.lights[0].power *= 1 + 1e-6 * i; }

void table_two() {
  fmt::print(
      "\nThe scenes of table II, two lights, 800 x 600, frames a second; the paper's are of a GPU of 2006:\n\n"
      "| triangles | indirect | paper | camera moves | light moves | most of the latter [ms of thread time] "
      "|\n|---|---|---|---|---|---|\n");
  const double paper[3][2] = {{31, 30}, {10.5, 10.2}, {7.6, 7.0}};
  const std::size_t counts[] = {14785, 110014, 136266};
  for (std::size_t row = 0; row < 3; ++row) {
    const Scene scene = hall(counts[row]);
    if (triangles_of(scene) != counts[row]) throw MachineError("the hall has another number of triangles");
    for (int k = 0; k < 2; ++k) {
      const RenderSettings settings = settings_of(full, "on", k == 0 ? "off" : "unbounded");
      const Timed camera = timed(scene, settings, move_camera, 9), light = timed(scene, settings, move_light, 9);
      double all = 0;
      for (const auto& [name, ms] : light.steps) all += ms;
      fmt::print(
          "| {} | {} | {} | {:.1f} | {:.1f} | shadow_planes {:.0f}, surface_visibility {:.0f}, all steps {:.0f}; outside of them "
          "{:.0f} ms |\n",
          counts[row], k == 0 ? "no" : "yes", paper[row][k], 1e3 / camera.frame, 1e3 / light.frame, step(light, "shadow_planes"),
          step(light, "surface_visibility"), all, light.frame - all / threads);
    }
  }
}

void scaling() {
  fmt::print(
      "\nOne torus, three lights: thread time of `shadow_planes` [ms]:\n\n| triangles, 800 x 600 | light flickers | light moves: "
      "whole frame |\n|---|---|---|\n");
  for (const std::size_t n : {1000U, 10000U, 100000U, 1000000U}) {
    const Scene scene = test_scene(n);
    const RenderSettings settings = settings_of(full, "on", "off");
    const Timed still = timed(scene, settings, flicker, 5), moved = timed(scene, settings, move_light, 5);
    fmt::print("| {} | {:.1f} | {:.1f} |\n", triangles_of(scene), step(still, "shadow_planes"), moved.frame);
  }
  fmt::print("\n| resolution, 10 000 triangles | light flickers |\n|---|---|\n");
  for (const int k : {1, 2, 4}) {
    const Timed t = timed(test_scene(10000), settings_of({400 * k, 300 * k}, "on", "off"), flicker, 5);
    fmt::print("| {} x {} | {:.1f} |\n", 400 * k, 300 * k, step(t, "shadow_planes"));
  }
}

void skips() {
  fmt::print(
      "\nWhat skips gain, frames of 100 000 triangles and three lights that flicker, beside the same without the skip:\n\n"
      "| left out | ms with | ms without | ratio |\n|---|---|---|---|\n");
  const Scene scene = test_scene(100000);
  const auto row = [&](const char* name, const Scene& with, const Scene& without) {
    const RenderSettings settings = settings_of(full, "on", "unbounded");
    const double a = timed(with, settings, flicker, 7).frame, b = timed(without, settings, flicker, 7).frame;
    fmt::print("| {} | {:.1f} | {:.1f} | {:.2f} |\n", name, a, b, b / a);
  };
  Scene changed = scene;
  for (Surface& s : changed.surfaces) s.casts_shadow = false;
  row("shadow planes: nothing casts a shadow", changed, scene);
  Scene dark = scene, faint = scene;
  dark.lights[1].power = glm::dvec3(0), faint.lights[1].power = glm::dvec3(1e-30);
  row("a light of zero power, else 1e-30", dark, faint);
  // Where the fog before the casters lets nothing through; in the second one, half as dense, it does.
  Scene far_away = scene, near_enough = scene;
  for (Scene* s : {&far_away, &near_enough}) {
    s->lights.resize(1);
    s->surfaces[1].transform[3] = {0, 0, -30, 1};
  }
  far_away.medium.extinction = 4, near_enough.medium.extinction = 1;
  row("casters out of reach of a light (fog of 4 /m), else in reach (1 /m)", far_away, near_enough);
  Scene aside = scene;
  aside.camera.look_at = aside.camera.position + (aside.camera.position - aside.camera.look_at) * glm::dvec3(1, 0, 1);
  row("planes outside the view: the camera turned round", aside, scene);
}

}  // namespace

}  // namespace airlight

int main() {
  try {
    for (const char* path : {"scenes/fog_bunny.json", "scenes/pergola.json"}) airlight::against_brute_force(path);
    airlight::table_two();
    airlight::scaling();
    airlight::skips();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
}
