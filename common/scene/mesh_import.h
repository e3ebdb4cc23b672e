// What reading a mesh file gives, as values: all of it that scenes take.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/progress.h"
#include "common/scene/scene.h"

namespace airlight {

struct MeshRequest {
  std::string path;
  bool flat = false;
  bool by_material = false;  // a mesh for each material that has triangles, with what the file says of its looks
  int part = -1;             // else the triangles of that material alone, as the file numbers them; -1: all
};

struct ImportedMesh {
  int part = -1;
  Material material;
  std::shared_ptr<const Mesh> mesh;
};

struct ImportedFile {
  std::vector<ImportedMesh> meshes;  // those without triangles are left out
  std::string content_hash;          // SHA-256 of the file's bytes, and of those that it names
};

// Told how many bytes are about to be read, before each file.
using BeforeReading = std::function<void(std::uint64_t bytes)>;

// In this process, through assimp. Throws InputError "path: ..." for what cannot be read, Interrupted, std::bad_alloc.
ImportedFile import_here(const MeshRequest&, const BeforeReading&, Progress&);

}  // namespace airlight
