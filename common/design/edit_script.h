// Edit scripts: one edit a line, as JSON. Empty lines, and lines that begin with //, are skipped.
//
//   {"edit": "paint", "screen": [[-0.5, 0], [0.5, 0.1]], "plane": {"point": [0, 1, 0], "normal": [0, 1, 0]}, "radius": 0.5}
//   {"edit": "undo"}
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/design/edits.h"
#include "common/design/scene_editor.h"
#include "common/progress.h"
#include "common/scene/json.h"
#include "common/scene/reader.h"

namespace airlight {

struct ScriptLine {
  Edit edit;
  json::Place place;  // where it begins
};

// Throws InputError "name:line:column: ..." for the first line that is no edit.
std::vector<ScriptLine> parse_edits(std::string_view text, const std::string& name);

// One edit from its JSON value. Throws InputError with the place.
Edit parse_edit(const Node&);

// The edit as a line, with its line end; reading it gives the same bits. What is at its default is left out.
std::string line_of(const Edit&);

// Carries out all of them; an edit that makes no sense of the scene throws InputError "name:line:column: ...".
void replay(const std::vector<ScriptLine>&, const std::string& name, SceneEditor&, Progress&);

}  // namespace airlight
