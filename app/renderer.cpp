#include <algorithm>
#include <cfenv>
#include <cstdio>
#include <functional>
#include <map>
#include <stdexcept>
#include <thread>

#include "app/airlight.h"
#include "app/explained.h"
#include "app/plan_tree.h"
#include "app/request.h"
#include "app/supersample.h"
#include "common/plan/geometry.h"
#include "common/plan/hash.h"
#include "common/plan/keys.h"
#include "common/plan/light_slots.h"
#include "common/plan/upload.h"
#include "common/reference/reference.h"
#include "common/spelling.h"
#include "common/techniques/choose.h"
#include "common/transfer/transfer_maker.h"
#include "cpu/backend.h"
#include "gpu/backend.h"

namespace airlight {

namespace {

std::unique_ptr<Backend> make_backend(const RendererOptions& o) {
  if (o.backend == "gl") return make_gl_backend({.context = o.gl_context, .device = o.gl_device, .host = o.gl_host});
  if (o.backend != "cpu") throw InputError("unknown backend \"" + o.backend + "\", expected cpu | gl");
  CpuOptions cpu;
  cpu.threads = o.threads;
  if (o.simd == "auto") return std::make_unique<CpuBackend>(cpu);
  constexpr std::pair<std::string_view, Simd> names[] = {
      {"scalar", Simd::scalar}, {"avx2", Simd::avx2}, {"avx512", Simd::avx512}, {"neon", Simd::neon}};
  for (const auto& [name, simd] : names) {
    if (name == o.simd) {
      cpu.simd = simd;
      return std::make_unique<CpuBackend>(cpu);
    }
  }
  throw InputError("unknown SIMD target \"" + o.simd + "\", expected auto | scalar | avx2 | avx512 | neon");
}

int threads_of(const RendererOptions& options) {
  return options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// The default floating-point mode while it lives, then the caller's: plans and tables must not depend on it.
class DefaultFloats {
 public:
  DefaultFloats() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloats() { std::fesetenv(&before_); }
  DefaultFloats(const DefaultFloats&) = delete;
  DefaultFloats& operator=(const DefaultFloats&) = delete;

 private:
  std::fenv_t before_{};
};

using Images = std::map<std::string, HostImage>;

HostImage image_of(Backend& backend, const Plan::Output& output, Rows wanted) {
  const Image& from = output.image;
  const Rows rows = within(wanted, from.extent.height);
  HostImage image({from.extent.width, rows.count()}, channels(from.format));
  if (from.layers == 1) {
    backend.download(from, rows, image.values);
    return image;
  }
  std::vector<float> layers(image.values.size() * static_cast<std::size_t>(from.layers));
  backend.download(from, rows, layers);
  const auto first = layers.begin() + static_cast<std::ptrdiff_t>(image.values.size()) * output.layer;
  std::copy_n(first, image.values.size(), image.values.begin());
  return image;
}

void run_plan(Backend& backend, const Plan& plan, Rows rows, Stats& stats, Progress& progress) {
  for (const Plan::Upload& upload : plan.uploads) {
    progress.check();
    if (!backend.holds(upload.buffer, upload.key)) backend.upload(upload.buffer, upload.make(), upload.key);
  }
  Stats pass;
  backend.run(plan.steps, rows, pass, progress);
  if (stats.steps.empty()) {
    describe_steps(plan, pass.steps);
    stats = std::move(pass);
    stats.skips = skips_of(plan);
  } else {
    add(stats, pass);
  }
}

}  // namespace

struct Renderer::State {
  RendererOptions options;
  std::unique_ptr<Backend> backend;
  std::shared_ptr<TransferMaker> transfer;
  std::uint64_t seen = 0;  // the camera and the technique of the last pass
  LightSlots slots;        // and its lights

  int threads() const { return threads_of(options); }

  static std::uint64_t camera_key(const Technique& technique, const Scene& scene, const FrameRequest& request) {
    Hash key;
    key.add(technique.name);
    key.add(view_of(scene, request));
    for (int c = 0; c < 3; ++c) key.add(scene.camera.position[c]);
    return key.value();
  }
  bool holds(Handle h, std::uint64_t key) const { return backend->holds(h, key); }
  // What is handed from step to step is kept from the second frame on in which the camera stands still; nothing runs for that
  // alone.
  Plan plan(const Technique& technique, const Scene& scene, FrameRequest request, Rows rows) const {
    request.light_slots = slots.after(scene.lights).numbers();
    Plan made = technique.plan(scene, request);
    const bool whole = within(rows, request.extent.height) == Rows{0, request.extent.height};  // bands are there to save memory
    if (whole && camera_key(technique, scene, request) == seen)
      keep_images(
          made, [&](Handle h, std::uint64_t key) { return holds(h, key); }, options.keep);
    return made;
  }

  Plan run(const Technique& technique, const Scene& scene, const FrameRequest& request, Rows rows, Stats& stats,
           Progress& progress) {
    Plan made = plan(technique, scene, request, rows);
    seen = camera_key(technique, scene, request);
    slots = slots.after(scene.lights);
    run_plan(*backend, made, rows, stats, progress);
    return made;
  }

  std::vector<NamedTexture> textures(const Technique& technique, const Scene& scene, const FrameRequest& request, Stats& stats,
                                     Progress& progress) {
    const Plan made = run(technique, scene, request, {}, stats, progress);
    std::vector<NamedTexture> taken;
    for (const Plan::Output& output : made.outputs) {
      if (output.image.layers > 1) throw InputError("textures: the image " + output.name + " is a layer of one of several");
      taken.push_back({output.name, backend->take(output.image)});
    }
    return taken;
  }

  Images pass(const Technique& technique, const Scene& scene, const FrameRequest& request, Rows rows, Stats& stats,
              Progress& progress) {
    Images images;
    if (technique.plan) {
      const Plan made = run(technique, scene, request, rows, stats, progress);
      for (const Plan::Output& output : made.outputs) images.emplace(output.name, image_of(*backend, output, rows));
    } else {
      images = render_reference(scene, request, rows, threads(), stats, progress);
    }
    const Extent extent{request.extent.width, within(rows, request.extent.height).count()};
    for (const std::string& name : request.images) {  // left out because it is black: a light without power
      images.try_emplace(name, extent, image_channels(name));
    }
    return images;
  }
};

std::string_view version() { return AIRLIGHT_VERSION; }

Renderer::Renderer(const RendererOptions& options) : state_(std::make_unique<State>()) {
  state_->options = options;
  state_->backend = make_backend(options);
  state_->transfer = std::make_shared<TransferMaker>(threads_of(options), options.transfer_files);
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

std::string Renderer::describe() const { return state_->backend->describe(); }

const HostImage& Frame::image(std::string_view name) const {
  for (const NamedImage& i : images) {
    if (i.name == name) return i.image;
  }
  throw std::out_of_range("the frame has no image " + std::string(name));
}

const std::shared_ptr<GlTexture>& Frame::texture(std::string_view name) const {
  for (const NamedTexture& t : textures) {
    if (t.name == name) return t.texture;
  }
  throw std::out_of_range("the frame has no texture " + std::string(name));
}

Frame Renderer::render(const Scene& scene, const RenderSettings& asked, Progress& progress) {
  const DefaultFloats mode;
  const RenderSettings settings = chosen_for_goal(scene, asked, state_->options).first;
  const Technique& technique = chosen_technique(scene, settings);
  FrameRequest request = request_for(technique, scene, settings);
  const Rows all{0, request.extent.height};
  if (settings.textures && !(state_->options.backend == "gl" && state_->options.gl_host && settings.supersample == 1 &&
                             within(settings.rows, all.end) == all))
    throw InputError("textures: expected backend gl with a gl_host, one sample a pixel and all rows");
  if (!technique.plan && state_->options.backend != "cpu") {
    throw InputError("technique " + std::string(technique.name) + " runs in double on the CPU, not on backend " +
                     state_->options.backend);
  }

  // What was asked before a failure is no part of this frame.
  state_->transfer->report_to(progress);
  state_->transfer->take_stats();
  request.transfer = state_->transfer;
  Frame frame;
  frame.technique = technique.name;
  frame.knobs = request.knobs.all();
  frame.device = technique.plan ? describe() : "reference, double, " + std::to_string(state_->threads()) + " threads";

  Images images;
  if (settings.textures) {
    frame.textures = state_->textures(technique, scene, request, frame.stats, progress);
  } else if (settings.supersample == 1) {
    images = state_->pass(technique, scene, request, settings.rows, frame.stats, progress);
  } else {
    // beauty stays the float sum of the averaged parts.
    const bool beauty = request.images.contains("beauty");
    if (beauty) request.images.insert({"surface", "airlight"});
    Supersampler samples;
    const std::vector<glm::dvec2> centres = subpixel_centres(settings.supersample);
    for (std::size_t k = 0; k < centres.size(); ++k) {
      progress.report("samples", static_cast<double>(k) / static_cast<double>(centres.size()));
      request.offset = centres[k];
      for (const auto& [name, image] : state_->pass(technique, scene, request, settings.rows, frame.stats, progress)) {
        samples.add(name, image);
      }
    }
    for (const std::string& name : request.images) images.emplace(name, samples.mean(name));
    if (beauty) {
      const HostImage &surface = images.at("surface"), &airlight = images.at("airlight");
      HostImage& sum = images.at("beauty");
      for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] = surface.values[i] + airlight.values[i];
    }
  }
  const std::vector<StepStats> made = state_->transfer->take_stats();
  for (StepStats& step : frame.stats.steps) {
    for (StepInput& input : step.inputs)
      if (input.step >= 0) input.step += static_cast<int>(made.size());
  }
  frame.stats.steps.insert(frame.stats.steps.begin(), made.begin(), made.end());
  if (settings.textures) return frame;
  for (const std::string& name : settings.images) {
    auto image = images.extract(name);  // empty where it is asked for again
    frame.images.push_back({name, image ? std::move(image.mapped()) : frame.image(name)});
  }
  return frame;
}

std::vector<Rows> Renderer::bands_within(const Scene& scene, const RenderSettings& asked, std::uint64_t most,
                                         bool strictly) const {
  const DefaultFloats mode;
  const RenderSettings settings = chosen_for_goal(scene, asked, state_->options).first;
  const Technique& technique = chosen_technique(scene, settings);
  FrameRequest request = request_for(technique, scene, settings);
  Plan plan = technique.plan ? technique.plan(scene, request) : Plan();
  std::uint64_t uploads = bytes_of_uploads(plan);
  const auto bytes = [&](Rows rows) {
    std::uint64_t sum = technique.plan ? uploads + state_->backend->bytes_for(plan.steps, rows) : 0;
    // The frame's own; of several samples their sum in double as well.
    const std::uint64_t value = settings.supersample > 1 ? 2 * sizeof(float) + sizeof(double) : sizeof(float);
    for (const std::string& name : request.images) {
      sum += value * static_cast<std::uint64_t>(image_channels(name)) * static_cast<std::uint64_t>(request.extent.width) *
             static_cast<std::uint64_t>(rows.count());
    }
    return sum;
  };
  const Rows all = within(settings.rows, request.extent.height);
  constexpr int side = 64;
  // Before it refuses a scene it asks what surfaces hide of an environment, which takes long: there is less of that than bounded.
  const auto asked_exactly = [&] {
    if (!technique.plan || request.transfer || least_bytes_of_uploads(plan) > most) return false;
    request.transfer = state_->transfer;
    plan = technique.plan(scene, request);
    const std::uint64_t bound = uploads;
    uploads = bytes_of_uploads(plan);
    return uploads < bound;
  };
  int height = all.count();
  for (std::uint64_t count = 1; bytes({all.first, all.first + height}) > most; ++count) {
    if (height <= side) {
      if (!strictly) break;
      if (asked_exactly()) {
        height = all.count(), count = 0;
        continue;
      }
      const auto in_mebibytes = [](std::uint64_t n) { return std::to_string((n >> 20U) + 1) + " MiB"; };
      const std::uint64_t needed = bytes({all.first, all.first + height});
      throw MachineError("not enough memory is allowed: " + std::to_string(height) + " rows of this image take " +
                         in_mebibytes(needed) +
                         (uploads > 0 ? ", of which the scene's meshes, grids and tables are " + in_mebibytes(uploads) : "") +
                         ", expected at least that");
    }
    const auto share = static_cast<int>((static_cast<std::uint64_t>(all.count()) / (count + 1) + side - 1) / side * side);
    height = std::max(share, side);
  }
  if (height == all.count()) return {all};
  std::vector<Rows> bands;
  for (int first = all.first; first < all.end; first = bands.back().end)
    bands.push_back({first, std::min(first / side * side + height, all.end)});
  return bands;
}

Frame Renderer::render(const Scene& scene, const RenderSettings& settings) {
  NoProgress progress;
  return render(scene, settings, progress);
}

std::pair<RenderSettings, std::string> chosen_for_goal(const Scene& scene, const RenderSettings& asked,
                                                       const RendererOptions& options) {
  if (!asked.goal) return {asked, ""};
  if (!asked.knobs.empty()) throw InputError("--set: a goal (--error, --budget) chooses the settings, expected one of the two");
  if (asked.technique == "reference")
    throw InputError("technique reference has no model of its error or time, expected another for a goal");
  if (asked.goal.seconds && options.backend != "cpu")
    throw InputError("--budget: times are modelled for the backend cpu only, expected --error");
  const std::string only = asked.technique == "auto" ? "" : std::string(technique(asked.technique).name);
  const int samples = asked.supersample * asked.supersample;
  Extent extent = asked.resolution.value_or(scene.camera.resolution);
  extent.height *= std::max(samples, 1);  // as many pixels
  const Choice choice = choose(scene, extent, asked.goal, only, threads_of(options));
  RenderSettings settings = asked;
  settings.technique = choice.technique;
  settings.knobs = choice.settings;
  settings.goal = {};
  return {settings, choice.text()};
}

Frame planned_frame(const Scene& scene, const RenderSettings& asked) {
  const RenderSettings settings = chosen_for_goal(scene, asked, {}).first;
  const Technique& technique = chosen_technique(scene, settings);
  Frame frame;
  frame.technique = technique.name;
  frame.knobs = request_for(technique, scene, settings).knobs.all();
  return frame;
}

std::string explain(const Scene& scene, const RenderSettings& asked) {
  return explained(
      scene, asked, {}, [](const Technique& t, const Scene& s, const FrameRequest& r) { return t.plan(s, r); },
      [](Handle, std::uint64_t) { return false; });
}

std::string Renderer::explain(const Scene& scene, const RenderSettings& asked) const {
  const DefaultFloats mode;
  const State& state = *state_;
  return explained(
      scene, asked, state.options,
      [&](const Technique& t, const Scene& s, const FrameRequest& r) { return state.plan(t, s, r, {}); },
      [&](Handle h, std::uint64_t key) { return state.holds(h, key); });
}

std::string stats_text(const Frame& frame) {
  std::string text = frame.technique + " on " + frame.device + "\n" + plan_tree(frame.stats, true);
  if (!frame.stats.skips.empty()) text += "left out\n" + left_out(frame.stats);
  return text;
}

}  // namespace airlight
