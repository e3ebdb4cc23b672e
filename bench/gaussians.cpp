// airlight-gaussians: gaussian-airlight as tables for docs/RESULTS.md: the rows of Zhou et al.'s table 1 at their size; closed
// forms on the way to the lights beside volumes, time and error, by the number of Gaussians, and the paper's own airlight;
// optical depths to the centres of all.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/airlight.h"
#include "common/plan/depths_to_centers.h"
#include "common/plan/geometry.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

constexpr Extent full{800, 600}, quarter{200, 150};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Steam that widens as it rises over a floor of hills with so many vertices an edge; lamps around it.
Scene steam(int gaussians, int lights, unsigned vertices) {
  Scene scene;
  scene.camera = {.position = {0.4, 1.6, 5.2}, .look_at = {0, 1.1, 0}, .vertical_fov = 40};
  scene.camera.resolution = full;
  scene.sky_distance = 40;
  const double radius = 1.6 / std::cbrt(gaussians + 20);
  for (int i = 0; i < gaussians; ++i) {
    const auto number = [&](std::uint32_t n) { return uniform(901, 5 * static_cast<std::uint32_t>(i) + n); };
    const double up = number(0), off = (0.25 + 0.9 * up) * std::sqrt(number(1)), angle = 2 * std::numbers::pi * number(2);
    const double size = radius * (0.7 + 0.6 * number(3));
    scene.medium.gaussians.push_back({.center = {off * std::cos(angle), 0.2 + 2 * up, off * std::sin(angle)},
                                      .radius = size,
                                      .extinction = 8 * (0.3 + number(4)) / (size * std::pow(gaussians, 2.0 / 3) + 4)});
  }
  for (int i = 0; i < lights; ++i) {
    LightSource lamp;
    lamp.position = {2.5 * std::cos(2.4 * i), 2.2 + 0.2 * i, 2.5 * std::sin(2.4 * i)};
    lamp.power = glm::dvec3(12) / static_cast<double>(lights);
    scene.lights.push_back(lamp);
  }
  Mesh mesh;
  for (unsigned j = 0; j < vertices; ++j) {
    for (unsigned i = 0; i < vertices; ++i) {
      const float x = 8 * static_cast<float>(i) / static_cast<float>(vertices - 1) - 4;
      const float z = 7 * static_cast<float>(j) / static_cast<float>(vertices - 1) - 5;
      mesh.positions.emplace_back(x, 0.1F * std::sin(3 * x) * std::cos(2 * z), z);
      mesh.normals.push_back(
          glm::normalize(glm::vec3(-0.3F * std::cos(3 * x) * std::cos(2 * z), 1, 0.2F * std::sin(3 * x) * std::sin(2 * z))));
    }
  }
  for (unsigned j = 0; j + 1 < vertices; ++j) {
    for (unsigned i = 0; i + 1 < vertices; ++i) {
      const unsigned k = j * vertices + i;
      mesh.triangles.emplace_back(k, k + vertices, k + 1);
      mesh.triangles.emplace_back(k + 1, k + vertices, k + vertices + 1);
    }
  }
  Surface hills;
  hills.mesh = std::make_shared<const Mesh>(std::move(mesh));
  hills.casts_shadow = false;
  scene.surfaces = {hills};
  return scene;
}

struct Times {
  double frame = 0, volumes = 0, airlight = 0;  // [ms]; the steps' of all threads together
};

RenderSettings settings_of(Extent extent, const char* light_path, const char* samples) {
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.knobs = {{"light_path", light_path}, {"samples", samples}};
  settings.resolution = extent;
  return settings;
}

// Of a camera that moves, and of lights and Gaussians that do.
Times frame_times(Renderer& renderer, const Scene& loaded, const RenderSettings& settings, bool all_moves, int frames) {
  std::vector<double> frame, volumes, airlight;
  for (int i = -1; i < frames; ++i) {
    Scene scene = loaded;
    const double change = 1e-4 * (i + 2);
    scene.camera.position.x += change;
    if (all_moves) {
      for (LightSource& l : scene.lights) l.position.y += change;
      for (std::size_t g = 0; g < scene.medium.gaussians.size(); ++g)
        scene.medium.gaussians[g].center.y += (g % 2 == 0 ? 1 : -1) * change;
    }
    const auto start = std::chrono::steady_clock::now();
    const Frame made = renderer.render(scene, settings);
    if (i < 0) continue;
    frame.push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    double of_volumes = 0, of_airlight = 0;
    for (const StepStats& s : made.stats.steps) {
      if (s.reused) continue;
      if (s.name == "density_injection" || s.name == "optical_depth_propagation") of_volumes += 1e3 * s.seconds;
      if (s.name == "gaussian_airlight" || s.name == "projected_gaussians") of_airlight += 1e3 * s.seconds;
    }
    volumes.push_back(of_volumes), airlight.push_back(of_airlight);
  }
  return {median(frame), median(volumes), median(airlight)};
}

Times frame_times(const Scene& scene, const RenderSettings& settings, bool all_moves, int frames) {
  Renderer renderer({.backend = "cpu"});
  return frame_times(renderer, scene, settings, all_moves, frames);
}

double relative_rmse(const HostImage& image, const HostImage& truth) {
  double error = 0, power = 0;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    const auto t = static_cast<double>(truth.values[i]), d = static_cast<double>(image.values[i]) - t;
    error += d * d, power += t * t;
  }
  return std::sqrt(error / power);
}

HostImage image_of(const Scene& scene, RenderSettings settings, const char* name) {
  settings.images = {name};
  Renderer renderer({.backend = "cpu", .keep = 0});
  return renderer.render(scene, settings).image(name);
}

// Brighter above, and around the sun.
Environment sky() {
  HostImage image({64, 32}, 3);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float up = 1 - static_cast<float>(y) / 31, beside = static_cast<float>(std::abs(x - 40) + std::abs(y - 8));
      const float sun = 6 * std::exp(-0.3F * beside);
      image.values[image.index(x, y, 0)] = 0.2F + 0.4F * up + sun;
      image.values[image.index(x, y, 1)] = 0.25F + 0.5F * up + 0.8F * sun;
      image.values[image.index(x, y, 2)] = 0.3F + 0.8F * up + 0.5F * sun;
    }
  }
  return {.image = std::make_shared<const HostImage>(std::move(image))};
}

void table_one() {
  fmt::print("Zhou et al., table 1, 800 x 600: frames a second by airlight_resolution; the paper's has airlight at a quarter\n");
  fmt::print("{:>10} {:>7} {:>9} {:>8} {:>12} {:>16} {:>16}\n", "Gaussians", "lights", "vertices", "paper", "airlight",
             "only the camera", "all moves");
  // Without lights: under an environment, which the hills hide from each other by precomputed transfer.
  const auto row = [](int gaussians, int lights, unsigned side, int paper) {
    Scene scene = steam(gaussians, lights, side);
    if (lights == 0) scene.environment = sky(), scene.surfaces[0].casts_shadow = true;
    Renderer renderer({.backend = "cpu"});  // one, for what surfaces hide takes seconds to find
    for (const char* resolution : {"full", "half", "quarter"}) {
      RenderSettings settings = settings_of(full, "auto", "4");
      settings.knobs.emplace_back("airlight_resolution", resolution);
      fmt::print("{:10} {:7} {:9} {:8} {:>12} {:16.1f} {:16.1f}\n", gaussians, lights, side * side, paper, resolution,
                 1e3 / frame_times(renderer, scene, settings, false, 5).frame,
                 1e3 / frame_times(renderer, scene, settings, true, 5).frame);
    }
  };
  row(34, 3, 279, 101);
  row(3008, 1, 100, 34);
  row(292, 0, 255, 92);
  row(353, 0, 278, 162);
  row(1223, 0, 211, 31);
}

// Of the steps of a frame of a camera that has moved: those that take most.
void dearest_steps(Renderer& renderer, Scene scene, const RenderSettings& settings) {
  scene.camera.position.x += 0.01;
  std::vector<StepStats> steps = renderer.render(scene, settings).stats.steps;
  std::erase_if(steps, [](const StepStats& s) { return s.reused; });
  std::sort(steps.begin(), steps.end(), [](const StepStats& a, const StepStats& b) { return a.seconds > b.seconds; });
  double all = 0;
  for (const StepStats& s : steps) all += s.seconds;
  std::string told;
  for (std::size_t i = 0; i < std::min<std::size_t>(steps.size(), 6); ++i)
    told += fmt::format("{}{} {:.0f} %", i > 0 ? ", " : "", steps[i].name, 100 * steps[i].seconds / all);
  fmt::print("{:>10} thread time by default: {}\n", "", told);
}

// The rows under an environment, by where mean depths are found; all ways of a row in turns, and what surfaces send beside that
// with a depth a pixel.
void environment_depths() {
  fmt::print(
      "\nMean depths under an environment, 800 x 600, by environment_depth and environment_cells: least frame ms of three in "
      "turns,\nof a camera that moves and of Gaussians that do, beside a depth a pixel; relative RMSE of what surfaces send to "
      "that "
      "in percent\n");
  fmt::print("{:>10} {:>12} {:>10} {:>10} {:>8} {:>10} {:>8} {:>10}\n", "Gaussians", "depth", "only cam.", "all moves", "ratio",
             "ratio", "RMSE", "largest");
  struct Way {
    const char *depth, *cells;
    Times camera{1e300}, all{1e300};
  };
  for (const auto& [gaussians, side] : {std::pair(292, 255U), std::pair(353, 278U), std::pair(1223, 211U)}) {
    Scene scene = steam(gaussians, 0, side);
    scene.environment = sky(), scene.surfaces[0].casts_shadow = true;
    const auto with = [&](const Way& way, Extent extent) {
      RenderSettings settings = settings_of(extent, "auto", "4");
      settings.knobs.emplace_back("environment_depth", way.depth);
      settings.knobs.emplace_back("environment_cells", way.cells);
      return settings;
    };
    std::vector<Way> ways{{"pixel", "3"},   {"lattice", "1"}, {"lattice", "2"},
                          {"lattice", "3"}, {"lattice", "4"}, {"object", "3"}};
    Renderer renderer({.backend = "cpu"});  // one, for what surfaces hide takes seconds to find
    for (int turn = 0; turn < 3; ++turn) {
      for (Way& way : ways) {
        way.camera.frame = std::min(way.camera.frame, frame_times(renderer, scene, with(way, full), false, 2).frame);
        way.all.frame = std::min(way.all.frame, frame_times(renderer, scene, with(way, full), true, 2).frame);
      }
    }
    HostImage truth;
    for (const Way& way : ways) {
      RenderSettings settings = with(way, quarter);
      settings.images = {"surface"};
      const Frame frame = renderer.render(scene, settings);
      const HostImage& image = frame.image("surface");
      if (truth.values.empty()) truth = image;
      float most = 0;
      for (std::size_t i = 0; i < truth.values.size(); ++i) most = std::max(most, std::fabs(image.values[i] - truth.values[i]));
      fmt::print("{:10} {:>10} {:1} {:10.1f} {:10.1f} {:8.2f} {:8.2f} {:10.3f} {:10.3f}\n", gaussians, way.depth,
                 way.depth == std::string_view("lattice") ? way.cells : "", way.camera.frame, way.all.frame,
                 way.camera.frame / ways[0].camera.frame, way.all.frame / ways[0].all.frame, 100 * relative_rmse(image, truth),
                 100 * static_cast<double>(most / *std::max_element(truth.values.begin(), truth.values.end())));
    }
    dearest_steps(renderer, scene, settings_of(full, "auto", "4"));
  }
}

// The least of repetitions.
double seconds(const std::function<void()>& work) {
  double best = 1e300, all = 0;
  do {
    const auto start = std::chrono::steady_clock::now();
    work();
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::min(best, took), all += took;
  } while (all < 0.2);
  return best;
}

// The paper's T(v, b_i), section 5.1, of Gaussians in a cube before the place.
void center_depths() {
  for (const bool touching : {false, true}) {
    fmt::print("\nOptical depths from a place to the centres of all Gaussians: one core, {}\n",
               touching ? "radii that shrink with the cube root of n, so that as many overlap in space"
                        : "radii that shrink with the square root of n, so that as many stand in a way");
    fmt::print("{:>10} {:>12} {:>14} {:>12} {:>10} {:>12} {:>10}\n", "Gaussians", "sweep [ms]", "pairs visited", "of a centre",
               "exponent", "n^2 sum [ms]", "ratio");
    double last = 0, last_n = 0;
    for (const int n : {10, 30, 100, 300, 1000, 3000, 10000, 30000, 100000, 300000}) {
      if (touching && n > 100000) continue;
      Scene scene;
      const double radius = touching ? 0.15 / std::cbrt(n) : 0.3 / std::sqrt(n);
      for (int i = 0; i < n; ++i) {
        const auto number = [&](std::uint32_t k) { return 2 * uniform(902, 3 * static_cast<std::uint32_t>(i) + k) - 1; };
        scene.medium.gaussians.push_back({.center = {number(0), number(1), number(2) - 4}, .radius = radius, .extinction = 1});
      }
      const std::vector<GaussianDensity> all = gaussians_of(scene, {0, 0, 0});
      std::uint64_t visited = 0;
      const double sweep = 1e3 * seconds([&] { visited = depths_to_centers(all).visited; });
      std::string exponent, sum, ratio;
      if (last > 0) exponent = fmt::format("{:.2f}", std::log(sweep / last) / std::log(n / last_n));
      if (n <= 10000) {
        double depths = 0;
        const double plain = 1e3 * seconds([&] {
                               for (const GaussianDensity& g : all) depths += depth_to(all, g.center);
                             });
        if (!(depths > 0)) fmt::print("no depth\n");
        sum = fmt::format("{:.3f}", plain), ratio = fmt::format("{:.2f}", plain / sweep);
      }
      fmt::print("{:10} {:12.3f} {:14} {:12.1f} {:>10} {:>12} {:>10}\n", n, sweep, visited, static_cast<double>(visited) / n,
                 exponent, sum, ratio);
      last = sweep, last_n = n;
    }
  }
}

void light_paths() {
  fmt::print(
      "\nThe way to one lamp by closed forms and by volume, 200 x 150, default knobs: frame ms when all moves, thread ms of "
      "volumes and\n"
      "airlight, relative RMSE of the airlight to closed forms and 12 nodes in percent; the paper's own airlight has "
      "none\n");
  fmt::print("{:>10} {:>8} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "Gaussians", "path", "frame", "only cam.", "volumes",
             "airlight", "RMSE", "12 nodes");
  for (const int n : {4, 10, 30, 100, 300, 1000, 3000, 10000}) {
    const Scene scene = steam(n, 1, 40);
    const Extent small{40, 30};
    const HostImage truth = image_of(scene, settings_of(small, "exact", "12"), "airlight");
    for (const char* path : {"exact", "volume", "published"}) {
      if (n > 3000 && std::string_view(path) == "exact") continue;
      const RenderSettings settings = settings_of(quarter, path, "4");
      const Times all = frame_times(scene, settings, true, 3), camera = frame_times(scene, settings, false, 3);
      fmt::print("{:10} {:>8} {:10.1f} {:10.1f} {:10.1f} {:10.1f} {:10.3f} {:10.3f}\n", n, path, all.frame, camera.frame,
                 all.volumes, all.airlight,
                 100 * relative_rmse(image_of(scene, settings_of(small, path, "4"), "airlight"), truth),
                 100 * relative_rmse(image_of(scene, settings_of(small, path, "12"), "airlight"), truth));
    }
  }
}

// What a scene does not need, beside the same scene that needs it.
void skips() {
  fmt::print("\nWhat skips gain, 400 x 300, 300 Gaussians, 3 lamps, 4 nodes: frame ms with and without what is skipped\n");
  fmt::print("{:<58} {:>10} {:>10} {:>8}\n", "", "with", "without", "ratio");
  const Extent half{400, 300};
  const auto row = [&](const char* what, const Scene& with, const Scene& without, bool all_with, bool all_without) {
    const RenderSettings settings = settings_of(half, "auto", "4");
    const double a = frame_times(with, settings, all_with, 5).frame, b = frame_times(without, settings, all_without, 5).frame;
    fmt::print("{:<58} {:10.1f} {:10.1f} {:8.2f}\n", what, a, b, a / b);
  };
  const Scene whole = steam(300, 3, 100);
  Scene changed = whole;
  changed.camera.look_at = {0, 1.6, 20};
  row("Gaussians behind the camera", whole, changed, true, true);
  changed = whole;
  for (std::size_t i = 0; i < changed.medium.gaussians.size(); i += 2) changed.medium.gaussians[i].extinction = 0;
  row("half of the Gaussians without extinction", whole, changed, true, true);
  changed = whole;
  changed.lights[1].power = changed.lights[2].power = glm::dvec3(0);
  row("two of the lights without power", whole, changed, true, true);
  changed = whole;
  changed.medium.extinction = 0.01;
  row("homogeneous fog", changed, whole, true, true);
  changed = whole;
  changed.medium.noise = {.amplitude = 0.2, .scale = 0.4};
  row("noise", changed, whole, true, true);
  row("depths toward lights when only the camera moves", whole, whole, true, false);
}

}  // namespace

}  // namespace airlight

// Names of tables make these alone.
int main(int count, char** names) {
  const std::pair<std::string_view, void (*)()> tables[] = {{"table-one", airlight::table_one},
                                                            {"environment-depths", airlight::environment_depths},
                                                            {"light-paths", airlight::light_paths},
                                                            {"skips", airlight::skips},
                                                            {"center-depths", airlight::center_depths}};
  for (const auto& [name, make] : tables) {
    if (count == 1 || std::find(names + 1, names + count, name) != names + count) make();
  }
  return 0;
}
