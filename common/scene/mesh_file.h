// Meshes out of files: by the process that reads them where the program has started one (import_process.h), else in this one.
#pragma once

#include <memory>
#include <string>

#include "common/progress.h"
#include "common/scene/mesh_import.h"

namespace airlight {

struct MeshFile {
  std::shared_ptr<const Mesh> mesh;
  std::string content_hash;  // SHA-256 of its bytes
};

// `part`: the triangles of that material alone, as the file numbers them; -1: all.
MeshFile read_mesh_file(const std::string& path, bool flat, int part, Progress&);

// Each material with its triangles.
ImportedFile read_mesh_parts(const std::string& path, Progress&);

}  // namespace airlight
