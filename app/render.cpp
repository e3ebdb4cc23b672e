#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <tuple>

#include "app/command.h"
#include "app/sequence.h"
#include "common/scene/temporary_file.h"

namespace airlight {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) { return std::chrono::duration<double>(to - from).count(); }

struct Times {
  double load = 0, render = 0, write = 0;  // [s]
};

// The text of a JSON string.
std::string quoted(std::string_view text) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') all += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      all += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      all += c;
    }
  }
  return all + '"';
}

std::string stats_json(const Frame& frame, const Times& times, const std::string& hash) {
  std::string steps, knobs;
  for (const StepStats& s : frame.stats.steps) {
    const std::string note = s.note.empty() ? "" : fmt::format(", \"note\": {}", quoted(s.note));
    std::string residuals;
    if (!s.residuals.empty()) {
      // After a first round nothing may be known of what is left out.
      residuals = fmt::format(", \"residuals\": [{}], \"left_out\": {}, \"converged\": {}", fmt::join(s.residuals, ", "),
                              std::isfinite(s.left_out) ? fmt::format("{}", s.left_out) : "null", s.converged);
    }
    steps += fmt::format("{}\n    {{ \"name\": {}, \"seconds\": {}, \"items\": {}, \"reused\": {}{}{} }}",
                         steps.empty() ? "" : ",", quoted(s.name), s.seconds, s.items, s.reused, residuals, note);
  }
  for (const auto& [name, value] : frame.knobs)
    knobs += fmt::format("{}{}: {}", knobs.empty() ? "" : ", ", quoted(name), quoted(value));
  return fmt::format(
      "{{\n  \"version\": {}, \"scene\": {},\n  \"technique\": {}, \"settings\": {{ {} }}, \"device\": {},\n"
      "  \"seconds\": {{ \"load\": {}, \"render\": {}, \"steps\": {}, \"write\": {} }},\n  \"steps\": [{}\n  ]\n}}\n",
      quoted(version()), quoted(hash), quoted(frame.technique), knobs, quoted(frame.device), times.load, times.render,
      frame.stats.seconds, times.write, steps);
}

void print_stats(const Frame& frame, const Times& times) {
  fmt::print("{} on {}\n", frame.technique, frame.device);
  for (const StepStats& s : frame.stats.steps) {
    fmt::print("  {:<24} {:>10.3f} ms  {:>10} items{}", s.name, 1e3 * s.seconds, s.items, s.reused ? "  reused" : "");
    if (!s.residuals.empty()) {
      fmt::print("  {} rounds, the last changed {:.2g}, about {:.2g} are left out", s.residuals.size(), s.residuals.back(),
                 s.left_out);
      if (!s.converged) fmt::print(": more than tolerance allows, raise iterations");
    }
    fmt::print("{}{}\n", s.note.empty() ? "" : "  ", s.note);
  }
  fmt::print("  {:<24} {:>10.3f} ms\n", "all steps, wall time", 1e3 * frame.stats.seconds);
  fmt::print("load {:.3f} s, render {:.3f} s, write {:.3f} s\n", times.load, times.render, times.write);
}

// Nothing that changes from run to run, or with the number of threads and the SIMD target, which change no bit.
std::vector<std::pair<std::string, std::string>> metadata(const Scene& scene, const Frame& frame, const RenderCommand& c) {
  std::vector<std::pair<std::string, std::string>> all{{"airlight:version", std::string(version())},
                                                       {"airlight:technique", frame.technique},
                                                       {"airlight:scene", scene.hash},
                                                       {"airlight:supersample", std::to_string(c.settings.supersample)}};
  if (frame.technique != "reference") all.emplace_back("airlight:backend", c.renderer.backend);
  for (const auto& [name, value] : frame.knobs) all.emplace_back("airlight:set:" + name, value);
  return all;
}

// A line instead, of one of many frames.
void print_frame_stats(int number, const Frame& frame, const Times& times) {
  const auto reused =
      std::count_if(frame.stats.steps.begin(), frame.stats.steps.end(), [](const StepStats& s) { return s.reused; });
  fmt::print("frame {}: load {:.3f} s, render {:.3f} s, write {:.3f} s, {} steps run, {} reused\n", number, times.load,
             times.render, times.write, static_cast<std::ptrdiff_t>(frame.stats.steps.size()) - reused, reused);
}

// Renders the frames of a command, one after the other.
class Sequence {
 public:
  Sequence(const RenderCommand& c, Terminal& terminal)
      : c_(c), terminal_(terminal), file_(c.scene), frames_(frames_of(c, file_)), progress_(terminal, frames_.size()) {}

  void render(const RenderSettings& settings) {
    for (const int frame : frames_) {
      progress_.begin(frame);
      progress_.end(render_frame(frame, settings));
    }
  }

 private:
  // Whether it had to be rendered.
  bool render_frame(int number, RenderSettings settings) {
    Times times;
    const Clock::time_point start = Clock::now();
    const Scene scene = file_.scene(number, progress_);
    const Clock::time_point loaded = Clock::now();
    times.load = seconds_between(start, loaded);
    terminal_.log(LogLevel::debug, fmt::format("{}: loaded in {:.3f} s, {}", c_.scene, times.load, scene.hash));
    std::string chosen;
    std::tie(settings, chosen) = chosen_for_goal(scene, settings, c_.renderer);
    if (!chosen.empty()) chosen += "\n";
    tell(c_.quiet ? "" : chosen, chosen_);
    const std::string plan = explain(scene, settings);
    tell(c_.explain ? plan : "", plan_);
    terminal_.log(LogLevel::debug, plan);

    const std::string output = output_name(c_, c_.output, number);
    ImageFileOptions file = c_.file;
    if (c_.resume) {
      file.metadata = metadata(scene, planned_frame(scene, settings), c_);
      const Extent extent = settings.resolution.value_or(scene.camera.resolution);
      if (is_there(output, settings.images, extent, file, terminal_)) {
        if (c_.stats) fmt::print("frame {}: kept\n", number);
        return false;
      }
    }
    if (!renderer_) renderer_.emplace(c_.renderer);
    const Frame frame = renderer_->render(scene, settings, progress_);
    const Clock::time_point rendered = Clock::now();
    times.render = seconds_between(loaded, rendered);

    file.metadata = metadata(scene, frame, c_);
    const std::vector<std::string> names = write_images(output, frame.images, file);
    times.write = seconds_between(rendered, Clock::now());
    for (const std::string& name : names) {
      terminal_.log(LogLevel::info,
                    fmt::format("{}: {} by {} on {}, {:.3f} s", name, c_.scene, frame.technique, frame.device, times.render));
    }
    if (c_.stats && frames_.size() == 1) print_stats(frame, times);
    if (c_.stats && frames_.size() > 1) print_frame_stats(number, frame, times);
    if (!c_.stats_file.empty()) {
      const std::string text = stats_json(frame, times, scene.hash);
      TemporaryFile stats(output_name(c_, c_.stats_file, number));
      stats.write(text.data(), text.size());
      stats.rename_to_target();
    }
    return true;
  }

  // On standard output, where the last frame had something else to tell.
  static void tell(const std::string& text, std::string& last) {
    if (text == last) return;
    fmt::print("{}", text);
    last = text;
  }

  const RenderCommand& c_;
  Terminal& terminal_;
  SceneFile file_;
  std::vector<int> frames_;
  SequenceProgress progress_;
  std::optional<Renderer> renderer_;  // made for the first frame that is not there; runs what the next one has not in common
  std::string chosen_, plan_;
};

}  // namespace

int render(const RenderCommand& c, Terminal& terminal) {
  RenderSettings settings = c.settings;
  settings.images = {"beauty"};
  for (const std::string& name : c.aovs) {
    if (std::find(settings.images.begin(), settings.images.end(), name) == settings.images.end()) settings.images.push_back(name);
  }
  check_image_path(c.output, c.file);
  Sequence(c, terminal).render(settings);
  return 0;
}

int explain(const RenderCommand& c, Terminal& terminal) {
  RenderSettings settings = c.settings;
  settings.images = {"beauty"};
  settings.images.insert(settings.images.end(), c.aovs.begin(), c.aovs.end());
  fmt::print("{}", explain(load_scene(c.scene, terminal), settings));
  return 0;
}

}  // namespace airlight
