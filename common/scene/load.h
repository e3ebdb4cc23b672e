// Scene files (JSON with comments, version 1) into scenes.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/progress.h"
#include "common/scene/animation.h"
#include "common/scene/scene.h"

namespace airlight {

// A scene file, read once, and the scenes of its frames. Paths are relative to the scene file. Everything throws InputError with
// "file:line:column: what is wrong, what was expected" for bad content, for a key or type of a later version by its name, for
// limits (2^31 indices, 50 million triangles, 2^29 cells of a grid, 65535 pixels a side), before allocating for them.
class SceneFile {
 public:
  // Keyframes are checked, all of them; the files that the scene names are not looked at.
  explicit SceneFile(const std::string& path);
  // The same from text; `name` stands for the file in messages, `directory` is where relative paths start.
  SceneFile(std::string_view text, const std::string& name, const std::string& directory);
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;
  SceneFile& operator=(SceneFile&&) noexcept;

  bool animated() const;
  FrameRange frames() const;                        // of the animation; 0 without one
  std::size_t tracks() const;                       // how many paths it has keyframes for
  std::vector<std::string> numbered_files() const;  // names that have the frame's number in them

  // The scene of a frame, also of one outside of frames(), with every file that it names. What the frame before has read is
  // not read again.
  Scene scene(int frame, Progress&);

  // Throws what scene() would, but for what is wrong inside the named files: these must be there.
  void check(int frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The first frame of a scene file.
Scene load_scene(const std::string& path, Progress&);
Scene load_scene(const std::string& path);
Scene parse_scene(std::string_view text, const std::string& name, const std::string& directory, Progress&);

// A mesh file (what assimp reads), all its triangles in one mesh, node transforms applied. Normals: the file's, unless `flat`
// or absent; generated ones are smooth below a crease angle of 60 degrees.
std::shared_ptr<const Mesh> load_mesh(const std::string& path, bool flat, Progress&);

}  // namespace airlight
