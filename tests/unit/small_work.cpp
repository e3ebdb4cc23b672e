#include "tests/unit/small_work.h"

#include <glm/geometric.hpp>

#include "common/techniques/technique.h"
#include "tests/parity/inputs.h"

namespace airlight {

const std::map<std::string_view, std::vector<std::string>>& small_numbers() {
  static const std::map<std::string_view, std::vector<std::string>> all{
      {"table_nodes", {"16", "17"}},     {"samples", {"2", "3"}},
      {"lost_depth", {"1e-3", "1e-4"}},  {"light_cells", {"1", "1.5"}},
      {"particles", {"60", "90"}},       {"directions", {"6", "9"}},
      {"iterations", {"30", "2"}},       {"tolerance", {"0.1", "1"}},
      {"resolution", {"6", "9"}},        {"steps", {"4", "6"}},
      {"light_steps", {"3", "5"}},       {"environment_rays", {"16", "20"}},
      {"environment_cells", {"1", "2"}}, {"environment_blocks", {"2", "3"}},
      {"splat_radius", {"0.8", "1"}}};
  return all;
}

std::shared_ptr<const Mesh> small_box() {
  auto mesh = std::make_shared<Mesh>();
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1U ? 1 : -1, corner & 2U ? 1 : -1, corner & 4U ? 1 : -1);
    mesh->positions.push_back(p * 0.4F);
    mesh->normals.push_back(glm::normalize(p));
  }
  for (const glm::uvec4 q : {glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6), glm::uvec4(0, 1, 5, 4), glm::uvec4(2, 6, 7, 3),
                             glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5)}) {
    mesh->triangles.emplace_back(q.x, q.y, q.z);
    mesh->triangles.emplace_back(q.x, q.z, q.w);
  }
  return mesh;
}

LightSource small_lamp(const glm::dvec3& position) {
  LightSource light;
  light.position = position;
  light.power = {8, 6, 4};
  return light;
}

Gaussian small_blob(const glm::dvec3& center) { return {.center = center, .radius = 0.5, .extinction = 0.8}; }

GridMedium small_grid() {
  auto voxels = std::make_shared<VoxelGrid>();
  voxels->size = {3, 2, 2};
  voxels->values = {0, 1, 0.5F, 0, 0.2F, 1, 0.7F, 0, 0, 1, 0.1F, 0.4F};
  GridMedium grid;
  grid.voxels = voxels;
  grid.transform[3] = glm::dvec4(-1.5, -0.5, -1, 1);
  return grid;
}

std::shared_ptr<const HostImage> small_sky() {
  auto sky = std::make_shared<HostImage>(Extent{4, 2}, 3);
  for (std::size_t i = 0; i < sky->values.size(); ++i) sky->values[i] = 0.1F + 0.3F * static_cast<float>(i % 5);
  return sky;
}

std::shared_ptr<const Brdf> small_brdf() {
  auto brdf = std::make_shared<Brdf>();
  brdf->values.assign(24, 0.1F);
  brdf->values[3] = 0.3F;
  return brdf;
}

void Work::set(const std::string& knob, const std::string& value) {
  for (auto& [name, old] : settings.knobs) {
    if (name == knob) {
      old = value;
      return;
    }
  }
  settings.knobs.emplace_back(knob, value);
}

Work small_work(std::string_view name) {
  Work w;
  w.settings.technique = name;
  w.settings.resolution = Extent{16, 12};
  for (const Knob& knob : technique(name).knobs) {
    if (knob.kind != Knob::Kind::choice) w.set(std::string(knob.name), small_numbers().at(knob.name).front());
  }
  w.set("indirect", "off");  // its tables take longer to make than all else
  Scene& scene = w.scene;
  scene.camera = {.position = {0, 0.8, 4}, .look_at = {0, 0.2, 0}};
  scene.sky_distance = 30;
  scene.medium.extinction = 0.05;
  scene.lights = {small_lamp({1.2, 1.8, 1}), small_lamp({-2, 2, 0})};
  scene.lights[1].type = LightType::directional;
  scene.lights[1].direction = glm::normalize(glm::dvec3(0.4, -1, -0.2));
  scene.lights[1].power = {0.4, 0.4, 0.5};
  scene.surfaces.resize(2);
  scene.surfaces[0].mesh = square(1.2);
  scene.surfaces[0].transform[3] = glm::dvec4(0, -0.8, 0, 1);
  scene.surfaces[1].mesh = small_box();
  if (name != "shadow-planes") scene.medium.gaussians = {small_blob({0.3, 0.5, 0.4}), small_blob({-0.8, 0.3, -0.2})};
  return w;
}

}  // namespace airlight
