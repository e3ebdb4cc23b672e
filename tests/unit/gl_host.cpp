// Pictures that stay on the device: a renderer in a context of its host's, textures that another context of the share group
// reads.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "app/airlight.h"
#include "gpu/functions.h"
#include "tests/unit/lamp_in_fog.h"

namespace airlight {
namespace {

Scene fog_before_a_triangle(double extinction) {
  Scene scene = lamp_in_fog(extinction);
  scene.camera.resolution = {101, 67};
  scene.lights.push_back(scene.lights[0]);
  scene.lights[1].position.x = -1;
  return scene;
}

// Two OSMesa contexts that share objects: the renderer's and the reader's, which is current in the thread that makes this.
class GlHosts : public testing::Test {
 protected:
  void SetUp() override {
    void* library = dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) GTEST_SKIP() << "skipped: no libOSMesa.so.8";
    create_ = reinterpret_cast<Create>(dlsym(library, "OSMesaCreateContextAttribs"));
    destroy_ = reinterpret_cast<Destroy>(dlsym(library, "OSMesaDestroyContext"));
    make_current_ = reinterpret_cast<MakeCurrent>(dlsym(library, "OSMesaMakeCurrent"));
    resolve_ = reinterpret_cast<Resolve>(dlsym(library, "OSMesaGetProcAddress"));
    readers_ = create(nullptr);
    renderers_ = create(readers_);
    ASSERT_NE(renderers_, nullptr);
    make_current(readers_, 0);
    entry(read_image_, "glGetTextureImage"), entry(fence_, "glFenceSync"), entry(wait_, "glWaitSync"), entry(flush_, "glFlush");
  }
  void TearDown() override {
    if (readers_ == nullptr) return;
    make_current_(nullptr, nullptr, 0, 0, 0);
    destroy_(renderers_);
    destroy_(readers_);
  }

  RendererOptions options() {
    RendererOptions o{.backend = "gl"};
    o.gl_host = GlHost{[this] { make_current(renderers_, 1); }, [this] { make_current_(nullptr, nullptr, 0, 0, 0); }, resolve_};
    return o;
  }
  static RenderSettings as_textures() {
    RenderSettings s;
    s.textures = true;
    return s;
  }
  static std::shared_ptr<GlTexture> texture(Renderer& renderer, const Scene& scene) {
    return renderer.render(scene, as_textures()).texture("beauty");
  }
  // Copied back, by a renderer that shares nothing.
  std::vector<float> image(const Scene& scene) {
    if (!alone_) alone_.emplace(RendererOptions{.backend = "gl", .gl_context = "osmesa"});
    return alone_->render(scene, {}).image("beauty").values;
  }
  // By the reader's context.
  std::vector<float> content(GlTexture& t) const {
    wait_(static_cast<GLsync>(t.made), 0, GL_TIMEOUT_IGNORED);
    std::vector<float> values(static_cast<std::size_t>(3 * t.extent.width * t.extent.height));
    read_image_(t.name, 0, GL_RGB, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
    if (t.read == nullptr) t.read = fence_(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    flush_();
    return values;
  }

 private:
  using Create = void* (*)(const int*, void*);
  using Destroy = void (*)(void*);
  using MakeCurrent = unsigned char (*)(void*, void*, unsigned, int, int);
  using Resolve = void (*(*)(const char*))();

  void* create(void* share) const {
    // As gpu/osmesa.cpp names them: RGBA, core profile, version 4.5.
    const std::array<int, 9> attributes{0x22, 0x1908, 0x33, 0x34, 0x36, 4, 0x37, 5, 0};
    return create_(attributes.data(), share);
  }
  void make_current(void* context, std::size_t pixels) {
    ASSERT_NE(make_current_(context, pixels_.at(pixels).data(), GL_UNSIGNED_BYTE, 4, 4), 0);
  }
  template <class F>
  void entry(F& f, const char* name) const {
    f = reinterpret_cast<F>(resolve_(name));
    ASSERT_NE(f, nullptr) << name;
  }

  std::optional<Renderer> alone_;
  Create create_ = nullptr;
  Destroy destroy_ = nullptr;
  MakeCurrent make_current_ = nullptr;
  Resolve resolve_ = nullptr;
  void *readers_ = nullptr, *renderers_ = nullptr;
  alignas(16) std::array<std::array<unsigned char, 64>, 2> pixels_{};
  PFNGLGETTEXTUREIMAGEPROC read_image_ = nullptr;
  PFNGLFENCESYNCPROC fence_ = nullptr;
  PFNGLWAITSYNCPROC wait_ = nullptr;
  PFNGLFLUSHPROC flush_ = nullptr;
};

TEST_F(GlHosts, ReadWhatWouldBeCopiedBack) {
  Renderer renderer(options());
  std::printf("%s\n", renderer.describe().c_str());
  const Scene thin = fog_before_a_triangle(0.05), dense = fog_before_a_triangle(0.8);
  ASSERT_NE(image(thin), image(dense));
  for (const Scene& scene : {thin, dense, dense}) {  // the third time it is no more held, and made again
    const auto made = texture(renderer, scene);
    EXPECT_EQ(made->extent, scene.camera.resolution);
    EXPECT_EQ(content(*made), image(scene));
  }
  EXPECT_EQ(renderer.render(dense, {}).image("beauty").values, image(dense)) << "copied back, as ever";
}

TEST_F(GlHosts, KeepATextureAsItIs) {
  Renderer renderer(options());
  std::vector<std::shared_ptr<GlTexture>> held;
  for (int i = 0; i < 4; ++i) held.push_back(texture(renderer, fog_before_a_triangle(0.1 * (i + 1))));
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(content(*held[static_cast<std::size_t>(i)]), image(fog_before_a_triangle(0.1 * (i + 1)))) << i;
}

TEST_F(GlHosts, TwoTexturesTakeTurns) {
  Renderer renderer(options());
  std::set<unsigned> names;
  std::shared_ptr<GlTexture> shown;
  for (int i = 0; i < 10; ++i) {
    shown = texture(renderer, fog_before_a_triangle(0.1 * (i + 1)));  // the one before lives until this is there
    EXPECT_EQ(content(*shown), image(fog_before_a_triangle(0.1 * (i + 1)))) << i;
    names.insert(shown->name);
  }
  std::printf("10 pictures in %zu textures\n", names.size());
  EXPECT_EQ(names.size(), 2U);
}

TEST_F(GlHosts, ReadInAnotherThread) {
  const Scene scenes[] = {fog_before_a_triangle(0.05), fog_before_a_triangle(0.8)};
  const std::vector<float> expected[] = {image(scenes[0]), image(scenes[1])};
  constexpr int pictures = 40;
  std::mutex mutex;
  std::condition_variable ready;
  std::deque<std::shared_ptr<GlTexture>> made;
  std::string failure;
  bool ends = false;
  std::thread thread([&] {
    Renderer renderer(options());
    try {
      for (int i = 0; i < pictures; ++i) {
        std::shared_ptr<GlTexture> t = texture(renderer, scenes[i % 2]);
        std::unique_lock lock(mutex);
        made.push_back(std::move(t));
        ready.notify_all();
        ready.wait(lock, [&] { return made.size() < 2; });  // so that one is made while one is read
      }
    } catch (const std::exception& e) {
      const std::lock_guard lock(mutex);
      failure = e.what();
      made.push_back(nullptr);
      ready.notify_all();
    }
    std::unique_lock lock(mutex);
    ready.wait(lock, [&] { return ends; });  // textures live as long as their renderer
  });
  int wrong = 0;
  for (int i = 0; i < pictures; ++i) {
    std::shared_ptr<GlTexture> t;
    {
      std::unique_lock lock(mutex);
      ready.wait(lock, [&] { return !made.empty(); });
      t = std::move(made.front());
      made.pop_front();
      ready.notify_all();
    }
    if (!t) break;
    wrong += content(*t) != expected[i % 2];
  }
  {
    const std::lock_guard lock(mutex);
    ends = true;
    made.clear();
    ready.notify_all();
  }
  thread.join();
  EXPECT_EQ(failure, "");
  EXPECT_EQ(wrong, 0);
}

TEST_F(GlHosts, MayLetGoOfATextureAfterItsRenderer) {
  std::shared_ptr<GlTexture> late;
  {
    Renderer renderer(options());
    late = texture(renderer, fog_before_a_triangle(0.1));
  }
  late.reset();
}

TEST_F(GlHosts, WhatCannotBeATextureIsRefused) {
  const Scene scene = fog_before_a_triangle(0.1);
  Renderer cpu, alone({.backend = "gl", .gl_context = "osmesa"}), renderer(options());
  EXPECT_THROW(cpu.render(scene, as_textures()), InputError);
  EXPECT_THROW(alone.render(scene, as_textures()), InputError);
  RenderSettings s = as_textures();
  s.supersample = 2;
  EXPECT_THROW(renderer.render(scene, s), InputError);
  s = as_textures();
  s.rows = {8, 16};
  EXPECT_THROW(renderer.render(scene, s), InputError);
  s = as_textures();
  s.images = {"airlight.0"};
  EXPECT_THROW(renderer.render(scene, s), InputError);
  RendererOptions none = options();
  none.gl_host->make_current = [] { throw MachineError("the host has no context"); };
  EXPECT_THROW(Renderer{none}, MachineError);
  EXPECT_EQ(content(*texture(renderer, scene)), image(scene)) << "usable after all that";
}

}  // namespace
}  // namespace airlight
