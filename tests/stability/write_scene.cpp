#include "tests/stability/write_scene.h"

#include <fmt/format.h>
#include <openvdb/Grid.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <fstream>

#include "common/scene/image_file.h"

namespace airlight {

namespace {

std::string text(const glm::dvec3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x, v.y, v.z); }

std::string text(const glm::dmat4& m) {
  std::string all = "[";
  for (int i = 0; i < 16; ++i) all += fmt::format("{}{:.17g}", i == 0 ? "" : ", ", m[i / 4][i % 4]);
  return all + "]";
}

void write_mesh(const std::string& path, const Mesh& mesh) {
  std::ofstream out(path);
  for (const glm::vec3& p : mesh.positions) out << fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
  for (const glm::vec3& n : mesh.normals) out << fmt::format("vn {:.9g} {:.9g} {:.9g}\n", n.x, n.y, n.z);
  for (const glm::uvec3& t : mesh.triangles) {
    out << 'f';
    for (int k = 0; k < 3; ++k) out << fmt::format(" {0}//{0}", t[k] + 1);
    out << '\n';
  }
}

void write_grid(const std::string& path, const VoxelGrid& voxels) {
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0);
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  auto accessor = grid->getAccessor();
  std::size_t i = 0;
  for (int z = 0; z < voxels.size.z; ++z) {
    for (int y = 0; y < voxels.size.y; ++y) {
      for (int x = 0; x < voxels.size.x; ++x) accessor.setValue(openvdb::Coord(x, y, z), voxels.values[i++]);
    }
  }
  openvdb::io::File(path).write({grid});
}

std::string_view name_of(PhaseKind kind) {
  static constexpr std::string_view names[] = {"isotropic",       "rayleigh", "henyey_greenstein",
                                               "cornette_shanks", "mie_hazy", "mie_murky"};
  return names[static_cast<int>(kind)];
}

std::string medium_text(const Medium& m) {
  std::string all = fmt::format("{{ \"phase\": {{ \"type\": \"{}\"", name_of(m.phase.kind));
  if (m.phase.kind == PhaseKind::henyey_greenstein || m.phase.kind == PhaseKind::cornette_shanks)
    all += fmt::format(", \"g\": {:.17g}", m.phase.g);
  all += fmt::format(
      " }},\n    \"albedo\": {}, \"ambient\": {}, \"emission\": {},\n    \"homogeneous\": {{ \"extinction\": {:.17g} }}",
      text(m.albedo), text(m.ambient), text(m.emission), m.extinction);
  std::string gaussians;
  for (const Gaussian& g : m.gaussians) {
    gaussians += fmt::format(
        "{}\n      {{ \"center\": {}, \"radius\": {:.17g}, \"extinction\": {:.17g}, \"albedo\": {}, \"emission\": {} }}",
        gaussians.empty() ? "" : ",", text(g.center), g.radius, g.extinction, text(g.albedo), text(g.emission));
  }
  if (!gaussians.empty()) all += ",\n    \"gaussians\": [" + gaussians + " ]";
  if (m.grid) {
    glm::dmat4 t = m.grid->transform;  // of the file's numbers, which stand at the centres of cells
    t[3] = t * glm::dvec4(0.5, 0.5, 0.5, 1);
    all += fmt::format(",\n    \"grid\": {{ \"file\": \"grid.vdb\", \"scale\": {:.17g}, \"albedo\": {}, \"transform\": {} }}",
                       m.grid->scale, text(m.grid->albedo), text(t));
  }
  return all + " }";
}

std::string light_text(const LightSource& l) {
  if (l.type == LightType::directional)
    return fmt::format("{{ \"type\": \"directional\", \"direction\": {}, \"irradiance\": {} }}", text(l.direction),
                       text(l.power));
  return fmt::format("{{ \"type\": \"point\", \"position\": {}, \"intensity\": {}, \"radius\": {:.17g} }}", text(l.position),
                     text(l.power), l.radius);
}

std::string surface_text(const Surface& s, const std::string& mesh) {
  return fmt::format(
      "{{ \"mesh\": \"{}\", \"transform\": {}, \"casts_shadow\": {},\n      \"material\": {{ \"diffuse\": {}, \"specular\": {}, "
      "\"shininess\": {:.9g} }} }}",
      mesh, text(s.transform), s.casts_shadow, text(glm::dvec3(s.material.diffuse)), text(glm::dvec3(s.material.specular)),
      s.material.shininess);
}

}  // namespace

void write_scene(const std::string& folder, const Scene& scene, const std::string& technique, const Settings& settings) {
  const Camera& c = scene.camera;
  std::string all = fmt::format(
      "{{ \"airlight\": 1,\n  \"camera\": {{ \"position\": {}, \"look_at\": {}, \"up\": {}, \"vertical_fov\": {:.17g}, "
      "\"resolution\": "
      "[{}, {}] }},\n",
      text(c.position), text(c.look_at), text(c.up), c.vertical_fov, c.resolution.width, c.resolution.height);
  if (std::isfinite(scene.sky_distance)) all += fmt::format("  \"sky_distance\": {:.17g},\n", scene.sky_distance);
  all += "  \"medium\": " + medium_text(scene.medium) + ",\n  \"lights\": [";
  std::string lights, surfaces;
  for (const LightSource& l : scene.lights) lights += (lights.empty() ? "\n    " : ",\n    ") + light_text(l);
  if (scene.environment) {
    const Environment& e = *scene.environment;
    lights += lights.empty() ? "\n    " : ",\n    ";
    if (e.image) write_image(folder + "/sky.pfm", *e.image, {});
    // Of an image one factor for all channels: that of red.
    lights +=
        e.image ? fmt::format("{{ \"type\": \"environment\", \"file\": \"sky.pfm\", \"scale\": {:.17g}, \"rotation\": {:.17g} }}",
                              e.radiance.x, e.rotation)
                : fmt::format("{{ \"type\": \"environment\", \"radiance\": {} }}", text(e.radiance));
  }
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const std::string mesh = fmt::format("mesh{}.obj", i);
    write_mesh(folder + "/" + mesh, *scene.surfaces[i].mesh);
    surfaces += (surfaces.empty() ? "\n    " : ",\n    ") + surface_text(scene.surfaces[i], mesh);
  }
  if (scene.medium.grid) write_grid(folder + "/grid.vdb", *scene.medium.grid->voxels);
  all += lights + " ],\n  \"surfaces\": [" + surfaces + " ],\n";
  if (!scene.environment) all += "  \"background\": " + text(scene.background) + ",\n";
  all += fmt::format("  \"technique\": {{ \"name\": \"{}\"", technique);
  for (const auto& [name, value] : settings) {
    const bool number = value.find_first_not_of("0123456789.e-+") == value.npos;
    all += number ? fmt::format(", \"{}\": {}", name, value) : fmt::format(", \"{}\": \"{}\"", name, value);
  }
  std::ofstream(folder + "/scene.json") << all + " } }\n";
}

}  // namespace airlight
