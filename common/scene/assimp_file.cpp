#include "common/scene/assimp_file.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstdint>
#include <filesystem>
#include <map>

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
  explicit Files(const Progress& progress) : progress_(progress) {}

  const std::string& bytes(const std::string& path) {
    const auto found = read_.find(path);
    if (found != read_.end()) return found->second;
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

}  // namespace

struct AssimpFile::State {
  explicit State(const Progress& progress) : files(new Files(progress)) { importer.SetIOHandler(files); }
  Assimp::Importer importer;
  Files* files;  // the importer owns it
};

AssimpFile::AssimpFile(const std::string& path, Progress& progress) : state_(std::make_unique<State>(progress)) {
  Assimp::Importer& importer = state_->importer;
  const std::string extension = lower_extension(path);
  const std::string& bytes = state_->files->bytes(path);
  if (bytes.empty()) throw InputError(path + ": an empty file, expected a mesh");
  if (extension.size() < 2 || !importer.IsExtensionSupported(extension)) {
    throw InputError(fmt::format(
        "{}: unknown mesh format \"{}\", expected obj, ply, stl, gltf, glb, 3ds or another that assimp reads", path,
        extension));
  }
  check_mesh_bytes(path, extension, bytes);
  importer.ReadFile(path, aiProcess_Triangulate);
  progress.check();  // what stopped a read inside assimp came out as a failure to read
  if (!importer.GetScene()) {
    throw InputError(
        fmt::format("{}: not a readable {} file: {}", path, extension.substr(1), one_line(importer.GetErrorString())));
  }
  state_->files->forget();
}

AssimpFile::~AssimpFile() = default;

const aiScene& AssimpFile::scene() const { return *state_->importer.GetScene(); }

std::string AssimpFile::content_hash() const { return state_->files->content_hash(); }

}  // namespace airlight
