// A file as assimp reads it, from bytes that are hashed as they are read.
#pragma once

#include <assimp/scene.h>

#include <memory>
#include <string>

#include "common/progress.h"
#include "common/scene/mesh_import.h"

namespace airlight {

// Faces are triangles, lines or points; nothing else is changed by post-processing. Throws InputError "path: ..." for
// what cannot be read, Interrupted, std::bad_alloc. Material libraries and pictures that the file names are not opened.
class AssimpFile {
 public:
  AssimpFile(const std::string& path, const BeforeReading&, Progress&);
  ~AssimpFile();

  const aiScene& scene() const;
  // SHA-256 of the bytes of the file and of those that it names (glTF buffers), in the order of reading.
  std::string content_hash() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
