#include "common/scene/mesh_import.h"

#include <assimp/material.h>
#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "common/error.h"
#include "common/scene/assimp_file.h"
#include "common/scene/gltf_scene.h"
#include "common/scene/limits.h"
#include "common/scene/mesh_build.h"
#include "common/scene/mesh_check.h"

namespace airlight {

namespace {

using limits::farthest;
constexpr int deepest_node = 1000;

glm::dmat4 to_glm(const aiMatrix4x4& m) {
  glm::dmat4 out;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) out[static_cast<int>(column)][static_cast<int>(row)] = m[row][column];
  }
  return out;
}

// Gathers the triangles of all nodes.
class Gathering {
 public:
  Gathering(const aiScene& scene, const std::string& path, int material, Progress& progress)
      : scene_(scene), path_(path), material_(material), progress_(progress) {}

  RawMesh gathered() {
    if (scene_.mRootNode) visit(*scene_.mRootNode, glm::dmat4(1.0), 0);
    if (!all_have_normals_) raw_.normals.clear();
    return std::move(raw_);
  }

 private:
  void visit(const aiNode& node, const glm::dmat4& parent, int depth) {
    if (depth > deepest_node) throw InputError(fmt::format("{}: nodes nested deeper than {}", path_, deepest_node));
    const glm::dmat4 transform = parent * to_glm(node.mTransformation);
    for (const unsigned m : std::span(node.mMeshes, node.mNumMeshes)) {
      if (m >= scene_.mNumMeshes) throw InputError(fmt::format("{}: node uses mesh {} of {}", path_, m, scene_.mNumMeshes));
      const aiMesh& mesh = *scene_.mMeshes[m];
      if (material_ < 0 || mesh.mMaterialIndex == static_cast<unsigned>(material_)) add(mesh, transform);
    }
    for (const aiNode* child : std::span(node.mChildren, node.mNumChildren)) {
      if (child) visit(*child, transform, depth + 1);  // assimp's importer of RAW files leaves some null
    }
  }

  void add(const aiMesh& mesh, const glm::dmat4& transform) {
    progress_.check();
    std::uint64_t triangles = 0;
    for (const aiFace& f : std::span(mesh.mFaces, mesh.mNumFaces)) triangles += f.mNumIndices == 3 ? 1 : 0;
    if (triangles == 0) return;
    check_triangle_count(path_, raw_.triangles.size() + triangles);
    const std::uint64_t vertices = raw_.positions.size() + std::uint64_t{mesh.mNumVertices};
    if (vertices >= std::uint64_t{1} << 31U) throw InputError(path_ + ": more than 2^31 vertices");

    const auto first = static_cast<std::uint32_t>(raw_.positions.size());
    raw_.triangles.reserve(raw_.triangles.size() + static_cast<std::size_t>(triangles));
    for (const aiFace& f : std::span(mesh.mFaces, mesh.mNumFaces)) {
      if (f.mNumIndices != 3) continue;  // points and lines have no surface
      for (int k = 0; k < 3; ++k) {
        if (f.mIndices[k] < mesh.mNumVertices) continue;
        throw InputError(fmt::format("{}: triangle {} uses vertex {}, expected an index below {}", path_, raw_.triangles.size(),
                                     f.mIndices[k], mesh.mNumVertices));
      }
      raw_.triangles.emplace_back(first + f.mIndices[0], first + f.mIndices[1], first + f.mIndices[2]);
    }

    raw_.positions.reserve(static_cast<std::size_t>(vertices));
    for (const aiVector3D& v : std::span(mesh.mVertices, mesh.mNumVertices)) {
      const glm::dvec3 p(transform * glm::dvec4(v.x, v.y, v.z, 1.0));
      if (!(std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(p.z) <= farthest)) {
        throw InputError(fmt::format("{}: vertex {} is at ({}, {}, {}), expected coordinates up to {} m", path_,
                                     raw_.positions.size(), p.x, p.y, p.z, farthest));
      }
      raw_.positions.emplace_back(p);
    }

    if (!mesh.HasNormals() || !all_have_normals_) {
      all_have_normals_ = false;
      return;
    }
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(transform)));
    raw_.normals.reserve(static_cast<std::size_t>(vertices));
    for (const aiVector3D& n : std::span(mesh.mNormals, mesh.mNumVertices)) {
      const glm::dvec3 turned = turn * glm::dvec3(n.x, n.y, n.z);
      raw_.normals.emplace_back(turned / std::sqrt(glm::dot(turned, turned)));  // NaN says that it is not usable
    }
  }

  const aiScene& scene_;
  const std::string& path_;
  int material_;
  Progress& progress_;
  RawMesh raw_;
  bool all_have_normals_ = true;
};

// The triangles that have this material, or of all for -1, with the transforms of the nodes applied; null where there are none.
std::shared_ptr<const Mesh> mesh_of(const AssimpFile& file, const MeshRequest& request, int material, Progress& progress) {
  RawMesh raw = Gathering(file.scene(), request.path, material, progress).gathered();
  if (request.flat) raw.normals.clear();
  join_vertices(raw);
  if (raw.triangles.empty()) return nullptr;
  progress.check();
  Mesh mesh = with_normals(std::move(raw), request.flat);
  mesh.file = request.path;
  return std::make_shared<const Mesh>(std::move(mesh));
}

// What an importer made of a material that the file does not say is left as assimp's default: white, matt.
Material material_of(const aiMaterial& from) {
  aiColor4D base(1, 1, 1, 1);
  ai_real metallic = 0, roughness = 1;
  from.Get(AI_MATKEY_BASE_COLOR, base);
  if (from.Get(AI_MATKEY_METALLIC_FACTOR, metallic) != aiReturn_SUCCESS) {
    Material plain;
    plain.diffuse = glm::clamp(glm::vec3(base.r, base.g, base.b), 0.0F, 1.0F);
    return plain;
  }
  from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness);
  return gltf_material(glm::dvec3(base.r, base.g, base.b), static_cast<double>(metallic), static_cast<double>(roughness));
}

}  // namespace

ImportedFile import_here(const MeshRequest& request, const BeforeReading& before_reading, Progress& progress) {
  const AssimpFile file(request.path, before_reading, progress);
  ImportedFile out{{}, file.content_hash()};
  const auto add = [&](int part, const Material& material) {
    if (auto mesh = mesh_of(file, request, part, progress)) out.meshes.push_back({part, material, std::move(mesh)});
  };
  if (request.by_material) {
    for (unsigned i = 0; i < file.scene().mNumMaterials; ++i) add(static_cast<int>(i), material_of(*file.scene().mMaterials[i]));
  } else {
    add(request.part, {});
  }
  return out;
}

}  // namespace airlight
