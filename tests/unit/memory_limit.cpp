// What a plan is expected to hold before anything is made, beside what it holds then; and that a limit is kept.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "app/airlight.h"
#include "common/error.h"
#include "common/plan/upload.h"
#include "common/techniques/technique.h"
#include "common/transfer/transfer_maker.h"
#include "cpu/backend.h"
#include "gpu/backend.h"
#include "tests/parity/inputs.h"
#include "tests/unit/small_work.h"

namespace airlight {
namespace {

// A plane of n x n cells, two triangles each.
std::shared_ptr<const Mesh> plane_of(unsigned n) {
  auto mesh = std::make_shared<Mesh>();
  for (unsigned j = 0; j <= n; ++j) {
    for (unsigned i = 0; i <= n; ++i) {
      mesh->positions.emplace_back(static_cast<float>(i) / static_cast<float>(n) - 0.5F, 0,
                                   static_cast<float>(j) / static_cast<float>(n) - 0.5F);
      mesh->normals.emplace_back(0, 1, 0);
    }
  }
  const auto at = [&](unsigned i, unsigned j) { return i + (n + 1) * j; };
  for (unsigned j = 0; j < n; ++j) {
    for (unsigned i = 0; i < n; ++i) {
      mesh->triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j));
      mesh->triangles.emplace_back(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  }
  return mesh;
}

struct Part {
  std::string name;
  Work work;
};

// Each technique with what it uploads: casters, reflectances, skies and what is hidden of them, lists and grids.
std::vector<Part> parts() {
  std::vector<Part> all;
  for (const Technique& t : techniques()) {
    if (!t.plan) continue;
    Work work = small_work(t.name);
    work.set("indirect", "unbounded");
    work.settings.resolution = Extent{130, 70};
    work.scene.surfaces[1].brdf = small_brdf();
    all.push_back({std::string(t.name), work});
    work.scene.environment = Environment{small_sky(), {0.3, 0.4, 0.5}, 0};
    work.scene.background = {0, 0, 0};
    work.scene.surfaces[0].material.specular = glm::vec3(0.2F);
    work.set("environment_indirect", "on");
    all.push_back({std::string(t.name) + ", sky", work});
    if (t.name == "illumination-network") {
      work.set("image", "splats");
      all.push_back({"splats", work});
    }
    if (t.name == "gaussian-airlight") {
      work.set("light_path", "published"), work.set("shadows", "off");
      all.push_back({"published", work});
    }
    if (t.name == "marching") {
      work.scene.medium.grid = small_grid();
      all.push_back({"grid", work});
    }
  }
  return all;
}

Plan plan_of(const Work& work, std::shared_ptr<TransferSource> transfer) {
  const Technique& t = technique(work.settings.technique);
  FrameRequest request{
      .extent = *work.settings.resolution, .images = {"beauty"}, .knobs = KnobValues(t.knobs, work.settings.knobs)};
  request.transfer = std::move(transfer);
  return t.plan(work.scene, request);
}

// Buffers tell exactly what is uploaded, others at most; with what surfaces hide at hand these are exact, too.
TEST(MemoryLimit, UploadsTellTheirSize) {
  const auto transfer = std::make_shared<TransferMaker>(2, false);
  for (const Part& part : parts()) {
    const Plan exact = plan_of(part.work, transfer), bound = plan_of(part.work, nullptr);
    ASSERT_EQ(exact.uploads.size(), bound.uploads.size());
    std::uint64_t told = 0, made = 0;
    for (std::size_t i = 0; i < exact.uploads.size(); ++i) {
      const Plan::Upload& upload = exact.uploads[i];
      const std::uint64_t bytes = upload.make().size();
      EXPECT_EQ(upload.most ? upload.most() : upload.buffer.bytes, bytes) << part.name << ", upload " << upload.buffer.id;
      EXPECT_GE(bound.uploads[i].most ? bound.uploads[i].most() : bound.uploads[i].buffer.bytes, bytes)
          << part.name << ", upload " << upload.buffer.id;
      if (!upload.most) {
        EXPECT_EQ(upload.buffer.bytes, bytes) << part.name << ", upload " << upload.buffer.id;
      }
      told += bound.uploads[i].most ? bound.uploads[i].most() : bound.uploads[i].buffer.bytes;
      made += bytes;
    }
    EXPECT_EQ(bytes_of_uploads(bound), told);
    std::printf("%s: %llu bytes uploaded, %.3f of them expected\n", part.name.c_str(), static_cast<unsigned long long>(made),
                static_cast<double>(told) / static_cast<double>(made));
  }
}

class MemoryLimitOn : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Backend> backend() const {
    if (GetParam() == "cpu") return std::make_unique<CpuBackend>(CpuOptions{.threads = 1});
    return make_gl_backend({.context = "osmesa"});
  }
};

// The CPU holds what is expected, where nothing else was rendered before; OpenGL less, as textures are used again.
TEST_P(MemoryLimitOn, IsAboutWhatIsHeld) {
  const auto transfer = std::make_shared<TransferMaker>(2, false);
  for (const Part& part : parts()) {
    const Plan plan = plan_of(part.work, transfer);
    const std::unique_ptr<Backend> device = backend();
    for (const Plan::Upload& u : plan.uploads) device->upload(u.buffer, u.make(), u.key);
    const std::uint64_t expected = bytes_of_uploads(plan) + device->bytes_for(plan.steps, {});
    Stats stats;
    NoProgress progress;
    device->run(plan.steps, stats, progress);
    std::uint64_t held = device->held_bytes();
    for (const StepStats& s : stats.steps) held = std::max(held, s.held);
    const double ratio = static_cast<double>(held) / static_cast<double>(expected);
    std::printf("%s: %.2f MiB held, %.3f of what was expected\n", part.name.c_str(), static_cast<double>(held) / (1U << 20U),
                ratio);
    EXPECT_LE(ratio, 1.001) << part.name;
    EXPECT_GT(ratio, GetParam() == "cpu" ? 0.999 : 0.7) << part.name;
  }
}

// A mesh that alone takes more than is allowed, in a picture that takes next to nothing.
TEST_P(MemoryLimitOn, RefusesWhatIsUploadedAlone) {
  const Renderer renderer({.backend = GetParam(), .gl_context = "osmesa"});
  Work work = small_work("shadow-planes");
  work.scene.lights.resize(1);
  work.scene.surfaces[0].mesh = plane_of(300);
  const std::uint64_t vertices = 301 * 301, triangles = 2 * 300 * 300, mesh = vertices * 24 + triangles * 16;
  constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20U;
  ASSERT_GT(mesh, 4 * mebibyte);
  EXPECT_EQ(renderer.bands_within(work.scene, work.settings, mesh + mebibyte, true).size(), 1U);
  try {
    renderer.bands_within(work.scene, work.settings, mesh, true);
    ADD_FAILURE() << "the mesh was not counted";
  } catch (const MachineError& error) {
    std::printf("%s\n", error.what());
    EXPECT_NE(std::string(error.what()).find("the scene's meshes, grids and tables"), std::string::npos) << error.what();
  }
  EXPECT_EQ(renderer.bands_within(work.scene, work.settings, mesh, false).size(), 1U) << "what nobody asked for refuses nothing";

  // A fence of slats, each of which is silhouette all round: its shadow planes take more than it does.
  Work fence = small_work("shadow-planes");
  auto slats = std::make_shared<Mesh>();
  for (unsigned i = 0; i < 20000; ++i) {
    const float x = 1e-4F * static_cast<float>(i) - 1;
    for (const glm::vec3 p : {glm::vec3(x, 0, 0), glm::vec3(x + 5e-5F, 0, 0), glm::vec3(x, 1, 0)}) {
      slats->positions.push_back(p);
      slats->normals.emplace_back(0, 0, 1);
    }
    slats->triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  fence.scene.surfaces[0].mesh = slats;
  const std::uint64_t of_mesh = 60000 * 24 + 20000 * 16, of_planes = 2 * 60000 * sizeof(ShadowEdge);
  EXPECT_EQ(renderer.bands_within(fence.scene, fence.settings, of_mesh + of_planes + mebibyte, true).size(), 1U);
  EXPECT_THROW(renderer.bands_within(fence.scene, fence.settings, of_mesh + of_planes, true), MachineError);
}

INSTANTIATE_TEST_SUITE_P(Backends, MemoryLimitOn, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

}  // namespace
}  // namespace airlight
