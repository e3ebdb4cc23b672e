// The files that a scene names.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "common/scene/brdf_file.h"
#include "common/scene/environment_file.h"
#include "common/scene/gaussians_file.h"
#include "common/scene/grid_file.h"
#include "common/scene/mesh_file.h"
#include "common/scene/reader.h"

namespace airlight {

enum class FileUse {
  read,
  look,    // only whether they are there
  ignore,  // nothing is asked of them
};

// Reads each file once, for all places that name it and for the frames of a sequence. What is wrong with a file is an InputError
// at the node that names it. Null where files are not read.
class SceneFiles {
 public:
  // `directory`: where relative paths start.
  explicit SceneFiles(std::string directory) : directory_(std::move(directory)) {}

  FileUse use = FileUse::read;

  std::shared_ptr<const MeshFile> mesh(const Node& named, bool flat, int part, Progress&);
  std::shared_ptr<const BrdfFile> brdf(const Node& named);
  std::shared_ptr<const GridFile> grid(const Node& named, const std::string& name, Progress&);
  std::shared_ptr<const EnvironmentFile> environment(const Node& named);
  std::shared_ptr<const GaussiansFile> gaussians(const Node& named, Progress&);

  // Lets go of the files that were not asked for since the last call.
  void end_frame();

 private:
  template <class File>
  struct Held {
    std::shared_ptr<const File> file;
    bool asked = false;
  };
  template <class File>
  using Files = std::map<std::pair<std::string, std::string>, Held<File>>;  // by path, and by how it is read

  template <class File, class Read>
  std::shared_ptr<const File> held(Files<File>&, const Node& named, const std::string& how, Read&&) const;

  std::string directory_;
  Files<MeshFile> meshes_;
  Files<BrdfFile> brdfs_;
  Files<GridFile> grids_;
  Files<EnvironmentFile> environments_;
  Files<GaussiansFile> gaussians_;
};

}  // namespace airlight
