#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <tuple>

#include "app/command.h"
#include "app/plan_tree.h"
#include "app/sequence.h"
#include "app/tile.h"
#include "common/scene/gltf_scene.h"
#include "common/scene/image_format.h"
#include "common/scene/image_writer.h"
#include "common/scene/merge.h"
#include "common/scene/sha256.h"
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
  std::string steps, skips, knobs;
  for (const StepStats& s : frame.stats.steps) {
    const std::string note = s.note.empty() ? "" : fmt::format(", \"note\": {}", quoted(s.note));
    std::vector<std::string> inputs;
    for (const StepInput& input : s.inputs)
      inputs.push_back(fmt::format("{{ \"name\": {}, \"step\": {} }}", quoted(input.name), input.step));
    std::string residuals;
    if (!s.residuals.empty()) {
      // After a first round nothing may be known of what is left out.
      residuals = fmt::format(", \"residuals\": [{}], \"left_out\": {}, \"converged\": {}", fmt::join(s.residuals, ", "),
                              std::isfinite(s.left_out) ? fmt::format("{}", s.left_out) : "null", s.converged);
    }
    const bool known = s.reused || s.counted;
    std::string skipped;
    if (s.counted && s.skipped > 0) skipped += fmt::format(", \"why_skipped\": {}", quoted(s.why_skipped));
    if (s.counted && !s.parts.name.empty())
      skipped += fmt::format(", \"parts\": {{ \"name\": {}, \"all\": {}, \"skipped\": {}, \"why_skipped\": {} }}",
                             quoted(s.parts.name), s.parts.all, s.parts.skipped, quoted(s.parts.why));
    steps += fmt::format(
        "{}\n    {{ \"name\": {}, \"why\": {}, \"inputs\": [{}], \"seconds\": {}, \"estimate\": {}, \"bytes\": {}, \"held\": {}, "
        "\"items\": {}, \"skipped\": {}, \"reused\": {}{}{}{} }}",
        steps.empty() ? "" : ",", quoted(s.name), quoted(s.why), fmt::join(inputs, ", "), s.seconds, s.estimate, s.bytes, s.held,
        s.items, known ? fmt::format("{}", s.skipped) : "null", s.reused, skipped, residuals, note);
  }
  for (const SkipStats& s : frame.stats.skips) {
    skips += fmt::format("{}\n    {{ \"rule\": {}, \"what\": {}, \"why\": {} }}", skips.empty() ? "" : ",", quoted(s.rule),
                         quoted(s.what), quoted(s.why));
  }
  for (const auto& [name, value] : frame.knobs)
    knobs += fmt::format("{}{}: {}", knobs.empty() ? "" : ", ", quoted(name), quoted(value));
  return fmt::format(
      "{{\n  \"version\": {}, \"scene\": {},\n  \"technique\": {}, \"settings\": {{ {} }}, \"device\": {},\n"
      "  \"seconds\": {{ \"load\": {}, \"render\": {}, \"steps\": {}, \"write\": {} }},\n  \"steps\": [{}\n  ],\n  \"left_out\": "
      "[{}\n  ]\n}}\n",
      quoted(version()), quoted(hash), quoted(frame.technique), knobs, quoted(frame.device), times.load, times.render,
      frame.stats.seconds, times.write, steps, skips);
}

double mebibytes(std::uint64_t bytes) { return static_cast<double>(bytes) / (1U << 20U); }

std::uint64_t most_held(const Stats& stats) {
  std::uint64_t most = 0;
  for (const StepStats& s : stats.steps) most = std::max(most, s.held);
  return most;
}

// [byte] of physical memory that this process has had.
std::uint64_t most_resident() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void print_stats(const Frame& frame, const Times& times) {
  fmt::print("{}", stats_text(frame));
  fmt::print("all steps {:.3f} ms of wall time\n", 1e3 * frame.stats.seconds);
  fmt::print("load {:.3f} s, render {:.3f} s, write {:.3f} s\n", times.load, times.render, times.write);
  fmt::print("at most {:.1f} MiB held by a step, {:.1f} MiB by the program\n", mebibytes(most_held(frame.stats)),
             mebibytes(most_resident()));
}

// Nothing that changes from run to run, or with the number of threads and the SIMD target, which change no bit.
std::vector<std::pair<std::string, std::string>> metadata(const Scene& scene, const Frame& frame, const RenderCommand& c) {
  std::vector<std::pair<std::string, std::string>> all{{"airlight:version", std::string(version())},
                                                       {"airlight:technique", frame.technique},
                                                       {"airlight:scene", scene.hash},
                                                       {"airlight:supersample", std::to_string(c.settings.supersample)}};
  if (frame.technique != "reference") all.emplace_back("airlight:backend", c.renderer.backend);
  for (const auto& [name, value] : frame.knobs) all.emplace_back("airlight:set:" + name, value);
  if (c.tile) all.emplace_back(tile_key, fmt::format("{}/{}", c.tile->number, c.tile->count));
  return all;
}

// A line instead, of one of many frames.
void print_frame_stats(int number, const Frame& frame, const Times& times) {
  std::map<std::string, int> kept;
  std::size_t ran = 0;
  for (const StepStats& s : frame.stats.steps) {
    if (!s.reused) ++ran;
    if (s.reused && s.asked) ++kept[s.name];
  }
  std::string names;
  for (const auto& [name, count] : kept)
    names += fmt::format("{}{}{}", names.empty() ? ", kept from the last frame: " : ", ", name,
                         count > 1 ? fmt::format(" of {}", count) : "");
  fmt::print("frame {}: load {:.3f} s, render {:.3f} s, write {:.3f} s, {} steps run{}\n", number, times.load, times.render,
             times.write, ran, names);
}

// With --fog or --visibility, which the scene's hash has to tell, too: --resume goes by it.
Scene with_fog(Scene scene, const RenderCommand& c) {
  if (!c.fog) return scene;
  if (*c.fog == 0 && scene.medium.emission != glm::dvec3(0) && !std::isfinite(scene.sky_distance))
    throw InputError("--fog: 0, but the medium's emission adds up to infinity without extinction or sky_distance");
  scene.medium.extinction = *c.fog;
  Sha256 hash;
  hash.add(fmt::format("{} fog {}", scene.hash, *c.fog));
  scene.hash = hash.hex();
  return scene;
}

// What of a glTF scene is not rendered.
void tell_notes(const RenderCommand& c, Terminal& terminal) {
  for (const std::string& note : gltf_notes(c.scene)) terminal.log(LogLevel::warning, note);
}

// Renders the frames of a command, one after the other.
class Sequence {
 public:
  Sequence(const RenderCommand& c, Terminal& terminal)
      : c_(c), terminal_(terminal), file_(c.scene), frames_(frames_of(c, file_)), progress_(terminal, frames_.size()) {
    tell_notes(c, terminal);
  }

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
    const Scene scene = with_fog(file_.scene(number, progress_), c_);
    const Clock::time_point loaded = Clock::now();
    times.load = seconds_between(start, loaded);
    terminal_.log(LogLevel::debug, fmt::format("{}: loaded in {:.3f} s, {}", c_.scene, times.load, scene.hash));
    std::string chosen;
    std::tie(settings, chosen) = chosen_for_goal(scene, settings, c_.renderer);
    if (!chosen.empty()) chosen += "\n";
    tell(c_.quiet ? "" : chosen, chosen_);
    if (c_.explain || terminal_.logs(LogLevel::debug)) {  // it looks at every tile of the image
      const std::string plan = renderer_ ? renderer_->explain(scene, settings) : explain(scene, settings);
      tell(c_.explain ? plan : "", plan_);
      terminal_.log(LogLevel::debug, plan);
    }

    const std::string output = output_name(c_, c_.output, number);
    const Extent extent = settings.resolution.value_or(scene.camera.resolution);
    settings.rows = rows_of(c_.tile, extent.height);
    ImageFileOptions file = c_.file;
    file.metadata = metadata(scene, planned_frame(scene, settings), c_);
    if (c_.resume && is_there(output, settings.images, extent, settings.rows, file, terminal_)) {
      if (c_.stats) fmt::print("frame {}: kept\n", number);
      return false;
    }
    std::vector<std::string> names;
    const Frame frame = render_to(output, scene, settings, extent, file, times, names);
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

  // Renders and writes the rows of the settings, as many at a time as there is memory for.
  Frame render_to(const std::string& output, const Scene& scene, RenderSettings settings, Extent extent,
                  const ImageFileOptions& file, Times& times, std::vector<std::string>& names) {
    if (!renderer_) {
      RendererOptions options = c_.renderer;
      if (c_.memory) options.keep = 0;  // what there is goes into bands as high as they may be
      renderer_.emplace(options);
    }
    const Clock::time_point start = Clock::now();
    const Rows rows = settings.rows;
    const std::vector<Rows> bands =
        renderer_->bands_within(scene, settings, c_.memory.value_or(default_memory), c_.memory.has_value());
    times.render = seconds_between(start, Clock::now());
    std::optional<ImageWriter> writer;
    Frame all;
    for (const Rows band : bands) {
      const Clock::time_point begin = Clock::now();
      settings.rows = band;
      Frame frame = renderer_->render(scene, settings, progress_);
      const Clock::time_point rendered = Clock::now();
      if (!writer) {
        std::vector<ImageWriter::Layer> layers;
        for (const NamedImage& image : frame.images) layers.push_back({image.name, image.image.channels});
        writer.emplace(output, layers, extent, rows, file);
      }
      writer->write(frame.images);
      times.render += seconds_between(begin, rendered);
      times.write += seconds_between(rendered, Clock::now());
      frame.images.clear();
      if (band.first == rows.first) {
        all = std::move(frame);
      } else {
        add(all.stats, frame.stats);
      }
    }
    const Clock::time_point written = Clock::now();
    names = writer->finish();
    times.write += seconds_between(written, Clock::now());
    return all;
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
  if (c.tile && lower_extension(c.output) != "exr")
    throw InputError(c.output + ": expected an EXR file for --tile, as no other tells where its rows belong");
  Sequence(c, terminal).render(settings);
  return 0;
}

int explain(const RenderCommand& c, Terminal& terminal) {
  RenderSettings settings = c.settings;
  settings.images = {"beauty"};
  settings.images.insert(settings.images.end(), c.aovs.begin(), c.aovs.end());
  tell_notes(c, terminal);
  fmt::print("{}", explain(with_fog(load_scene(c.scene, terminal), c), settings));
  return 0;
}

}  // namespace airlight
