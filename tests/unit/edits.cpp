#include "tests/unit/edits.h"

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "common/plan/image_names.h"
#include "common/techniques/technique.h"
#include "tests/unit/small_work.h"

namespace airlight {

namespace {

using Edit = bool (*)(Edits&, Work&);  // whether there was something to change

bool change_knob(Edits& e, Work& w) {
  const std::vector<Knob>& knobs = technique(w.settings.technique).knobs;
  const Knob& knob = knobs[e.below(knobs.size())];
  if (knob.kind == Knob::Kind::choice) {
    w.set(std::string(knob.name), std::string(knob.choices[e.below(knob.choices.size())]));
  } else {
    const std::vector<std::string>& values = small_numbers().at(knob.name);
    w.set(std::string(knob.name), values[e.below(values.size())]);
  }
  return true;
}

bool change_images(Edits& e, Work& w) {
  const std::vector<std::string> names = image_names(w.scene);
  w.settings.images = {"beauty"};
  for (int i = 0; i < 2; ++i) {
    const std::string& name = names[e.below(names.size())];
    if (std::find(w.settings.images.begin(), w.settings.images.end(), name) == w.settings.images.end())
      w.settings.images.push_back(name);
  }
  return true;
}

bool change_mesh(Edits& e, Work& w) {
  if (w.scene.surfaces.empty()) return false;
  Surface& surface = e.one_of(w.scene.surfaces);
  auto mesh = std::make_shared<Mesh>(*surface.mesh);
  switch (e.below(3)) {
    case 0:  // a vertex that no triangle has: those of the next surface have other numbers
      mesh->positions.insert(mesh->positions.begin() + static_cast<std::ptrdiff_t>(mesh->positions.size()), glm::vec3(0));
      mesh->normals.emplace_back(0, 1, 0);
      break;
    case 1:
      mesh->positions[e.below(mesh->positions.size())] += glm::vec3(0.05F, 0, 0.1F);
      break;
    default:
      if (mesh->triangles.size() > 1) mesh->triangles.pop_back();
  }
  surface.mesh = mesh;
  return true;
}

bool change_gaussian(Edits& e, Work& w) {
  if (w.scene.medium.gaussians.empty()) return false;
  Gaussian& g = e.one_of(w.scene.medium.gaussians);
  switch (e.below(5)) {
    case 0:
      g.center += e.place(0.2);
      break;
    case 1:
      g.extinction = e.one_of({0.0, 0.4, 2.0});
      break;
    case 2:
      g.radius = e.between(0.3, 0.7);
      break;
    case 3:
      g.albedo = e.colour();
      break;
    default:
      g.emission = g.emission == glm::dvec3(0) ? e.colour() : glm::dvec3(0);
  }
  return true;
}

constexpr std::pair<std::string_view, Edit> edits[] = {
    {"nothing", [](Edits&, Work&) { return true; }},
    {"camera moves", [](Edits& e, Work& w) { return w.scene.camera.position += e.place(0.2), true; }},
    {"camera turns", [](Edits& e, Work& w) { return w.scene.camera.look_at += e.place(0.2), true; }},
    {"camera zooms", [](Edits& e, Work& w) { return w.scene.camera.vertical_fov = e.between(30, 60), true; }},
    {"light moves",
     [](Edits& e, Work& w) {
       if (w.scene.lights.empty()) return false;
       LightSource& light = e.one_of(w.scene.lights);
       light.position += e.place(0.3);
       light.direction = glm::normalize(light.direction + e.place(0.1));
       return true;
     }},
    {"light dims",
     [](Edits& e, Work& w) {
       return !w.scene.lights.empty() && (e.one_of(w.scene.lights).power *= e.one_of({0.5, 2.0}), true);
     }},
    {"light goes out",
     [](Edits& e, Work& w) { return !w.scene.lights.empty() && (e.one_of(w.scene.lights).power *= 0.0, true); }},
    {"light of another kind",
     [](Edits& e, Work& w) {
       if (w.scene.lights.empty()) return false;
       LightSource& light = e.one_of(w.scene.lights);
       light.type = light.type == LightType::point ? LightType::directional : LightType::point;
       return true;
     }},
    {"light is added",
     [](Edits& e, Work& w) {
       return w.scene.lights.size() < 4 && (w.scene.lights.push_back(small_lamp(e.place(1) + glm::dvec3(0, 2, 1))), true);
     }},
    {"light is removed",
     [](Edits& e, Work& w) {
       if (w.scene.lights.empty()) return false;
       w.scene.lights.erase(w.scene.lights.begin() + static_cast<std::ptrdiff_t>(e.below(w.scene.lights.size())));
       w.settings.images = {"beauty"};
       return true;
     }},
    {"Gaussian", change_gaussian},
    {"Gaussians are added",
     [](Edits& e, Work& w) {
       if (!e.uneven() || w.scene.medium.gaussians.size() > 20) return false;
       for (std::size_t n = e.one_of({1U, 5U, 13U}); n > 0; --n) w.scene.medium.gaussians.push_back(small_blob(e.place(0.8)));
       return true;
     }},
    {"Gaussians are removed",
     [](Edits& e, Work& w) {
       auto& all = w.scene.medium.gaussians;
       if (all.empty()) return false;
       all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(1 + e.below(all.size())));
       return true;
     }},
    {"grid comes or goes",
     [](Edits& e, Work& w) {
       if (!e.grids()) return false;
       if (w.scene.medium.grid) {
         w.scene.medium.grid.reset();
       } else {
         w.scene.medium.grid = small_grid();
       }
       return true;
     }},
    {"grid",
     [](Edits& e, Work& w) {
       if (!w.scene.medium.grid) return false;
       GridMedium& grid = *w.scene.medium.grid;
       if (e.below(2) == 0) grid.scale = e.between(0.5, 2);
       grid.transform = glm::translate(grid.transform, e.place(0.1));
       if (e.below(2) == 0) grid.albedo = e.colour();
       return true;
     }},
    {"surface moves",
     [](Edits& e, Work& w) {
       if (w.scene.surfaces.empty()) return false;
       Surface& surface = e.one_of(w.scene.surfaces);
       surface.transform = glm::rotate(glm::translate(surface.transform, e.place(0.1)), 0.1, glm::dvec3(0, 1, 0));
       return true;
     }},
    {"mesh", change_mesh},
    {"surface casts a shadow or not",
     [](Edits& e, Work& w) {
       if (w.scene.surfaces.empty()) return false;
       Surface& surface = e.one_of(w.scene.surfaces);
       surface.casts_shadow = !surface.casts_shadow;
       return true;
     }},
    {"surface comes or goes",
     [](Edits& e, Work& w) {
       if (w.scene.surfaces.size() > 2 || (!w.scene.surfaces.empty() && e.below(2) == 0)) {
         w.scene.surfaces.pop_back();
       } else {
         w.scene.surfaces.emplace_back();
         w.scene.surfaces.back().mesh = small_box();
         w.scene.surfaces.back().transform[3] = glm::dvec4(e.place(0.8), 1);
       }
       return true;
     }},
    {"material",
     [](Edits& e, Work& w) {
       if (w.scene.surfaces.empty()) return false;
       Surface& surface = e.one_of(w.scene.surfaces);
       surface.material.diffuse = e.colour();
       surface.material.specular = glm::vec3(e.one_of({0.0F, 0.2F}));
       surface.material.shininess = e.one_of({5.0F, 20.0F});
       surface.brdf = e.below(4) == 0 ? small_brdf() : nullptr;
       return true;
     }},
    {"phase function",
     [](Edits& e, Work& w) {
       const PhaseKind kind = e.one_of({PhaseKind::isotropic, PhaseKind::rayleigh, PhaseKind::henyey_greenstein});
       w.scene.medium.phase = {kind, kind == PhaseKind::henyey_greenstein ? e.one_of({0.3, -0.2}) : 0};
       return true;
     }},
    {"fog",
     [](Edits& e, Work& w) {
       return w.scene.medium.extinction = e.one_of({0.0, 0.05, 0.2, 40.0}), true;
     }},
    {"albedo", [](Edits& e, Work& w) { return w.scene.medium.albedo = e.below(3) == 0 ? glm::dvec3(0) : e.colour(), true; }},
    {"ambient light",
     [](Edits& e, Work& w) { return w.scene.medium.ambient = e.below(2) == 0 ? glm::dvec3(0) : e.colour(), true; }},
    {"emission", [](Edits& e, Work& w) { return w.scene.medium.emission = e.below(2) == 0 ? glm::dvec3(0) : e.colour(), true; }},
    {"distance of the sky",
     [](Edits& e, Work& w) {
       return w.scene.sky_distance = e.one_of({20.0, 30.0, 1e40}), true;
     }},
    {"background", [](Edits& e, Work& w) { return !w.scene.environment && (w.scene.background = e.colour(), true); }},
    {"noise",
     [](Edits& e, Work& w) {
       if (w.settings.technique != "gaussian-airlight") return false;
       w.scene.medium.noise = {e.one_of({0.0, 0.4}), e.between(0.2, 0.4), e.place(1)};
       return true;
     }},
    {"environment comes or goes",
     [](Edits& e, Work& w) {
       if (w.scene.environment) {
         w.scene.environment.reset();
       } else {
         w.scene.environment = Environment{e.below(2) == 0 ? small_sky() : nullptr, {0.3, 0.4, 0.5}, 0};
         w.scene.background = {0, 0, 0};
       }
       w.settings.images = {"beauty"};
       return true;
     }},
    {"environment turns",
     [](Edits& e, Work& w) { return w.scene.environment && (w.scene.environment->rotation += e.between(5, 50), true); }},
    {"environment dims", [](Edits&, Work& w) { return w.scene.environment && (w.scene.environment->radiance *= 0.9, true); }},
    {"setting", change_knob},
    {"setting again", change_knob},
    {"images", change_images},
    {"resolution",
     [](Edits& e, Work& w) {
       return w.settings.resolution = e.one_of({Extent{16, 12}, Extent{16, 12}, Extent{12, 16}, Extent{70, 4}}), true;
     }},
};

}  // namespace

std::string_view Edits::next(Work& work) {
  constexpr std::size_t count = std::size(edits);
  for (;;) {
    const std::size_t kind = below(count + 3);
    if (kind >= count) {
      if (history_.empty()) continue;
      const std::size_t back = 1 + below(std::min<std::size_t>(history_.size(), 4));
      const Work before = work;
      work = history_[history_.size() - back];
      history_.push_back(before);
      return "undo";
    }
    const Work before = work;
    if (!edits[kind].second(*this, work)) continue;
    history_.push_back(before);
    return edits[kind].first;
  }
}

}  // namespace airlight
