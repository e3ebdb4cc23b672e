#include "common/scene/mesh_file.h"

#include <fmt/format.h>

#include "common/error.h"
#include "common/scene/import_process.h"
#include "common/scene/load.h"

namespace airlight {

namespace {

ImportedFile imported(const MeshRequest& request, Progress& progress) {
  ImportProcess* const process = ImportProcess::running();
  return process ? process->import(request, progress) : import_here(request, {}, progress);
}

}  // namespace

MeshFile read_mesh_file(const std::string& path, bool flat, int part, Progress& progress) {
  ImportedFile file = imported({.path = path, .flat = flat, .part = part}, progress);
  if (file.meshes.empty()) {
    const std::string where = part < 0 ? "" : fmt::format(" of material {}", part);
    throw InputError(fmt::format("{}: no triangle{} with an area, expected at least one", path, where));
  }
  return {std::move(file.meshes.front().mesh), std::move(file.content_hash)};
}

ImportedFile read_mesh_parts(const std::string& path, Progress& progress) {
  return imported({.path = path, .by_material = true}, progress);
}

std::shared_ptr<const Mesh> load_mesh(const std::string& path, bool flat, Progress& progress) {
  return read_mesh_file(path, flat, -1, progress).mesh;
}

}  // namespace airlight
