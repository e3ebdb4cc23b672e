#include "app/view_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "common/techniques/technique.h"

namespace airlight {

namespace {

// Sliders in double, over decades where the range has some.
bool slide(const char* label, double& v, double least, double most, bool decades = true) {
  const ImGuiSliderFlags flags = decades ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &v, &least, &most, "%.4g", flags);
}

void vector(const char* label, glm::dvec3& v, double most) {
  const double least = -most;
  ImGui::SliderScalarN(label, ImGuiDataType_Double, &v.x, 3, &least, &most, "%.3g");
}

const Knob& knob_of(const Technique& t, const std::string& name) {
  return *std::find_if(t.knobs.begin(), t.knobs.end(), [&](const Knob& k) { return k.name == name; });
}

}  // namespace

std::string command_line(const ViewSession& session, const ViewState& state, Extent extent) {
  const Scene& scene = session.scene();
  std::string line =
      fmt::format("airlight render '{}' -o picture.exr --resolution {}x{}", session.file(), extent.width, extent.height);
  if (state.source == ViewSource::reference) return line + " --technique reference";
  if (state.source == ViewSource::gl) line += " --backend gl";
  if (!scene.technique.empty()) line += " --technique " + scene.technique;
  for (const auto& [name, value] : scene.settings) line += fmt::format(" --set {}={}", name, value);
  return line;
}

std::string told_of(const ViewPicture& p) { return p.device + (p.texture ? ", drawn directly" : ""); }

void ViewPanel::attempt(const Edit& edit) {
  try {
    session_.attempt(edit);
  } catch (const InputError& e) {
    state_.status = e.what();
  }
}

void ViewPanel::set_technique(const std::string& name, std::vector<std::pair<std::string, std::string>> settings) {
  try {
    session_.apply(TechniqueEdit{name, std::move(settings)});
  } catch (const InputError& e) {
    state_.status = e.what();
  }
}

void ViewPanel::draw(double left, double height, const ViewReport& report) {
  ImGui::SetNextWindowPos({static_cast<float>(left), 0});
  ImGui::SetNextWindowSize({panel_width, static_cast<float>(height)});
  ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
  // What is said stands below, so that nothing moves away under the mouse.
  const float foot = 2 * ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("all", {0, -foot});
  ImGui::PushItemWidth(150);
  if (ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) view();
  if (ImGui::CollapsingHeader("Tools", ImGuiTreeNodeFlags_DefaultOpen)) tools();
  if (ImGui::CollapsingHeader("Costs", ImGuiTreeNodeFlags_DefaultOpen)) costs(report);
  if (ImGui::CollapsingHeader("Technique")) technique();
  if (ImGui::CollapsingHeader("Lights and fog")) lights();
  if (ImGui::CollapsingHeader("File")) files();
  ImGui::PopItemWidth();
  ImGui::EndChild();
  ImGui::TextWrapped("%s", state_.status.c_str());
  ImGui::End();
}

void ViewPanel::view() {
  int source = static_cast<int>(state_.source);
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(view_source_names.at(static_cast<std::size_t>(i)), source == i))
      state_.source = static_cast<ViewSource>(i);
  }
  ImGui::SameLine();
  ImGui::Checkbox("split (V)", &state_.split);
  if (state_.split) ImGui::Combo("difference", &state_.difference, "CPU - GL\0CPU - reference\0GL - reference\0");
  ImGui::SliderFloat("exposure", &state_.exposure, -8, 8, "%.2f stops");
  if (ImGui::Button("frame (F)")) input_.frame();
  ImGui::SameLine();
  if (ImGui::Button("start (Home)")) session_.look_from_start();
  ImGui::SameLine();
  ImGui::Checkbox("fly", &state_.fly);
}

void ViewPanel::learn_technique() {
  if (learnt_ == session_.revision()) return;
  learnt_ = session_.revision();
  technique_error_.clear();
  try {
    const Frame frame = planned_frame(session_.scene(), {});
    technique_ = frame.technique, knobs_ = frame.knobs;
  } catch (const InputError& e) {
    technique_ = session_.scene().technique, knobs_.clear();
    technique_error_ = e.what();
  }
}

void ViewPanel::technique() {
  learn_technique();
  if (ImGui::BeginCombo("technique", technique_.c_str())) {
    for (const Technique& t : techniques()) {
      const bool here = t.name == technique_;
      if (ImGui::Selectable(std::string(t.name).c_str(), here) && !here) set_technique(std::string(t.name), {});
    }
    ImGui::EndCombo();
  }
  if (!technique_error_.empty()) return ImGui::TextWrapped("%s", technique_error_.c_str());
  const airlight::Technique& t = airlight::technique(technique_);
  for (auto& [name, value] : knobs_) {
    const Knob* knob = &knob_of(t, name);
    bool changed = false;
    if (knob->kind == Knob::Kind::choice) {
      if (ImGui::BeginCombo(name.c_str(), value.c_str())) {
        for (const std::string_view choice : knob->choices) {
          if (ImGui::Selectable(std::string(choice).c_str(), choice == value)) value = choice, changed = true;
        }
        ImGui::EndCombo();
      }
    } else if (double v = std::strtod(value.c_str(), nullptr); slide(name.c_str(), v, knob->least, knob->most)) {
      value = fmt::format("{}", knob->kind == Knob::Kind::integer ? std::round(v) : v);
    }
    changed = changed || ImGui::IsItemDeactivatedAfterEdit();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(knob->meaning).c_str());
    if (!changed) continue;
    // What is at its default is not said.
    std::vector<std::pair<std::string, std::string>> settings;
    for (const auto& [n, v] : knobs_) {
      if (v != knob_of(t, n).standard) settings.emplace_back(n, v);
    }
    return set_technique(technique_, settings);
  }
}

void ViewPanel::tools() {
  for (std::size_t i = 0; i < view_tool_names.size(); ++i) {
    if (i % 3 != 0) ImGui::SameLine(static_cast<float>(105 * (i % 3)));
    const std::string label = fmt::format("{} {}", i + 1, view_tool_names.at(i));
    if (!ImGui::RadioButton(label.c_str(), state_.tool == static_cast<ViewTool>(i))) continue;
    input_.stop();
    state_.tool = static_cast<ViewTool>(i);
  }
  const ViewTool tool = state_.tool;
  const bool places = tool == ViewTool::paint || tool == ViewTool::airbrush || tool == ViewTool::emit;
  if (places) {
    slide("radius [m]", state_.puff.radius, 0.01, 100);
    slide("extinction [1/m]", state_.puff.extinction, 1e-4, 100);
  }
  if (tool == ViewTool::airbrush) {
    slide("rate [1/s]", state_.airbrush.rate, 1, 200);
    slide("spread [m/s]", state_.airbrush.spread, 0, 20);
    slide("diffusion", state_.airbrush.diffusion, 0, 10);
    vector("gravity", state_.airbrush.acceleration, 10);
  }
  if (tool == ViewTool::emit) {
    slide("rate [1/s]", state_.emitter.rate, 1, 200);
    slide("lifetime [s]", state_.emitter.lifetime, 0.1, 60);
    slide("spread [m/s]", state_.emitter.spread, 0, 20);
    vector("velocity", state_.emitter.velocity, 20);
    vector("acceleration", state_.emitter.acceleration, 20);
    ImGui::Text("%s", input_.playing() ? "click again to stop it" : "click to place it");
  }
  if (tool == ViewTool::erase) {
    ImGui::SliderFloat("radius [m]", &state_.eraser_radius, 0.01F, 100, "%.4g", ImGuiSliderFlags_Logarithmic);
    ImGui::SliderFloat("amount [1/m]", &state_.eraser_amount, 1e-4F, 100, "%.4g", ImGuiSliderFlags_Logarithmic);
    ImGui::Checkbox("through everything", &state_.erase_through);
  }
  if (places || (tool == ViewTool::erase && !state_.erase_through)) {
    ImGui::Checkbox("level plane", &state_.level_plane);
    if (state_.level_plane) ImGui::InputFloat("height [m]", &state_.plane_height, 0.1F);
  }
  if (tool == ViewTool::select) ImGui::Text("drag, then Ctrl+C, Ctrl+V at the mouse");
  ImGui::BeginDisabled(!session_.can_undo());
  const bool undo = ImGui::Button("undo");
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!session_.can_redo());
  const bool redo = ImGui::Button("redo");
  ImGui::EndDisabled();
  if (undo && session_.can_undo()) session_.apply(UndoEdit{});
  if (redo && session_.can_redo()) session_.apply(RedoEdit{});
  ImGui::SameLine();
  ImGui::Text("%zu Gaussians", session_.scene().medium.gaussians.size());
}

void ViewPanel::lights() {
  double extinction = session_.scene().medium.extinction;
  if (slide("fog [1/m]", extinction, 0, 10)) attempt(FogEdit{extinction});
  if (ImGui::IsItemDeactivatedAfterEdit()) session_.commit();
  const std::vector<LightSource> lights = session_.scene().lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightSource& l = lights[i];
    const std::string name = l.name.empty() ? std::to_string(i) : l.name;
    ImGui::PushID(static_cast<int>(i));
    ImGui::Text("%s", name.c_str());
    const double brightest = std::max({l.power.x, l.power.y, l.power.z});
    double power = brightest;
    if (slide("power", power, 0, 1e4) && brightest > 0) attempt(LightEdit{name, {}, {}, l.power * (power / brightest)});
    if (ImGui::IsItemDeactivatedAfterEdit()) session_.commit();
    if (l.type == LightType::directional) {
      constexpr double degree = 57.29577951308232;
      double azimuth = degree * std::atan2(l.direction.x, -l.direction.z), height = degree * std::asin(-l.direction.y);
      bool moved = slide("azimuth", azimuth, -180, 180, false);
      const bool released = ImGui::IsItemDeactivatedAfterEdit();
      moved |= slide("height", height, -89, 89, false);
      const double a = azimuth / degree, h = height / degree;
      if (moved)
        attempt(LightEdit{name, {}, glm::dvec3(std::cos(h) * std::sin(a), -std::sin(h), -std::cos(h) * std::cos(a)), {}});
      if (released || ImGui::IsItemDeactivatedAfterEdit()) session_.commit();
    }
    ImGui::PopID();
  }
}

void ViewPanel::files() {
  ImGui::TextWrapped("%s%s", session_.file().c_str(), session_.changed() ? " (changed)" : "");
  state_.save_wanted |= ImGui::Button("save (Ctrl+S)");
  state_.picture_wanted |= ImGui::Button("picture (P)");
  ImGui::SameLine();
  state_.window_wanted |= ImGui::Button("window (Shift+P)");
  if (ImGui::Button("copy command line")) {
    state_.clipboard = command_line(session_, state_, session_.scene().camera.resolution);
    state_.status = session_.changed() ? "copied; save the scene first: it has changed" : "copied";
  }
}

void ViewPanel::costs(const ViewReport& report) {
  for (std::size_t i = 0; i < report.pictures.size(); ++i) {
    const ViewPicture* p = report.pictures[i];
    const std::string name = view_source_names.at(i);
    if (!p) {
      if (report.busy[i]) ImGui::Text("%s: working %.0f %%", name.c_str(), 100 * report.reference_fraction);
      continue;
    }
    if (!p->error.empty()) {
      ImGui::TextWrapped("%s: %s", name.c_str(), p->error.c_str());
      continue;
    }
    ImGui::TextWrapped("%s: %.1f ms at %d x %d%s", name.c_str(), 1e3 * p->seconds, p->extent.width, p->extent.height,
                       report.busy[i] ? " ..." : "");
    if (i == static_cast<std::size_t>(ViewSource::reference)) continue;
    ImGui::TextWrapped("%s on %s", p->technique.c_str(), told_of(*p).c_str());
    for (const StepStats& s : p->stats.steps) {
      ImGui::TextDisabled("  %-26s %s", s.name.c_str(), s.reused ? "reused" : fmt::format("{:8.2f} ms", 1e3 * s.seconds).c_str());
    }
    if (!p->plan.empty() && ImGui::TreeNode((name + " plan").c_str())) {
      ImGui::TextWrapped("%s", p->plan.c_str());
      ImGui::TreePop();
    }
  }
  if (!report.error.empty()) ImGui::TextWrapped("%s", report.error.c_str());
}

}  // namespace airlight
