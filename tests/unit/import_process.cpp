// Meshes read in a process of their own: what comes back is what is read here, and what does not come back is told in a line.
#include "common/scene/import_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <vector>

#include "common/error.h"

namespace airlight {
namespace {

constexpr std::uint64_t gigabyte = std::uint64_t{1} << 30U;

// Does to its process what the path says.
ImportedFile hostile(const MeshRequest& request, const BeforeReading& before_reading, Progress& progress) {
  const std::string& what = request.path;
  const auto takes = [](std::uint64_t gigabytes) {  // addresses, not memory
    std::vector<std::unique_ptr<char[]>> taken;
    for (std::uint64_t i = 0; i < 16 * gigabytes; ++i) taken.emplace_back(new char[gigabyte / 16]);
    return taken.size();
  };
  if (what == "ends") signal(SIGSEGV, SIG_DFL), raise(SIGSEGV);  // a sanitizer would answer it
  if (what == "aborts") std::abort();
  if (what == "exits") _exit(0);
  if (what == "spins") {
    volatile bool on = true;
    while (on) continue;
  }
  if (what == "waits") pause();
  if (what == "takes") takes(5);
  if (what == "reads and takes") before_reading(gigabyte), takes(5);
  if (what == "refuses") throw InputError(what + ": not a mesh");
  return import_here({AIRLIGHT_SCENES "/ground.obj"}, before_reading, progress);
}

class Stop final : public Progress {
 public:
  void report(std::string_view, double) override {}
  bool stop_requested() const override { return true; }
};

std::string refused(ImportProcess& process, const std::string& what) {
  NoProgress none;
  try {
    process.import({what}, none);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ImportProcess, HandsOverWhatWasRead) {
  ImportProcess process;
  EXPECT_EQ(ImportProcess::running(), &process);
  NoProgress none;
  for (const MeshRequest& request :
       {MeshRequest{AIRLIGHT_SCENES "/pergola.obj"}, MeshRequest{AIRLIGHT_SCENES "/pergola.obj", true},
        MeshRequest{AIRLIGHT_SCENES "/pergola.obj", false, true}}) {
    const ImportedFile here = import_here(request, {}, none), there = process.import(request, none);
    EXPECT_EQ(here.content_hash, there.content_hash);
    ASSERT_EQ(here.meshes.size(), there.meshes.size());
    ASSERT_FALSE(here.meshes.empty());
    for (std::size_t i = 0; i < here.meshes.size(); ++i) {
      const ImportedMesh &a = here.meshes[i], &b = there.meshes[i];
      EXPECT_EQ(a.part, b.part);
      EXPECT_EQ(a.material.diffuse, b.material.diffuse);
      EXPECT_EQ(a.material.specular, b.material.specular);
      EXPECT_EQ(a.material.shininess, b.material.shininess);
      EXPECT_EQ(a.mesh->file, b.mesh->file);
      EXPECT_EQ(a.mesh->positions, b.mesh->positions);
      EXPECT_EQ(a.mesh->normals, b.mesh->normals);
      EXPECT_EQ(a.mesh->triangles, b.mesh->triangles);
    }
  }
}

TEST(ImportProcess, RefusesWhatEndsIt) {
  ImportProcess process({.seconds = 1}, hostile);
  EXPECT_EQ(refused(process, "ends"), "ends: not a readable mesh: reading it ended by signal 11 (Segmentation fault)");
  EXPECT_EQ(refused(process, "aborts"), "aborts: not a readable mesh: reading it ended by signal 6 (Aborted)");
  EXPECT_EQ(refused(process, "spins"), "spins: takes more than 1 s to read, expected less");
  EXPECT_EQ(refused(process, "refuses"), "refuses: not a mesh");
  NoProgress none;
  EXPECT_THROW(process.import({"exits"}, none), MachineError);  // without an answer
  EXPECT_EQ(process.import({"ground"}, none).meshes.size(), 1U);
}

TEST(ImportProcess, BoundsMemoryByWhatIsRead) {
  if (!ImportProcess::bounds_memory) GTEST_SKIP() << "under a sanitizer";
  ImportProcess process({}, hostile);
  EXPECT_EQ(refused(process, "takes"), "takes: takes more than 4096 MiB of memory to read, expected less");
  EXPECT_EQ(refused(process, "reads and takes"), "");
}

TEST(ImportProcess, IsLeftWhenStopped) {
  ImportProcess process({}, hostile);
  Stop stop;
  EXPECT_THROW(process.import({"waits"}, stop), Interrupted);
}

}  // namespace
}  // namespace airlight
