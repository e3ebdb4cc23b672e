// What the viewer's panel and mouse set, and what they ask of its loop.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/design/edits.h"

namespace airlight {

enum class ViewTool { look, paint, airbrush, erase, emit, select };
inline constexpr std::array<const char*, 6> view_tool_names{"look", "paint", "airbrush", "erase", "emit", "select"};

enum class ViewSource { cpu, gl, reference };
inline constexpr std::array<const char*, 3> view_source_names{"CPU", "GL", "reference"};

struct ViewState {
  ViewTool tool = ViewTool::look;
  ViewSource source = ViewSource::cpu;  // of the picture, unless it is split
  bool split = false;                   // CPU, GL, reference, difference
  int difference = 1;                   // of CPU and GL, CPU and reference, GL and reference
  bool fly = false;                     // else orbit
  bool panel = true;
  float exposure = 0;  // [stops]

  // Tools. The plane faces the camera through what it looks at, or is level.
  bool level_plane = false;
  float plane_height = 0;  // [m]
  Puff puff;
  float eraser_radius = 0.5F, eraser_amount = 0.5F;
  bool erase_through = true;  // along the view rays, whatever the plane
  AirbrushEdit airbrush;
  EmitEdit emitter;
  ScreenRectangle selection;
  bool selected = false;

  // Asked for; the loop does it and puts these back.
  bool picture_wanted = false, window_wanted = false, save_wanted = false, ends = false;
  std::string clipboard;  // to be copied
  std::string status;     // one line at the foot of the panel
};

}  // namespace airlight
