#include "gpu/backend.h"

#include <chrono>
#include <stdexcept>

#include "common/plan/keys.h"
#include "common/plan/rows.h"
#include "gpu/step_runner.h"

namespace airlight {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int granule = 16;  // rows of the squares that Gaussians and shadow planes are told for

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class GlBackend final : public Backend {
 public:
  explicit GlBackend(const GlOptions& options) : context_(make_context(options)) {
    const GlContext::Current current(*context_);
    runner_ = std::make_unique<StepRunner>(*context_);
    taken_ = std::make_unique<TakenTextures>(context_->gl());
    context_->gl().PixelStorei(GL_PACK_ALIGNMENT, 4);
    context_->gl().PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  }
  ~GlBackend() override {
    const GlContext::Current current(*context_);
    runner_.reset();
    taken_.reset();
  }

  std::string describe() const override { return "gl, " + context_->describe(); }

  void upload(Buffer buffer, std::span<const std::byte> bytes, std::uint64_t key) override {
    const GlContext::Current current(*context_);
    runner_->images.erase(buffer);  // another plan may have had an image under this handle
    HeldStorage& held = runner_->buffers[buffer];
    held.key = 0;
    if (!held.buffer) held.buffer = std::make_unique<GlBuffer>(context_->gl());
    held.buffer->fill(bytes.size(), bytes.data());
    check_gl(context_->gl(), "buffer upload");
    held.key = key;
  }

  bool holds(Handle h, std::uint64_t key) const override {
    const auto image = runner_->images.find(h);
    const auto buffer = runner_->buffers.find(h);
    return (image != runner_->images.end() && image->second.key == key) ||
           (buffer != runner_->buffers.end() && buffer->second.key == key);
  }

  void upload(const Image& image, std::span<const float> values, std::uint64_t key) override {
    const GlContext::Current current(*context_);
    HeldTexture& held = prepare(image, Rows{});
    write_texture(context_->gl(), *held.texture, image, values);
    held.key = key;
  }

  void download(const Image& image, Rows wanted, std::span<float> values) override {
    const GlContext::Current current(*context_);
    const auto held = runner_->images.find(image);
    if (held == runner_->images.end() || held->second.key == 0) throw std::logic_error("image download: nothing is held");
    const Rows rows = within(wanted, image.extent.height), there = within(held->second.rows, image.extent.height);
    if (rows.first < there.first || rows.end > there.end) throw std::logic_error("image download: rows that are not held");
    read_texture(context_->gl(), *held->second.texture, image, {rows.first - there.first, rows.end - there.first}, values);
  }

  void download(const Buffer& buffer, std::span<std::byte> bytes) override {
    const GlContext::Current current(*context_);
    const auto held = runner_->buffers.find(buffer);
    if (held == runner_->buffers.end() || held->second.key == 0) throw std::logic_error("buffer download: nothing is held");
    const std::vector<std::byte> content = runner_->content(buffer);
    std::copy_n(content.begin(), std::min(content.size(), bytes.size()), bytes.begin());
  }

  std::shared_ptr<GlTexture> take(const Image& image) override {
    const GlContext::Current current(*context_);
    const auto held = runner_->images.find(image);
    if (held == runner_->images.end() || held->second.key == 0) throw std::logic_error("a texture: nothing is held");
    if (!(held->second.texture->shape() == shape_of(image, Rows{}))) throw std::logic_error("a texture: not all rows are held");
    std::shared_ptr<GlTexture> taken = taken_->take(std::move(held->second.texture));
    runner_->images.erase(held);
    return taken;
  }

  void run(std::span<const Step>, Rows wanted, Stats&, Progress&) override;

  // As if no texture were used twice.
  std::uint64_t bytes_for(std::span<const Step> steps, Rows wanted) const override {
    const std::vector<StepRows> rows = rows_of(steps, wanted, granule);
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      for (const Image& image : outputs_of(steps[i].what)) bytes += bytes_of(shape_of(image, rows[i].held));
      for (const Buffer& made : buffers_made_by(steps[i].what)) bytes += made.bytes;
    }
    return bytes;
  }

  std::uint64_t held_bytes() const override {
    std::uint64_t bytes = runner_->pool().bytes() + taken_->bytes();
    for (const auto& [handle, held] : runner_->images) bytes += held.texture ? bytes_of(held.texture->shape()) : 0;
    for (const auto& [handle, held] : runner_->buffers) bytes += held.buffer ? held.buffer->bytes() : 0;
    return bytes;
  }

 private:
  std::uint64_t upload_key(Handle) const;
  HeldTexture& prepare(const Image&, Rows);
  HeldStorage& prepare(const Buffer&);
  void refuse_large(const Algorithm&) const;
  void release_transients();

  std::unique_ptr<GlContext> context_;
  std::unique_ptr<StepRunner> runner_;
  std::unique_ptr<TakenTextures> taken_;
};

std::uint64_t GlBackend::upload_key(Handle h) const {
  std::uint64_t key = 0;
  if (const auto b = runner_->buffers.find(h); b != runner_->buffers.end()) key = b->second.key;
  if (const auto i = runner_->images.find(h); key == 0 && i != runner_->images.end()) key = i->second.key;
  if (key == 0) throw std::logic_error("a step reads what was neither made nor uploaded");
  return key;
}

// A texture for these rows of the image; what it held is gone.
HeldTexture& GlBackend::prepare(const Image& image, Rows rows) {
  runner_->buffers.erase(image);
  HeldTexture& held = runner_->images[image];
  held.key = 0;
  held.image = image;
  held.rows = rows;
  held.transient = false;
  const TextureShape shape = shape_of(image, rows);
  if (!held.texture || !(held.texture->shape() == shape)) {
    runner_->pool().give(std::move(held.texture));
    held.texture = runner_->pool().take(shape);
  }
  return held;
}

// A buffer of that size; what it held is gone.
HeldStorage& GlBackend::prepare(const Buffer& buffer) {
  runner_->images.erase(buffer);
  HeldStorage& held = runner_->buffers[buffer];
  held.key = 0;
  if (!held.buffer) held.buffer = std::make_unique<GlBuffer>(context_->gl());
  held.buffer->fill(buffer.bytes, nullptr);
  return held;
}

// Throws MachineError where a storage buffer cannot be as large as one that the step makes.
void GlBackend::refuse_large(const Algorithm& step) const {
  const std::size_t most = runner_->storage_limit();
  for (const Buffer& made : buffers_made_by(step)) {
    if (made.bytes <= most) continue;
    throw MachineError(std::string(name_of(step)) + ": takes a buffer of " + std::to_string(made.bytes >> 20U) +
                       " MiB, this OpenGL holds at most " + std::to_string(most >> 20U));
  }
}

void GlBackend::release_transients() {
  for (auto held = runner_->images.begin(); held != runner_->images.end();) {
    if (held->second.transient) {
      runner_->pool().give(std::move(held->second.texture));
      held = runner_->images.erase(held);
    } else {
      ++held;
    }
  }
}

void GlBackend::run(std::span<const Step> steps, Rows wanted, Stats& stats, Progress& progress) {
  const GlContext::Current current(*context_);
  const Clock::time_point start = Clock::now();
  for (std::unique_ptr<Texture>& texture : taken_->come_back()) runner_->pool().give(std::move(texture));
  const std::vector<StepRows> rows = rows_of(steps, wanted, granule);
  const std::vector<std::uint64_t> keys = step_keys(
      steps, [&](Handle h) { return upload_key(h); }, rows);
  const std::vector<bool> runs = steps_to_run(steps, keys, [&](Handle made, std::uint64_t key) { return holds(made, key); });

  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (runs[i]) refuse_large(steps[i].what);
  }

  // After which step a transient image is read no more.
  std::map<Handle, std::size_t> last_use;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!runs[i]) continue;
    for (const Image& image : outputs_of(steps[i].what)) last_use[image] = i;
    for (const Handle input : inputs_of(steps[i].what)) last_use[input] = i;
  }

  struct Release {  // also when a step throws
    GlBackend& backend;
    ~Release() { backend.release_transients(); }
  } const release{*this};

  runner_->begin_run(steps, rows);
  stats.steps.clear();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    StepStats step;
    step.name = name_of(steps[i].what);
    step.reused = !runs[i];
    if (runs[i]) {
      progress.check();
      const Clock::time_point step_start = Clock::now();
      const std::vector<Image> outputs = outputs_of(steps[i].what);
      const std::vector<Buffer> made = buffers_made_by(steps[i].what);
      for (const Image& image : outputs) prepare(image, rows[i].held).transient = !image.keep;
      runner_->begin_step(rows[i].computed);
      for (const Buffer& buffer : made) prepare(buffer);
      std::visit([&](const auto& a) { airlight::run(a, *runner_, progress); }, steps[i].what);
      context_->gl().Finish();  // what the step costs, and that a stop is seen soon
      check_gl(context_->gl(), step.name.c_str());
      for (const Image& image : outputs) {
        if (image.keep) runner_->images.at(image).key = output_key(keys[i], image);
      }
      for (const Buffer& buffer : made) {
        runner_->buffers.at(buffer).key = output_key(keys[i], buffer);
        step.items += buffer.bytes / sizeof(float);
      }
      if (const auto* a = std::get_if<NetworkIteration>(&steps[i].what)) {
        const std::vector<std::byte> content = runner_->content(a->residuals);
        a->tell({reinterpret_cast<const float*>(content.data()), content.size() / sizeof(float)}, step);
      }
      for (const auto& [handle, last] : last_use) {
        const auto held = runner_->images.find(handle);
        if (last != i || held == runner_->images.end() || !held->second.transient) continue;
        runner_->pool().give(std::move(held->second.texture));
        runner_->images.erase(held);
      }
      if (!outputs.empty()) {
        const Extent extent = outputs[0].extent;
        step.items = static_cast<std::uint64_t>(extent.width) * static_cast<std::uint64_t>(rows[i].computed.count());
      }
      step.held = held_bytes();
      step.seconds = seconds_since(step_start);
    }
    stats.steps.push_back(step);
  }
  runner_->pool().trim();
  stats.seconds = seconds_since(start);
}

}  // namespace

std::unique_ptr<Backend> make_gl_backend(const GlOptions& options) { return std::make_unique<GlBackend>(options); }

}  // namespace airlight
