// A scene built in code, two frames of it, one image file.
#include <cstdio>

#include "app/airlight.h"

int main() {
  airlight::Scene scene;
  scene.camera.position = {0, 1, 5};
  scene.camera.look_at = {0, 1, 0};
  scene.camera.resolution = {160, 120};
  scene.medium.extinction = 0.1;
  airlight::LightSource lamp;
  lamp.position = {1, 2, 0};
  lamp.power = {10, 8, 5};
  scene.lights.push_back(lamp);

  airlight::Renderer renderer({.backend = "cpu"});
  airlight::RenderSettings settings;
  settings.images = {"beauty", "surface", "depth"};  // what is asked for is kept, and reused below
  const airlight::Frame frame = renderer.render(scene, settings);
  const airlight::HostImage& beauty = frame.image("beauty");
  std::printf("%s: %d x %d pixels, the middle one has %g W/m^2/sr of red\n", frame.device.c_str(), beauty.extent.width,
              beauty.extent.height, static_cast<double>(beauty.at(80, 60, 0)));
  airlight::write_image("lamp.exr", beauty, {});

  scene.medium.albedo = {0.5, 0.5, 0.5};  // surfaces do not depend on it: only the airlight is computed again
  const airlight::Frame second = renderer.render(scene, settings);
  for (const airlight::StepStats& step : second.stats.steps)
    std::printf("%s%s\n", step.name.c_str(), step.reused ? " reused" : "");
  return beauty.at(80, 60, 0) > 0 ? 0 : 1;
}
