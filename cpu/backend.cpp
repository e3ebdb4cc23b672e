#include "cpu/backend.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <map>
#include <stdexcept>
#include <thread>

#include "common/algorithms/each_field.h"
#include "common/plan/keys.h"
#include "common/plan/rows.h"
#include "cpu/groups.h"
#include "cpu/held_images.h"
#include "cpu/image_rows.h"
#include "cpu/kernels.h"
#include "cpu/parallel.h"
#include "cpu/particle_splats.h"
#include "cpu/shadow_planes.h"
#include "cpu/surface_visibility.h"

namespace airlight {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

int machine_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

// A transient image lives in tile scratch when only one group touches it.
struct Scratch {
  AlignedFloats floats;
  TileView view;
  std::vector<double> seconds;  // by step
  std::vector<StepCounts> counts;
};

}  // namespace

struct CpuBackend::State {
  Simd simd;
  bool fuse;
  Workers workers;
  std::map<Handle, HeldImage> images;
  std::map<Handle, HeldBuffer> buffers;
  std::map<std::size_t, Rasteriser> rasterisers;  // by position of their step
  std::map<std::size_t, ShadowRasteriser> shadow_rasterisers;
  std::map<std::size_t, std::vector<float>> splats;
  std::vector<Scratch> scratch;  // by worker
  Meanwhile meanwhile;
  int threads_that_ran = 0;

  explicit State(const CpuOptions& o) : simd(o.simd), fuse(o.fuse), workers(o.threads > 0 ? o.threads : machine_threads()) {
    scratch.resize(static_cast<std::size_t>(workers.threads()));
  }

  std::span<const std::byte> buffer(const Buffer& b) const {
    const auto found = buffers.find(b);
    if (found == buffers.end()) throw std::logic_error("a step reads a buffer that was not uploaded");
    return found->second.bytes;
  }
  template <class T>
  std::span<const T> buffer_of(const Buffer& b) const {
    const std::span<const std::byte> bytes = buffer(b);
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

  std::uint64_t upload_key(Handle h) const {
    if (const auto b = buffers.find(h); b != buffers.end()) return b->second.key;
    const auto i = images.find(h);
    if (i == images.end() || i->second.key == 0) throw std::logic_error("a step reads what was neither made nor uploaded");
    return i->second.key;
  }

  std::uint64_t held_bytes() const;
  void place_images(std::span<const Step>);
  template <class A>
  StepCounts run_volume(const A&);
  void run_group(const Group&, std::span<const Step>, std::span<StepStats>, Progress&);
  StepCounts prepare(std::size_t index, const SurfaceVisibility&, Rows);
  // ShadowPlanes, RayMarch, GaussianAirlight.
  template <class Shadowed>
  requires requires(const Shadowed& a) { a.volumes; }
  StepCounts prepare(std::size_t index, const Shadowed& a, Rows rows) {
    if (a.volumes) shadow_rasterisers[index].prepare(a.view, rows, a.lights.size(), buffer(a.volumes), simd, workers);
    return {};
  }
  StepCounts prepare(std::size_t index, const ParticleSplats& a, Rows) {
    see_splats(a, buffer_of<float>(a.splats), buffer_of<float>(a.particle_sources), buffer_of<std::int32_t>(a.lines), workers,
               simd, splats[index]);
    return {};
  }
  template <class PixelStep>
  StepCounts prepare(std::size_t, const PixelStep&, Rows) {
    return {};
  }

  void run_tile(std::size_t index, const SurfaceVisibility& a, const TileView& view, int) {
    float* const corners[3] = {view.plane(a.corners, 0), view.plane(a.corners, 1), view.plane(a.corners, 2)};
    const bool any =
        rasterisers.at(index).run_tile(view.tile, view.plane(a.distance), view.plane(a.normal, 0), view.plane(a.normal, 1),
                                       view.plane(a.normal, 2), view.plane(a.material), a.corners ? corners : nullptr);
    if (!any) view.skip(view.in_image(0, 0, tile_side));
  }
  void run_tile(std::size_t index, const ShadowPlanes& a, const TileView& view, int worker) {
    shadow_rasterisers.at(index).run_tile(a, view, worker);
  }
  void run_tile(std::size_t index, const ParticleSplats& a, const TileView& view, int) {
    airlight::run_tile(a, view, splats.at(index), simd);
  }
  template <class PixelStep>
  void run_tile(std::size_t, const PixelStep& a, const TileView& view, int) {
    if constexpr (PixelStep::domain != Domain::volume) airlight::run_tile(a, view, simd);
  }
  template <class Shadowed>
  requires requires(const Shadowed& a) { a.volumes; }
  void run_tile(std::size_t index, const Shadowed& a, const TileView& view, int worker) {
    std::span<const LitParts> lit;
    if (a.volumes && any_ray(view.plane(a.distance)))
      lit = shadow_rasterisers.at(index).lit_parts(a.view, a.distance, a.sky_distance, view, worker);
    airlight::run_tile(a, view, simd, lit);
  }
};

// A step that makes buffers, and no image.
template <class A>
StepCounts CpuBackend::State::run_volume(const A& a) {
  for (const Buffer& made : buffers_made_by(a)) {
    images.erase(made);  // another plan may have had an image under this handle
    HeldBuffer& held = buffers[made];
    held.bytes.resize(made.bytes);
    held.key = 0;
  }
  StepCounts counts;
  if constexpr (A::domain == Domain::volume) airlight::run_volume(a, BufferView(buffers, counts), workers, simd);
  return counts;
}

std::uint64_t CpuBackend::State::held_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [handle, image] : images) bytes += image.bytes();
  for (const auto& [handle, buffer] : buffers) bytes += buffer.bytes.size();
  for (const Scratch& s : scratch) bytes += s.floats.size() * sizeof(float);
  return bytes;
}

// Memory for what is held; what another plan or frame had under the same handles goes.
void CpuBackend::State::place_images(std::span<const Step> steps) {
  Meanwhile& m = meanwhile;
  m.find_held(steps);
  const auto is_held = [&](const Image& image) {
    return std::any_of(m.held.begin(), m.held.end(), [&](const HeldPart& h) { return h.image.id == image.id; });
  };
  for (const std::size_t i : m.running) {
    each_made<Image>(steps[i].what, [&](const Image& image) {
      buffers.erase(image);
      if (!is_held(image)) images.erase(image);
    });
  }
  for (const HeldPart& part : m.held) {
    HeldImage& image = images[part.image];
    image.key = 0;
    image.reset(part.image, part.rows);
  }
}

StepCounts CpuBackend::State::prepare(std::size_t index, const SurfaceVisibility& a, Rows rows) {
  return rasterisers[index].prepare(a, rows, buffer_of<float>(a.positions), buffer_of<float>(a.normals),
                                    buffer_of<std::uint32_t>(a.triangles), simd, workers);
}

namespace {

void tell(const StepCounts& counts, StepStats& step) {
  step.counted = true;
  step.skipped += counts.skipped;
  step.parts.all += counts.parts, step.parts.skipped += counts.skipped_parts;
}

}  // namespace

void CpuBackend::State::run_group(const Group& group, std::span<const Step> steps, std::span<StepStats> stats,
                                  Progress& progress) {
  if (const Step& head = steps[group.steps[0]]; domain_of(head.what) == Domain::volume) {
    const Clock::time_point start = Clock::now();
    StepStats& step = stats[group.steps[0]];
    tell(std::visit([&](const auto& a) { return run_volume(a); }, head.what), step);
    for (const Buffer& made : buffers_made_by(head.what)) step.items += made.bytes / sizeof(float);
    if (const auto* a = std::get_if<NetworkIteration>(&head.what)) a->tell(buffer_of<float>(a->residuals), step);
    step.seconds = seconds_since(start);
    step.held = held_bytes();
    threads_that_ran = std::max(threads_that_ran, workers.distinct_threads());
    return;
  }
  const Tiling tiling{group.extent, group.rows.computed};
  Meanwhile& m = meanwhile;
  m.places.clear(), m.inputs.clear();
  std::size_t scratch_floats = 0;
  std::uint32_t last_id = 0;
  const auto place = [&](const Image& image) {
    if (std::any_of(m.places.begin(), m.places.end(), [&](const Place& p) { return p.id == image.id; })) return;
    const auto held = images.find(image);
    const bool other = image.extent != group.extent;
    if (other && held == images.end()) throw std::logic_error("a step reads an image of another extent that is not there");
    const int first_tile = held == images.end() || other ? 0 : held->second.tiles_above(tiling);
    m.places.push_back({image.id, held == images.end() ? nullptr : &held->second, other, scratch_floats, first_tile});
    if (held == images.end()) {
      scratch_floats += static_cast<std::size_t>(image.layers * channels(image.format)) * tile_pixels;
    }
    last_id = std::max(last_id, image.id);
  };
  for (const std::size_t i : group.steps) {
    std::visit(
        [&](const auto& a) {
          a.fields(a, [&](const Field&, const auto& value) {
            using Value = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, Image>) {
              if (value) place(value);
            } else if constexpr (std::is_same_v<Value, Buffer>) {
              if (value) m.inputs.emplace_back(value.id, buffer(value)), last_id = std::max(last_id, value.id);
            } else if constexpr (std::is_same_v<Value, std::vector<Buffer>>) {
              for (const Buffer& b : value) m.inputs.emplace_back(b.id, buffer(b)), last_id = std::max(last_id, b.id);
            }
          });
          const Clock::time_point start = Clock::now();
          tell(prepare(i, a, group.rows.computed), stats[i]);
          stats[i].seconds += seconds_since(start);
        },
        steps[i].what);
  }
  for (Scratch& s : scratch) {
    s.floats.resize(scratch_floats);
    s.seconds.assign(steps.size(), 0.0);
    s.counts.assign(steps.size(), {});
    s.view.extent = group.extent;
    s.view.images.assign(last_id + 1, nullptr);
    s.view.others.assign(last_id + 1, nullptr);
    for (const Place& p : m.places) {
      if (p.other) s.view.others[p.id] = p.whole;
    }
    s.view.buffers.assign(last_id + 1, {});
    for (const auto& [id, bytes] : m.inputs) s.view.buffers[id] = bytes;
  }
  const auto one_tile = [&](int t, int worker) {
    if (progress.stop_requested()) throw Interrupted();
    Scratch& s = scratch[static_cast<std::size_t>(worker)];
    s.view.tile = tiling.tile(t);
    for (const Place& p : m.places) {
      if (!p.other) s.view.images[p.id] = p.whole ? p.whole->tile(p.first_tile + t) : s.floats.data() + p.offset;
    }
    for (const std::size_t i : group.steps) {
      const Clock::time_point start = Clock::now();
      s.view.counts = &s.counts[i];
      std::visit([&](const auto& a) { run_tile(i, a, s.view, worker); }, steps[i].what);
      s.seconds[i] += seconds_since(start);
    }
  };
  workers.each(tiling.count(), std::cref(one_tile));  // not copied, which would allocate
  threads_that_ran = std::max(threads_that_ran, workers.distinct_threads());
  for (const std::size_t i : group.steps) {
    for (const Scratch& s : scratch) {
      stats[i].seconds += s.seconds[i];
      tell(s.counts[i], stats[i]);
    }
    stats[i].items = static_cast<std::uint64_t>(group.extent.width) * static_cast<std::uint64_t>(group.rows.computed.count());
    stats[i].held = held_bytes();
  }
}

CpuBackend::CpuBackend(const CpuOptions& options) {
  const std::vector<Simd> there = available_simd();
  if (std::find(there.begin(), there.end(), options.simd) == there.end()) {
    throw MachineError("this machine or build has no " + std::string(name_of(options.simd)));
  }
  state_ = std::make_unique<State>(options);
}

CpuBackend::~CpuBackend() = default;

std::string CpuBackend::describe() const {
  const int n = state_->workers.threads();
  return "cpu, " + std::string(name_of(state_->simd)) + ", " + std::to_string(n) + (n == 1 ? " thread" : " threads");
}

void CpuBackend::upload(Buffer buffer, std::span<const std::byte> bytes, std::uint64_t key) {
  state_->images.erase(buffer);  // another plan may have had an image under this handle
  HeldBuffer& held = state_->buffers[buffer];
  held.bytes.assign(bytes.begin(), bytes.end());
  held.key = key;
}

bool CpuBackend::holds(Handle h, std::uint64_t key) const {
  const auto image = state_->images.find(h);
  const auto buffer = state_->buffers.find(h);
  return (image != state_->images.end() && image->second.key == key) ||
         (buffer != state_->buffers.end() && buffer->second.key == key);
}

void CpuBackend::upload(const Image& image, std::span<const float> rows, std::uint64_t key) {
  state_->buffers.erase(image);
  HeldImage& held = state_->images[image];
  held.reset(image);
  held.from_rows(rows);
  held.key = key;
}

void CpuBackend::run(std::span<const Step> steps, Rows wanted, Stats& stats, Progress& progress) {
  State& s = *state_;
  const Clock::time_point start = Clock::now();
  Meanwhile& m = s.meanwhile;
  rows_of(steps, wanted, tile_side, m.rows);
  m.runs.update(
      steps, [&s](Handle h) { return s.upload_key(h); }, [this](Handle made, std::uint64_t key) { return holds(made, key); },
      m.rows);
  const std::vector<std::uint64_t>& keys = m.runs.keys();
  const std::vector<bool>& run = m.runs.run();
  m.find_groups(steps, run, s.fuse);
  s.place_images(steps);

  s.threads_that_ran = 0;
  stats.steps.resize(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    StepStats& step = stats.steps[i];
    std::string name = std::move(step.name);  // for its memory
    name = name_of(steps[i].what);
    step = {};
    step.name = std::move(name);
    step.reused = !run[i];
  }
  for (const Group& group : m.groups) {
    progress.check();
    s.run_group(group, steps, stats.steps, progress);
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!run[i]) continue;
    each_made<Image>(steps[i].what, [&](const Image& image) {
      if (image.keep) s.images.at(image).key = output_key(keys[i], image);
    });
    each_made<Buffer>(steps[i].what, [&](const Buffer& buffer) { s.buffers.at(buffer).key = output_key(keys[i], buffer); });
  }
  stats.seconds = seconds_since(start);
}

void CpuBackend::download(const Image& image, Rows wanted, std::span<float> rows) {
  const auto held = state_->images.find(image);
  if (held == state_->images.end() || held->second.key == 0) throw std::logic_error("image download: nothing is held");
  take_rows(held->second, wanted, rows, state_->workers);
}

void CpuBackend::download(const Buffer& buffer, std::span<std::byte> bytes) {
  const auto held = state_->buffers.find(buffer);
  if (held == state_->buffers.end() || held->second.key == 0) throw std::logic_error("buffer download: nothing is held");
  std::copy_n(held->second.bytes.begin(), std::min(held->second.bytes.size(), bytes.size()), bytes.begin());
}

std::uint64_t CpuBackend::bytes_for(std::span<const Step> steps, Rows wanted) const {
  Meanwhile m;
  rows_of(steps, wanted, tile_side, m.rows);
  m.find_groups(steps, std::vector<bool>(steps.size(), true), state_->fuse);
  m.find_held(steps);
  std::uint64_t bytes = 0;
  for (const HeldPart& part : m.held) {
    const Image& image = part.image;
    bytes += static_cast<std::uint64_t>(Tiling{image.extent, part.rows}.count()) * tile_pixels * sizeof(float) *
             static_cast<std::uint64_t>(image.layers * channels(image.format));
  }
  for (const Step& step : steps) {
    for (const Buffer& made : buffers_made_by(step.what)) bytes += made.bytes;
  }
  // A tile of each image that is not held, for each worker.
  std::size_t scratch = 0;
  for (const Group& group : m.groups) {
    std::map<std::uint32_t, std::size_t> floats;
    for (const std::size_t i : group.steps) {
      each_made<Image>(steps[i].what, [&](const Image& image) {
        floats[image.id] = static_cast<std::size_t>(image.layers * channels(image.format)) * tile_pixels;
      });
    }
    for (const HeldPart& part : m.held) floats.erase(part.image.id);
    std::size_t sum = 0;
    for (const auto& [id, of_image] : floats) sum += of_image;
    scratch = std::max(scratch, sum);
  }
  return bytes + scratch * sizeof(float) * static_cast<std::size_t>(state_->workers.threads());
}

std::uint64_t CpuBackend::held_bytes() const { return state_->held_bytes(); }

Simd CpuBackend::simd_that_ran() const { return target_that_runs(state_->simd); }
int CpuBackend::threads_that_ran() const { return state_->threads_that_ran; }

}  // namespace airlight
