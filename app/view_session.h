// What the viewer edits: a scene, its history, and the record of what was done. Knows no window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "app/airlight.h"
#include "common/design/edit_script.h"
#include "common/design/scene_document.h"
#include "common/design/scene_editor.h"

namespace airlight {

class ViewSession {
 public:
  // `output`: where save() writes; empty: SCENE_edited.json beside the scene. `record`: every edit is a line of that file; empty:
  // none. Scenes that cannot be saved (glTF, animations: their first frame) can be looked at and edited.
  ViewSession(const std::string& path, std::string output, std::string record, Progress&);

  // Empties the record. Throws InputError where it cannot be written.
  void begin_record();

  const Scene& scene() const { return editor_->scene(); }
  std::uint64_t revision() const { return revision_; }  // rises whenever the scene changes

  // Carries the edit out and records it. Throws InputError, and nothing has happened then.
  void apply(const Edit&);

  // As long as the user drags: in place of the last trial, not recorded. Edits that can be undone only.
  void attempt(const Edit&);
  void abandon();  // as before the trial
  void commit();   // the trial, if any, is an edit now
  bool attempting() const { return trial_.has_value(); }

  // Recorded when an edit depends on it, and at the end.
  void look(const Camera&);
  void look_from_start();  // the file's own camera

  bool can_undo() const { return !trial_ && editor_->can_undo(); }
  bool can_redo() const { return !trial_ && editor_->can_redo(); }
  const std::vector<Gaussian>& copied() const { return editor_->copied(); }
  std::int64_t next_seed() { return ++seed_; }

  // Returns the file's name. Throws InputError, MachineError.
  std::string save();
  bool changed() const { return revision_ != saved_revision_; }  // since the file was read or saved
  const std::string& file() const { return saved_.empty() ? path_ : saved_; }
  void finish();  // the rest of the record

 private:
  void record(const Edit&);
  void record_camera();
  void write(const std::string& lines);

  std::string path_, output_, record_, saved_;
  std::optional<SceneDocument> document_;
  std::string not_saved_why_;
  std::optional<SceneEditor> editor_;
  Camera first_camera_, recorded_camera_;
  std::optional<Edit> trial_;
  std::uint64_t revision_ = 0, saved_revision_ = 0;
  std::int64_t seed_ = 0;
};

}  // namespace airlight
