#include "common/scene/mesh_file.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "common/error.h"
#include "common/scene/limits.h"
#include "common/scene/load.h"
#include "common/scene/mesh_build.h"
#include "common/scene/mesh_check.h"

namespace airlight {

namespace {

using limits::farthest;
constexpr int deepest_node = 1000;

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
    for (const aiNode* child : std::span(node.mChildren, node.mNumChildren)) visit(*child, transform, depth + 1);
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

}  // namespace

glm::dmat4 to_glm(const aiMatrix4x4& m) {
  glm::dmat4 out;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) out[static_cast<int>(column)][static_cast<int>(row)] = m[row][column];
  }
  return out;
}

std::shared_ptr<const Mesh> mesh_of(const AssimpFile& file, const std::string& path, int material, bool flat,
                                    Progress& progress) {
  RawMesh raw = Gathering(file.scene(), path, material, progress).gathered();
  if (flat) raw.normals.clear();
  join_vertices(raw);
  if (raw.triangles.empty()) return nullptr;
  progress.check();
  Mesh mesh = with_normals(std::move(raw), flat);
  mesh.file = path;
  return std::make_shared<const Mesh>(std::move(mesh));
}

MeshFile read_mesh_file(const std::string& path, bool flat, int part, Progress& progress) {
  const AssimpFile file(path, progress);
  MeshFile out{mesh_of(file, path, part, flat, progress), file.content_hash()};
  if (!out.mesh) {
    const std::string where = part < 0 ? "" : fmt::format(" of material {}", part);
    throw InputError(fmt::format("{}: no triangle{} with an area, expected at least one", path, where));
  }
  return out;
}

std::shared_ptr<const Mesh> load_mesh(const std::string& path, bool flat, Progress& progress) {
  return read_mesh_file(path, flat, -1, progress).mesh;
}

}  // namespace airlight
