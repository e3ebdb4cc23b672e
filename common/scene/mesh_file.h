// Meshes out of files.
#pragma once

#include <glm/mat4x4.hpp>
#include <memory>
#include <string>

#include "common/progress.h"
#include "common/scene/assimp_file.h"
#include "common/scene/scene.h"

namespace airlight {

struct MeshFile {
  std::shared_ptr<const Mesh> mesh;
  std::string content_hash;  // SHA-256 of its bytes
};

// `part`: the triangles of that material alone, as the file numbers them; -1: all.
MeshFile read_mesh_file(const std::string& path, bool flat, int part, Progress&);

// The triangles of one file that have this material, or of all for -1, with the transforms of the nodes applied. A mesh
// without triangles is null.
std::shared_ptr<const Mesh> mesh_of(const AssimpFile&, const std::string& path, int material, bool flat, Progress&);

glm::dmat4 to_glm(const aiMatrix4x4&);

}  // namespace airlight
