// The panel at the right side of the viewer's window.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/view_input.h"
#include "app/view_session.h"
#include "app/view_state.h"
#include "app/view_worker.h"

namespace airlight {

inline constexpr int panel_width = 340;  // [pixel]

// What the panel tells of the pictures that are shown.
struct ViewReport {
  std::array<const ViewPicture*, 3> pictures{};  // of CPU, GL, reference; null: none yet
  std::array<bool, 3> busy{};
  double reference_fraction = 0;
  std::string error;  // of the difference, in words
};

class ViewPanel {
 public:
  ViewPanel(ViewSession& session, ViewState& state, ViewInput& input) : session_(session), state_(state), input_(input) {}
  void draw(double left, double height, const ViewReport&);

 private:
  void view();
  void technique();
  void tools();
  void lights();
  void files();
  void costs(const ViewReport&);
  void learn_technique();
  void attempt(const Edit&);
  void set_technique(const std::string& name, std::vector<std::pair<std::string, std::string>> settings);

  ViewSession& session_;
  ViewState& state_;
  ViewInput& input_;
  // What the scene is rendered by, as of a revision.
  std::optional<std::uint64_t> learnt_;
  std::string technique_, technique_error_;
  std::vector<std::pair<std::string, std::string>> knobs_;
};

// What made the picture, and that it never was on the host.
std::string told_of(const ViewPicture&);

// The command that renders what is seen.
std::string command_line(const ViewSession&, const ViewState&, Extent);

}  // namespace airlight
