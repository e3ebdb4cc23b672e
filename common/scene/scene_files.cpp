#include "common/scene/scene_files.h"

#include <filesystem>
#include <string>
#include <system_error>

#include "common/error.h"
#include "common/scene/files.h"

namespace airlight {

template <class File, class Read>
std::shared_ptr<const File> SceneFiles::held(Files<File>& files, const Node& named, const std::string& how, Read&& read) const {
  const std::string path = resolved(directory_, named.string());
  std::error_code error;
  if (use == FileUse::look && !std::filesystem::exists(path, error)) named.fail(path + ": no such file");
  if (use != FileUse::read) return nullptr;
  Held<File>& one = files[{path, how}];
  one.asked = true;
  if (one.file) return one.file;
  try {
    one.file = std::make_shared<const File>(read(path));
  } catch (const InputError& e) {
    named.fail(e.what());
  }
  return one.file;
}

std::shared_ptr<const MeshFile> SceneFiles::mesh(const Node& named, bool flat, int part, Progress& progress) {
  const std::string how = std::string(flat ? "flat" : "") + std::to_string(part);
  return held(meshes_, named, how, [&](const std::string& path) { return read_mesh_file(path, flat, part, progress); });
}

std::shared_ptr<const BrdfFile> SceneFiles::brdf(const Node& named) { return held(brdfs_, named, "", read_brdf_file); }

std::shared_ptr<const GridFile> SceneFiles::grid(const Node& named, const std::string& name, Progress& progress) {
  return held(grids_, named, name, [&](const std::string& path) { return read_grid_file(path, name, progress); });
}

std::shared_ptr<const EnvironmentFile> SceneFiles::environment(const Node& named) {
  return held(environments_, named, "", read_environment_file);
}

std::shared_ptr<const GaussiansFile> SceneFiles::gaussians(const Node& named, Progress& progress) {
  return held(gaussians_, named, "", [&](const std::string& path) { return read_gaussians_file(path, progress); });
}

void SceneFiles::end_frame() {
  const auto sweep = [](auto& files) {
    std::erase_if(files, [](const auto& entry) { return !entry.second.asked; });
    for (auto& [key, one] : files) one.asked = false;
  };
  sweep(meshes_), sweep(brdfs_), sweep(grids_), sweep(environments_), sweep(gaussians_);
}

}  // namespace airlight
