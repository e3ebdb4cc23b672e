// One renderer goes through random edits: each frame has the bits of a cold one, and exactly the steps ran whose inputs have
// changed, by their contents (dependence.h). A share of it runs each time, all of it in ./dev soak.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <tuple>

#include "common/backend.h"
#include "common/plan/frame_ids.h"
#include "common/plan/light_slots.h"
#include "common/techniques/technique.h"
#include "common/transfer/transfer_maker.h"
#include "cpu/backend.h"
#include "gpu/backend.h"
#include "tests/unit/dependence.h"
#include "tests/unit/edits.h"

namespace airlight {
namespace {

constexpr int threads = 2;

// What does not depend on an edit.
bool needless(std::string_view edit, std::string_view step, bool isotropic) {
  const auto among = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), step) != names.end();
  };
  const bool of_medium = among({"density_injection", "optical_depth_propagation", "visibility_network"});
  if (edit == "nothing") return true;
  if (edit == "camera moves" || edit == "camera turns" || edit == "camera zooms")
    return of_medium || among({"particle_light", "network_iteration"}) || (isotropic && step == "source_function");
  if (edit == "light dims" || edit == "light goes out") return of_medium;
  if (edit == "material" || edit == "background") return of_medium;
  if (edit == "light moves") return among({"density_injection", "visibility_network"});
  return false;
}

class Replay {
 public:
  explicit Replay(const std::string& backend)
      : options_{.backend = backend, .threads = threads, .gl_context = "osmesa"},
        warm_(options_),
        transfer_(std::make_shared<TransferMaker>(threads, false)) {
    if (backend == "cpu") {
      cold_ = std::make_unique<CpuBackend>(CpuOptions{.threads = threads});
    } else {
      cold_ = make_gl_backend({.context = "osmesa"});
    }
  }

  // So many edits, from this seed. Returns how many frames there were.
  int run(std::string_view technique, std::uint32_t seed, int count) {
    Edits edits(seed, technique);
    Work work = small_work(technique);
    int frames = 0;
    const auto one = [&](int number, std::string_view edit) {
      const testing::ScopedTrace trace(__FILE__, __LINE__,
                                       std::string(technique) + ", seed " + std::to_string(seed) + ", edit " +
                                           std::to_string(number) + ": " + std::string(edit));
      return render(work, edit);
    };
    EXPECT_TRUE(one(0, "all"));
    for (int i = 1; i <= count && !testing::Test::HasFailure(); ++i) {
      const Work before = work;
      const std::string_view edit = edits.next(work);
      if (one(i, edit)) {
        ++frames;
      } else {
        work = before;
        edits.refused();
      }
    }
    return frames;
  }

  std::size_t ran = 0, kept = 0;  // steps

 private:
  // Whether the plan was not refused.
  bool render(const Work& work, std::string_view edit) {
    const Technique& t = technique(work.settings.technique);
    FrameRequest request;
    request.extent = *work.settings.resolution;
    request.images.insert(work.settings.images.begin(), work.settings.images.end());
    request.knobs = KnobValues(t.knobs, work.settings.knobs);
    request.transfer = transfer_;
    const LightSlots slots = slots_.after(work.scene.lights);
    request.light_slots = slots.numbers();
    Plan plan;
    try {
      if (t.refuses(work.scene)) throw InputError("");
      plan = t.plan(work.scene, request);
    } catch (const InputError&) {
      EXPECT_THROW(warm_.render(work.scene, work.settings), InputError);
      return false;
    }
    slots_ = slots;
    const Uploaded uploaded = make(plan);
    // The renderer keeps everything while the camera stands still.
    const Seen seen{work.settings.technique, work.scene.camera.position, work.scene.camera.look_at,
                    work.scene.camera.vertical_fov, request.extent};
    const std::vector<bool> expected = contents_.run(plan, uploaded, seen == seen_);
    seen_ = seen;
    const Frame frame = warm_.render(work.scene, work.settings);
    // Before the plan's steps stands what was made of surfaces for an environment.
    const std::size_t first = frame.stats.steps.size() - plan.steps.size();
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const StepStats& step = frame.stats.steps[first + i];
      EXPECT_EQ(!step.reused, expected[i]) << "whether step " << i << ", " << step.name << ", runs";
      EXPECT_FALSE(!step.reused && needless(edit, step.name, work.scene.medium.phase.kind == PhaseKind::isotropic)) << step.name;
      ++(step.reused ? kept : ran);
    }
    if (edit == "light moves") {
      EXPECT_LE(std::count_if(frame.stats.steps.begin(), frame.stats.steps.end(),
                              [](const StepStats& s) { return s.name == "optical_depth_propagation" && !s.reused; }),
                1);
    }
    render_cold(plan, uploaded);
    for (const std::string& name : work.settings.images) EXPECT_EQ(frame.image(name).values, cold(plan, name, request)) << name;
    return true;
  }

  // The bytes of all uploads; of tables that take long to make only now and then if the key is known.
  Uploaded make(const Plan& plan) {
    Uploaded all;
    for (const Plan::Upload& upload : plan.uploads) {
      const std::uint32_t id = upload.buffer.id;
      std::vector<std::byte>& known = known_[{id, upload.key}];
      const bool slow = id >= indirect_tables_id && id < first_image_id;
      if (!slow || known.empty() || ++asked_ % 16 == 0) {
        const std::vector<std::byte> made = upload.make();
        EXPECT_TRUE(known.empty() || known == made) << "the key of upload " << id << " names another content";
        known = made;
      }
      all[upload.buffer] = known;
    }
    return all;
  }

  // A backend that holds nothing, but has its programs compiled.
  void render_cold(const Plan& plan, const Uploaded& uploaded) {
    for (const Handle h : touched_) cold_->upload(Buffer{h, 0}, {}, 1);
    touched_.clear();
    for (const Plan::Upload& upload : plan.uploads) {
      touched_.insert(upload.buffer);
      cold_->upload(upload.buffer, uploaded.at(upload.buffer), upload.key);
    }
    for (const Step& step : plan.steps) {
      for (const Image& image : outputs_of(step.what)) touched_.insert(image);
      for (const Buffer& buffer : buffers_made_by(step.what)) touched_.insert(buffer);
    }
    Stats stats;
    NoProgress progress;
    cold_->run(plan.steps, stats, progress);
  }

  std::vector<float> cold(const Plan& plan, const std::string& name, const FrameRequest& request) {
    const auto output =
        std::find_if(plan.outputs.begin(), plan.outputs.end(), [&](const Plan::Output& o) { return o.name == name; });
    if (output == plan.outputs.end()) return HostImage(request.extent, image_channels(name)).values;  // black
    std::vector<float> all(output->image.floats());
    cold_->download(output->image, all);
    const auto layer = static_cast<std::ptrdiff_t>(all.size()) / output->image.layers;
    return {all.begin() + layer * output->layer, all.begin() + layer * (output->layer + 1)};
  }

  using Seen = std::tuple<std::string, glm::dvec3, glm::dvec3, double, Extent>;

  RendererOptions options_;
  Seen seen_;
  LightSlots slots_;
  Renderer warm_;
  std::shared_ptr<TransferMaker> transfer_;
  std::unique_ptr<Backend> cold_;
  std::set<Handle> touched_;  // of the cold backend
  Contents contents_;
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::vector<std::byte>> known_;  // by handle and key
  unsigned asked_ = 0;
};

std::vector<std::string> rendering_techniques() {
  std::vector<std::string> names;
  for (const Technique& t : techniques())
    if (t.plan) names.emplace_back(t.name);
  return names;
}

class RandomEdits : public testing::TestWithParam<std::string> {};

// One renderer, one technique after the other.
TEST_P(RandomEdits, HaveTheBitsOfAColdFrame) {
  Replay replay(GetParam());
  const int count = GetParam() == "cpu" ? 30 : 8;
  for (const std::string& name : rendering_techniques())
    std::printf("%s: %d of %d edits accepted\n", name.c_str(), replay.run(name, 1, count), count);
  std::printf("steps: %zu run, %zu kept\n", replay.ran, replay.kept);
}

INSTANTIATE_TEST_SUITE_P(Backends, RandomEdits, testing::Values("cpu", "gl"), [](const auto& test) { return test.param; });

// Of a thousand edits, each of which begins with a scene of its own: what can be done in a few minutes on OSMesa.
constexpr int pieces = 10;

class ThousandEdits : public testing::TestWithParam<std::tuple<std::string, std::string, int>> {};

// For ./dev soak. The seed is that of gtest.
TEST_P(ThousandEdits, DISABLED_HaveTheBitsOfAColdFrame) {
  const auto& [backend, name, piece] = GetParam();
  Replay replay(backend);
  const int seed = testing::UnitTest::GetInstance()->random_seed();
  const int frames = replay.run(name, static_cast<std::uint32_t>(seed * pieces + piece), 1000 / pieces);
  std::printf("seed %d, %s on %s, piece %d: %d edits accepted; steps: %zu run, %zu kept\n", seed, name.c_str(), backend.c_str(),
              piece, frames, replay.ran, replay.kept);
}

INSTANTIATE_TEST_SUITE_P(All, ThousandEdits,
                         testing::Combine(testing::Values("cpu", "gl"), testing::ValuesIn(rendering_techniques()),
                                          testing::Range(0, pieces)),
                         [](const auto& test) {
                           std::string name = std::get<0>(test.param) + "_" + std::get<1>(test.param) + "_" +
                                              std::to_string(std::get<2>(test.param));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace airlight
