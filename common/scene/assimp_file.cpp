#include "common/scene/assimp_file.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <new>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/mesh_check.h"
#include "common/scene/sha256.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{8} << 30U;

std::string lower_extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return e;
}

// Bytes that the file system below owns, and a place to stop long reads.
class Stream final : public Assimp::MemoryIOStream {
 public:
  Stream(const std::string& bytes, const Progress& progress)
      : MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), progress_(progress) {}
  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    progress_.check();
    if (size == 0) return 0;
    return MemoryIOStream::Read(to, size, count);
  }

 private:
  const Progress& progress_;
};

// Every file is read once, whole, and hashed.
class Files final : public Assimp::IOSystem {
 public:
  Files(const BeforeReading& before_reading, const Progress& progress) : before_reading_(before_reading), progress_(progress) {}

  const std::string& bytes(const std::string& path) {
    const auto found = read_.find(path);
    if (found != read_.end()) return found->second;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (before_reading_ && !error) before_reading_(size);
    std::string content = read_file(path, most_bytes);
    hash_.add(fmt::format("{}:", content.size()));
    hash_.add(content);
    return read_.emplace(path, std::move(content)).first->second;
  }
  std::string content_hash() const { return hash_.hex(); }
  void forget() { read_.clear(); }

  bool Exists(const char* path) const override {
    std::error_code error;
    return wanted(path) && std::filesystem::is_regular_file(path, error);
  }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (mode[0] != 'r' || !wanted(path)) return nullptr;
    if (!read_.contains(path) && !Exists(path)) return nullptr;
    return new Stream(bytes(path), progress_);  // assimp gives it back to Close
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  // Materials come from the scene file, so a missing or different material library changes nothing.
  static bool wanted(const std::string& path) { return lower_extension(path) != ".mtl"; }

  const BeforeReading before_reading_;
  const Progress& progress_;
  std::map<std::string, std::string> read_;
  Sha256 hash_;
};

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

// Whether a face has more than three corners. Checks before assimp works on them: it ends the program where an index is too large
// or a polygon's corner is not finite.
bool has_polygons(const std::string& path, const aiScene& scene) {
  bool found = false;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    if (mesh.mVertices == nullptr) throw InputError(path + ": a mesh without positions");
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        throw InputError(fmt::format("{}: vertex {}: expected finite coordinates", path, v));
      }
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      found |= face.mNumIndices > 3;
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] < mesh.mNumVertices) continue;
        throw InputError(
            fmt::format("{}: face {}: vertex {}, expected one below {}", path, f, face.mIndices[k], mesh.mNumVertices));
      }
    }
  }
  return found;
}

}  // namespace

struct AssimpFile::State {
  State(const BeforeReading& before_reading, const Progress& progress) : files(new Files(before_reading, progress)) {
    importer.SetIOHandler(files);
  }
  Assimp::Importer importer;
  Files* files;  // the importer owns it
};

AssimpFile::AssimpFile(const std::string& path, const BeforeReading& before_reading, Progress& progress)
    : state_(std::make_unique<State>(before_reading, progress)) {
  Assimp::Importer& importer = state_->importer;
  const std::string extension = lower_extension(path);
  const std::string& bytes = state_->files->bytes(path);
  if (bytes.empty()) throw InputError(path + ": an empty file, expected a mesh");
  if (extension.size() < 2 || !importer.IsExtensionSupported(extension)) {
    throw InputError(fmt::format(
        "{}: unknown mesh format \"{}\", expected obj, ply, stl, gltf, glb, 3ds or another that assimp reads", path, extension));
  }
  check_mesh_bytes(path, extension, bytes);
  const aiScene* scene = importer.ReadFile(path, 0);
  progress.check();  // what stopped a read inside assimp came out as a failure to read
  if (scene) {
    if (has_polygons(path, *scene)) importer.ApplyPostProcessing(aiProcess_Triangulate);
    progress.check();
  }
  if (!importer.GetScene()) {
    if (importer.GetErrorString() == std::string("std::bad_alloc")) throw std::bad_alloc();
    throw InputError(
        fmt::format("{}: not a readable {} file: {}", path, extension.substr(1), one_line(importer.GetErrorString())));
  }
  state_->files->forget();
}

AssimpFile::~AssimpFile() = default;

const aiScene& AssimpFile::scene() const { return *state_->importer.GetScene(); }

std::string AssimpFile::content_hash() const { return state_->files->content_hash(); }

}  // namespace airlight
