// airlight view: the loop between window, session and workers.
#include <fmt/format.h>
#include <imgui.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "app/command.h"
#include "app/view_difference.h"
#include "app/view_input.h"
#include "app/view_panel.h"
#include "app/view_session.h"
#include "app/view_window.h"
#include "app/view_worker.h"
#include "common/scene/gltf_scene.h"

namespace airlight {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int sources = 3, difference_slot = 3;
static_assert(difference_slot < ViewPainter::slots);

// What a worker was asked for last.
struct Asked {
  std::uint64_t number = 0, revision = 0;
  Extent extent;
  friend bool operator==(const Asked& a, const Asked& b) { return a.revision == b.revision && a.extent == b.extent; }
};

struct Source {
  std::optional<ViewWorker> worker;
  std::optional<Asked> asked;
  std::optional<ViewPicture> picture;
  double whole_seconds = 0;  // of the last picture at full resolution
};

class Viewer {
 public:
  Viewer(const ViewCommand& c, Terminal& terminal)
      : c_(c),
        terminal_(terminal),
        session_(c.scene, c.output, c.record, terminal),
        window_("airlight " + c.scene, {c.size.width + panel_width, c.size.height}),
        input_(session_, state_),
        panel_(session_, state_, input_) {
    state_.source = c.renderer.backend == "gl" ? ViewSource::gl : ViewSource::cpu;
    state_.exposure = c.exposure;
    // Tools begin in proportion to what is seen.
    const double size = glm::distance(session_.scene().camera.position, session_.scene().camera.look_at);
    state_.puff.radius = size / 15, state_.puff.extinction = 10 / size;
    state_.eraser_radius = static_cast<float>(size / 15), state_.eraser_amount = static_cast<float>(5 / size);
    state_.emitter.velocity = {0, size / 8, 0}, state_.emitter.spread = size / 60;
    state_.airbrush.spread = size / 10, state_.airbrush.diffusion = size * size / 2000;
    for (const std::string& note : gltf_notes(c.scene)) terminal_.log(LogLevel::warning, note);
  }

  void run() {
    session_.begin_record();
    if (c_.fog) session_.apply(FogEdit{*c_.fog});
    Clock::time_point last = Clock::now();
    while (!window_.closed() && !terminal_.stop_requested()) {
      const bool lively = input_.moving() || wants_something();
      const std::vector<ViewEvent> events = window_.wait(lively ? 0.01 : 0.1);
      const Clock::time_point now = Clock::now();
      lay_out();
      for (const ViewEvent& e : events) input_.handle(e, panes_, ImGui::GetIO().WantTextInput);
      if (!events.empty()) last_event_ = now;
      const auto shown = static_cast<std::size_t>(state_.source);
      const bool drawn =
          sources_[shown].picture && sources_[shown].asked && sources_[shown].picture->number == sources_[shown].asked->number;
      input_.tick(std::chrono::duration<double>(now - last).count(), drawn);
      last = now;
      ask(now);
      const bool news = take();
      if (news || !events.empty() || lively || busy() || redraws_ > 0) {
        redraws_ = events.empty() && !news ? redraws_ - 1 : 3;  // ImGui settles in a frame or two
        draw();
      }
      serve();
    }
    session_.finish();
    if (terminal_.stop_requested()) throw Interrupted();
  }

 private:
  bool shows(int i) const { return state_.split || static_cast<int>(state_.source) == i; }
  bool busy() const {
    return std::any_of(sources_.begin(), sources_.end(), [](const Source& s) { return s.worker && s.worker->busy(); });
  }
  bool wants_something() const { return state_.picture_wanted || state_.window_wanted || state_.save_wanted; }

  // Panes, left to right and from the top: one, or CPU, GL, reference, difference.
  void lay_out() {
    const Extent e = window_.extent();
    const double width = std::max(8, e.width - (state_.panel ? panel_width : 0)), height = std::max(8, e.height);
    panes_.clear();
    if (!state_.split) {
      panes_.push_back({{0, 0}, {width, height}});
    } else {
      const glm::dvec2 half(std::floor(width / 2), std::floor(height / 2));
      for (const double down : {0.0, half.y}) {
        for (const double across : {0.0, half.x}) panes_.push_back({{across, down}, half - 1.0});
      }
    }
  }
  Extent pane_extent() const { return {static_cast<int>(panes_[0].size.x), static_cast<int>(panes_[0].size.y)}; }

  // Throws MachineError where there is no device for it.
  ViewWorker& worker(int i) {
    Source& s = sources_[static_cast<std::size_t>(i)];
    if (s.worker) return *s.worker;
    RendererOptions o = c_.renderer;
    const bool gl = i == static_cast<int>(ViewSource::gl);
    o.backend = gl ? "gl" : "cpu";
    if (gl && o.gl_context == "window") o.gl_host = window_.render_context();
    const bool reference = i == static_cast<int>(ViewSource::reference);
    // The window keeps a core of its own.
    if (reference && o.threads == 0) o.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
    return s.worker.emplace(o, reference, [] { ViewWindow::wake(); });
  }

  void ask(Clock::time_point now) {
    const bool moving = input_.moving() || session_.attempting() || now - last_event_ < std::chrono::milliseconds(150);
    for (int i = 0; i < sources; ++i) {
      Source& s = sources_[static_cast<std::size_t>(i)];
      if (!shows(i)) continue;
      const bool reference = i == static_cast<int>(ViewSource::reference);
      Asked asked{next_ + 1, session_.revision(), pane_extent()};
      if (s.asked && *s.asked == asked) continue;
      // While something moves a slow picture is made coarser, a whole one follows.
      const bool coarse = moving && !reference && s.asked && s.whole_seconds > 0.12;
      if (coarse) {
        const int share = std::clamp(static_cast<int>(std::ceil(std::sqrt(s.whole_seconds / 0.06))), 2, 6);
        asked.extent = {std::max(1, asked.extent.width / share), std::max(1, asked.extent.height / share)};
        if (*s.asked == asked) continue;
      }
      ViewJob job;
      job.number = asked.number = ++next_;
      job.scene = session_.scene();
      job.settings.resolution = asked.extent;
      if (reference) job.settings.technique = "reference";
      job.explain = !reference && !coarse && !moving;
      s.asked = asked;
      try {
        worker(i).ask(std::move(job));
      } catch (const MachineError& e) {
        ViewPicture none;
        none.number = asked.number, none.error = e.what(), none.complete = true;
        receive(i, std::move(none));
      }
    }
  }

  // Whether there is a new picture.
  bool take() {
    bool news = false;
    for (int i = 0; i < sources; ++i) {
      Source& s = sources_[static_cast<std::size_t>(i)];
      auto picture = s.worker ? s.worker->take() : std::nullopt;
      if (!picture) continue;
      news = true;
      receive(i, std::move(*picture));
    }
    if (state_.split && (news || state_.difference != difference_)) tell_difference();
    return news;
  }

  void receive(int i, ViewPicture picture) {
    Source& s = sources_[static_cast<std::size_t>(i)];
    const std::string name = view_source_names.at(static_cast<std::size_t>(i));
    if (picture.plan.empty() && s.picture) picture.plan = s.picture->plan;
    if (!picture.error.empty()) {
      if (!s.picture || s.picture->error != picture.error) tell(name + ": " + picture.error);
    } else {
      if (!s.picture || s.picture->device != picture.device) terminal_.log(LogLevel::info, name + ": " + told_of(picture));
      if (picture.texture) {
        window_.painter().set(i, picture.texture);
      } else {
        window_.painter().set(i, picture.image);
      }
    }
    if (picture.complete && picture.full == pane_extent()) s.whole_seconds = picture.seconds;
    s.picture = std::move(picture);
  }

  // The picture that is shown, read back where it is a texture.
  const HostImage& image(int i) {
    ViewPicture& p = *sources_[static_cast<std::size_t>(i)].picture;
    if (p.texture && p.image.values.empty()) p.image = window_.painter().read(i);
    return p.image;
  }

  void tell_difference() {
    constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    const auto& pair = pairs[difference_ = state_.difference];
    const std::string names = fmt::format("{} - {}", view_source_names.at(static_cast<std::size_t>(pair[0])),
                                          view_source_names.at(static_cast<std::size_t>(pair[1])));
    const auto &a = sources_[static_cast<std::size_t>(pair[0])], &b = sources_[static_cast<std::size_t>(pair[1])];
    const bool both = whole(a) && whole(b) && a.picture->extent == b.picture->extent;
    if (!both) return void(difference_text_ = names + ": not yet");
    const ViewDifference d = difference_of(image(pair[0]), image(pair[1]));
    window_.painter().set(difference_slot, d.shown);
    difference_text_ = names + ": " + d.text;
  }

  // The picture is of the scene as it is now.
  bool whole(const Source& s) const {
    return s.picture && s.asked && s.picture->number == s.asked->number && s.picture->complete && s.picture->error.empty() &&
           s.asked->revision == session_.revision() && s.picture->extent == pane_extent();
  }

  void draw() {
    window_.begin_frame();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (std::size_t k = 0; k < panes_.size(); ++k) {
      const int slot = state_.split ? static_cast<int>(k) : static_cast<int>(state_.source);
      draw_pane(list, panes_[k], slot);
    }
    ViewReport report;
    for (std::size_t i = 0; i < sources; ++i) {
      if (!shows(static_cast<int>(i))) continue;
      report.pictures[i] = sources_[i].picture ? &*sources_[i].picture : nullptr;
      report.busy[i] = sources_[i].worker && sources_[i].worker->busy();
    }
    if (sources_[2].worker) report.reference_fraction = sources_[2].worker->fraction();
    if (state_.split) report.error = difference_text_;
    const Extent e = window_.extent();
    if (state_.panel) panel_.draw(e.width - panel_width, e.height, report);
    window_.end_frame(state_.window_wanted);
  }

  void draw_pane(ImDrawList& list, const ViewPane& pane, int slot) {
    const auto at = [](const glm::dvec2& p) { return ImVec2(static_cast<float>(p.x), static_cast<float>(p.y)); };
    window_.draw_picture(slot, pane, slot == difference_slot ? 0 : state_.exposure);
    constexpr ImU32 bright = IM_COL32(255, 220, 120, 255), dark = IM_COL32(0, 0, 0, 160);
    list.PushClipRect(at(pane.low), at(pane.low + pane.size));
    const Screen screen(session_.scene().camera);
    for (const LightSource& l : session_.scene().lights) {
      const auto seen = l.type == LightType::point ? screen.seen(l.position) : std::nullopt;
      if (!seen || slot == difference_slot) continue;
      list.AddCircle(at(pane.window(seen->at)), ViewInput::handle_radius, dark, 0, 3);
      list.AddCircle(at(pane.window(seen->at)), ViewInput::handle_radius, bright, 0, 1.5F);
    }
    if (state_.tool == ViewTool::select)
      list.AddRect(at(pane.window(state_.selection.from)), at(pane.window(state_.selection.to)), bright);
    if (state_.split) {
      const std::string label = slot == difference_slot ? difference_text_ : view_source_names.at(static_cast<std::size_t>(slot));
      const ImVec2 size = ImGui::CalcTextSize(label.c_str());
      const glm::dvec2 corner = pane.low + 6.0;
      list.AddRectFilled(at(corner - 3.0), at(corner + glm::dvec2(size.x, size.y) + 3.0), dark);
      list.AddText(at(corner), bright, label.c_str());
    }
    list.PopClipRect();
  }

  // The first free name of a numbered series beside the scene that save() writes.
  std::string free_name(const std::string& suffix) const {
    const std::filesystem::path p(c_.output.empty() ? c_.scene : c_.output);
    for (int n = 1;; ++n) {
      const std::filesystem::path name = p.parent_path() / fmt::format("{}_{}_{}.png", p.stem().string(), suffix, n);
      if (!std::filesystem::exists(name)) return name.string();
    }
  }

  void write(const std::string& suffix, const HostImage& image, double exposure) {
    ImageFileOptions file;
    file.exposure = exposure;
    if (suffix == "picture")
      file.metadata = {{"airlight:backend", view_source_names.at(static_cast<std::size_t>(state_.source))}};
    const std::string name = free_name(suffix);
    write_image(name, image, file);
    tell(name + ": written");
  }

  void tell(const std::string& text) {
    state_.status = text;
    terminal_.log(LogLevel::info, text);
    redraws_ = 3;
  }

  // What keys and buttons have asked for; pictures only when they show the scene as it is.
  void serve() {
    try {
      if (state_.save_wanted) {
        state_.save_wanted = false;
        input_.stop();
        tell(session_.save() + ": written");
      }
      const Source& shown = sources_[static_cast<std::size_t>(state_.source)];
      const bool failed = shown.picture && !shown.picture->error.empty();
      if (failed) state_.picture_wanted = false;
      if (state_.picture_wanted && !state_.split && whole(shown)) {
        state_.picture_wanted = false;
        write("picture", image(static_cast<int>(state_.source)), static_cast<double>(state_.exposure));
      }
      if (state_.window_wanted && window_.pixels().channels > 0 && (failed || state_.split || whole(shown))) {
        state_.window_wanted = false;
        write("window", window_.pixels(), 0);
      }
      if (state_.picture_wanted && state_.split) {
        state_.picture_wanted = false;
        state_.status = "a picture is of one source, not of a split view";
      }
    } catch (const std::exception& e) {
      state_.save_wanted = state_.picture_wanted = state_.window_wanted = false;
      tell(e.what());
    }
    if (!state_.clipboard.empty()) {
      window_.copy(state_.clipboard);
      terminal_.log(LogLevel::info, state_.clipboard);
      state_.clipboard.clear();
    }
  }

  const ViewCommand& c_;
  Terminal& terminal_;
  ViewState state_;
  ViewSession session_;
  ViewWindow window_;
  ViewInput input_;
  ViewPanel panel_;
  std::array<Source, sources> sources_;  // their threads wake the window: they end before it
  std::vector<ViewPane> panes_;
  std::uint64_t next_ = 0;
  int difference_ = -1, redraws_ = 3;
  std::string difference_text_;
  Clock::time_point last_event_{};
};

}  // namespace

int view(const ViewCommand& c, Terminal& terminal) {
  if (c.renderer.backend != "cpu" && c.renderer.backend != "gl")
    throw InputError("unknown backend \"" + c.renderer.backend + "\", expected cpu | gl");
  Viewer(c, terminal).run();
  return 0;
}

}  // namespace airlight
