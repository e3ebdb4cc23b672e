// `airlight info FILE`: what is in a file that a scene may name, or in a scene.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <glm/vec4.hpp>
#include <limits>

#include "app/command.h"
#include "common/scene/gaussians_file.h"
#include "common/scene/gltf_scene.h"
#include "common/scene/nrrd_file.h"
#include "common/scene/sparse_grid.h"
#include "common/scene/vdb_summary.h"

namespace airlight {

namespace {

std::string text(const glm::dvec3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

// A box that grows by what is put into it.
struct Box {
  glm::dvec3 least{std::numeric_limits<double>::infinity()}, most{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p) { least = glm::min(least, p), most = glm::max(most, p); }
  void print() const { fmt::print("  box {} to {} m\n", text(least), text(most)); }
};

void print_cells(const glm::ivec3& least, const glm::ivec3& most, const glm::dmat4& transform) {
  const glm::ivec3 size = most - least + 1;
  fmt::print("  cells ({}, {}, {}) to ({}, {}, {}), {} x {} x {}\n", least.x, least.y, least.z, most.x, most.y, most.z, size.x,
             size.y, size.z);
  Box box;
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 cell;
    for (int k = 0; k < 3; ++k) cell[k] = (corner >> k & 1) != 0 ? most[k] + 0.5 : least[k] - 0.5;
    box.add(glm::dvec3(transform * glm::dvec4(cell, 1)));
  }
  box.print();
  fmt::print("  transform x {}, y {}, z {}, origin {}\n", text(transform[0]), text(transform[1]), text(transform[2]),
             text(transform[3]));
}

void info_of_vdb(const std::string& path, Progress& progress) {
  for (const VdbSummary& s : summarise_vdb(path, progress)) {
    fmt::print("grid \"{}\": {}{}{}{}\n", s.name, s.type, s.half ? ", stored in 16 bits" : "", s.grid_class.empty() ? "" : ", ",
               s.grid_class);
    if (!s.unread.empty()) {
      fmt::print("  {}\n", s.unread);
      continue;
    }
    fmt::print("  {} active cells\n", s.active);
    if (s.active == 0) continue;
    fmt::print("  {} {:.6g} to {:.6g}\n", s.type.starts_with("vec") ? "lengths" : "values", s.lowest, s.highest);
    print_cells(s.least, s.most, s.transform);
  }
}

void info_of_nrrd(const std::string& path, Progress& progress) {
  const SparseGrid grid = read_sparse_grid(path, "", progress);
  float highest = 0;
  std::uint64_t cells = 0;
  for (const GridBlock& b : grid.blocks) {
    for (const float v : b.values) highest = std::max(highest, v), cells += v > 0 ? 1 : 0;
  }
  fmt::print("grid: {} cells above 0\n  values up to {:.6g}\n", cells, highest);
  print_cells(grid.least, grid.most, grid.transform);
}

void info_of_gaussians(const std::string& path, Progress& progress) {
  const GaussiansFile file = read_gaussians_file(path, progress);
  fmt::print("{} {}{}{}\n", file.gaussians.size(), file.splats ? "Gaussian splats" : "Gaussians",
             file.has_albedo ? ", with albedo" : "", file.has_emission ? ", with emission" : "");
  if (!file.unused_columns.empty()) {
    std::string names;
    for (const std::string& n : file.unused_columns) names += (names.empty() ? "" : " ") + n;
    fmt::print("  columns that are not used: {}\n", names);
  }
  if (file.gaussians.empty()) return;
  Box box;
  double thin = std::numeric_limits<double>::infinity(), thick = 0, small = thin, large = 0;
  for (const Gaussian& g : file.gaussians) {
    box.add(g.center - g.radius), box.add(g.center + g.radius);
    thin = std::min(thin, g.extinction), thick = std::max(thick, g.extinction);
    small = std::min(small, g.radius), large = std::max(large, g.radius);
  }
  box.print();
  fmt::print("  radius {:.6g} to {:.6g} m, extinction {:.6g} to {:.6g} 1/m\n", small, large, thin, thick);
}

void info_of_mesh(const std::string& path, Progress& progress) {
  const std::shared_ptr<const Mesh> mesh = load_mesh(path, false, progress);
  fmt::print("mesh: {} triangles, {} vertices\n", mesh->triangles.size(), mesh->positions.size());
  Box box;
  for (const glm::vec3& p : mesh->positions) box.add(glm::dvec3(p));
  box.print();
}

void info_of_scene(const std::string& path, Progress& progress) {
  SceneFile file(path);
  const FrameRange frames = file.frames();
  const Scene scene = file.scene(frames.first, progress);
  const Medium& m = scene.medium;
  if (file.animated()) {
    fmt::print("frames {}-{}\ntracks {}\n", frames.first, frames.last, file.tracks());
    for (const std::string& name : file.numbered_files()) fmt::print("a file a frame: {}\n", name);
  }
  fmt::print("resolution {}x{}\n", scene.camera.resolution.width, scene.camera.resolution.height);
  fmt::print("lights {}{}\n", scene.lights.size(), scene.environment ? " and an environment" : "");
  fmt::print("medium: extinction {} 1/m, {} Gaussians", m.extinction, m.gaussians.size());
  if (m.grid)
    fmt::print(", a grid of {} x {} x {} cells", m.grid->voxels->size.x, m.grid->voxels->size.y, m.grid->voxels->size.z);
  std::size_t triangles = 0;
  for (const Surface& s : scene.surfaces) triangles += s.mesh->triangles.size();
  fmt::print("\nsurfaces {}, {} triangles\n", scene.surfaces.size(), triangles);
  for (const std::string& note : gltf_notes(path)) fmt::print("{}\n", note);
}

}  // namespace

int info_of_file(const std::string& path, Progress& progress) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (extension == ".json" || extension == ".gltf" || extension == ".glb") {
    info_of_scene(path, progress);
  } else if (extension == ".vdb") {
    info_of_vdb(path, progress);
  } else if (extension == ".nrrd") {
    info_of_nrrd(path, progress);
  } else if (extension == ".csv" || (extension == ".ply" && is_gaussians_ply(path))) {
    info_of_gaussians(path, progress);
  } else {
    info_of_mesh(path, progress);
  }
  return 0;
}

}  // namespace airlight
