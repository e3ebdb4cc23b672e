// A scene under edit: carries edits out and takes them back.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "common/design/collisions.h"
#include "common/design/edits.h"
#include "common/scene/scene.h"

namespace airlight {

class SceneEditor {
 public:
  // `later`: seconds after what edits say, of emitters.
  explicit SceneEditor(Scene, double later = 0);

  // Throws InputError where the edit makes no sense of this scene, and leaves all as it was.
  void apply(const Edit&);

  // Undoes, and forgets how to redo. There must be something to undo.
  void take_back();

  // With the edits; its `hash` is empty after the first.
  const Scene& scene() const { return scene_; }

  bool can_undo() const { return now_ > 0; }
  bool can_redo() const { return now_ + 1 < states_.size(); }
  const std::vector<Gaussian>& copied() const { return copied_; }

 private:
  // What can be undone. A state shares with the one before it what has not changed.
  struct State {
    std::shared_ptr<const std::vector<Gaussian>> gaussians;
    std::shared_ptr<const std::vector<LightSource>> lights;
    double extinction = 0;
  };

  void carry_out(const PaintEdit&);
  void carry_out(const AirbrushEdit&);
  void carry_out(const EraseEdit&);
  void carry_out(const EmitEdit&);
  void carry_out(const CopyEdit&);
  void carry_out(const PasteEdit&);
  void carry_out(const MoveEdit&);
  void carry_out(const LightEdit&);
  void carry_out(const FogEdit&);
  void carry_out(const CameraEdit&);
  void carry_out(const TechniqueEdit&);
  void carry_out(const UndoEdit&);
  void carry_out(const RedoEdit&);

  void add(std::vector<Gaussian>);
  void set_gaussians(std::vector<Gaussian>);
  void push(State);
  void show();  // the state `now_`

  Scene scene_;
  double later_;
  std::vector<State> states_;
  std::size_t now_ = 0;
  std::vector<Gaussian> copied_;
  std::unique_ptr<Collisions> collisions_;  // made when first asked for; surfaces do not change
};

}  // namespace airlight
