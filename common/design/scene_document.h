// A scene file that can be written again with what edits have changed.
#pragma once

#include <string>
#include <vector>

#include "common/scene/json.h"
#include "common/scene/scene.h"

namespace airlight {

class SceneDocument {
 public:
  // Throws InputError where the file is no scene in JSON, or is an animation, whose numbers are not one scene's.
  explicit SceneDocument(const std::string& path);

  const Scene& scene() const { return scene_; }

  // The file with the Gaussians, lights, fog, camera and technique of `edited` where they differ from its own; all else stays,
  // but for comments. Names of files are told relative to `directory`, where the text is to stand.
  std::string text(const Scene& edited, const std::string& directory) const;

  // Writes it; the file appears complete or not at all. Throws as TemporaryFile does.
  void save(const Scene& edited, const std::string& path) const;

 private:
  void set_camera(json::Value& root, const Camera&) const;
  void set_medium(json::Value& root, const Medium&) const;
  void set_lights(json::Value& root, const std::vector<LightSource>&) const;
  void set_technique(json::Value& root, const Scene&) const;
  void rename_files(json::Value&, const std::string& directory) const;

  std::string directory_;
  json::Value root_;
  Scene scene_;
};

}  // namespace airlight
