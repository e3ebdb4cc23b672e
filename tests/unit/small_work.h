// A small scene with a setting for everything, and what edits put into it.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/airlight.h"

namespace airlight {

// All that a frame depends on.
struct Work {
  Scene scene;
  RenderSettings settings;  // technique and resolution are said
  void set(const std::string& knob, const std::string& value);
};

// A lamp and a sun, a floor and a box, fog, and Gaussians where the technique renders them; knobs that make it quick.
Work small_work(std::string_view technique);

// Small values of all knobs that count something; the first is where a work begins.
const std::map<std::string_view, std::vector<std::string>>& small_numbers();

std::shared_ptr<const Mesh> small_box();
LightSource small_lamp(const glm::dvec3& position);
Gaussian small_blob(const glm::dvec3& center);
GridMedium small_grid();
std::shared_ptr<const HostImage> small_sky();
std::shared_ptr<const Brdf> small_brdf();

}  // namespace airlight
