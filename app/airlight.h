// The public interface of airlight: load or build a scene, render a frame, get its images.
//
//   airlight::Renderer renderer({.backend = "cpu"});
//   airlight::Frame frame = renderer.render(airlight::load_scene("fog.json"), {});
//   airlight::write_image("fog.exr", frame.image("beauty"), {});
//
//   airlight::SceneFile file("lamp_in_fog.json");  // an animation
//   frame = renderer.render(file.scene(12, progress), {});
//
// Nothing here prints, exits or keeps global state: renderers in different threads are independent. Errors are thrown
// (common/error.h) and leave every object usable. The caller's floating-point mode and GL context are restored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/gl_host.h"
#include "common/image.h"
#include "common/progress.h"
#include "common/rows.h"
#include "common/scene/image_file.h"
#include "common/scene/load.h"
#include "common/scene/scene.h"
#include "common/stats.h"
#include "common/techniques/goal.h"

namespace airlight {

struct RendererOptions {
  std::string backend = "cpu";      // cpu | gl
  std::string simd = "auto";        // auto | scalar | avx2 | avx512 | neon; cpu only
  int threads = 0;                  // 0: as many as the machine has
  std::string gl_context = "auto";  // auto | osmesa | egl; gl only. auto: EGL on hardware where there is some, else OSMesa
  int gl_device = 0;                // which EGL device
  // gl: in place of gl_context and gl_device. Its contexts draw what the renderer makes: RenderSettings::textures.
  std::optional<GlHost> gl_host = {};
  // Files that keep what surfaces hide of an environment are read, and written where they can be: DIGITS.transfer in
  // $XDG_CACHE_HOME/airlight, ~/.cache/airlight unless that is set.
  bool transfer_files = false;
  // [byte] that images may take that nobody asked for. While the camera stands still those of all steps are kept, so that an edit
  // runs what depends on it alone; 0: none.
  std::size_t keep = std::size_t{256} << 20U;
};

struct RenderSettings {
  std::string technique = "auto";                          // auto: what the scene names, else the first that supports it
  std::vector<std::pair<std::string, std::string>> knobs;  // name, value; win over the scene's
  Goal goal;                                               // chooses technique and knobs; then no knobs may be given
  std::optional<Extent> resolution;                        // instead of the camera's
  int supersample = 1;                                     // 1..16: n x n samples a pixel, averaged
  // Of the image, which are made alone; those that it has not are left out. They have the bits that they have in the whole image.
  Rows rows = {};
  std::vector<std::string> images{"beauty"};  // what to make: see image_names() in common/techniques/technique.h
  // Images are not copied back but handed over as Frame::textures, by a renderer with a gl_host: of whole frames, of one sample a
  // pixel, none of one light among several.
  bool textures = false;
};

struct Frame {
  std::vector<NamedImage> images;      // in the order asked for; as high as there are rows
  std::vector<NamedTexture> textures;  // in their place, where asked for; in any order
  Stats stats;
  std::string technique;                                   // what ran
  std::vector<std::pair<std::string, std::string>> knobs;  // every knob with its value
  std::string device;                                      // Backend::describe(), or the reference's line
  const HostImage& image(std::string_view name) const;     // throws std::out_of_range
  const std::shared_ptr<GlTexture>& texture(std::string_view name) const;
};

class Renderer {
 public:
  // Throws InputError for an unknown name, MachineError where the machine lacks what was asked for. Never falls back.
  explicit Renderer(const RendererOptions& = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  // A second frame re-runs only the steps whose inputs changed.
  Frame render(const Scene&, const RenderSettings&, Progress&);
  Frame render(const Scene&, const RenderSettings&);

  // Bands of settings.rows, from the top, the highest of which render() takes at most about so many bytes each: in images and the
  // volumes that steps make, the frame's images among them, and in what the backend holds of the scene: meshes, shadow planes,
  // grids, tables and lists. The scene itself is not counted. Of 64 rows at least: where these take more it throws MachineError
  // if `strictly`, and they are what is given else. Nothing is uploaded.
  std::vector<Rows> bands_within(const Scene&, const RenderSettings&, std::uint64_t bytes, bool strictly) const;

  // What render() would run now, what it has kept from the frames before and what it leaves out, and why; many lines, ends with a
  // newline.
  std::string explain(const Scene&, const RenderSettings&) const;

  std::string describe() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// "0.1.0"
std::string_view version();

// Settings whose goal is replaced by the technique and knobs that are expected to meet it (common/techniques/choose.h), and what
// is expected, one line; empty without a goal. Throws InputError where nothing is expected to. Renderer::render() does the same.
std::pair<RenderSettings, std::string> chosen_for_goal(const Scene&, const RenderSettings&, const RendererOptions&);

// Technique and knobs of the frame that would be rendered; no images, no device. Throws InputError as rendering would.
Frame planned_frame(const Scene&, const RenderSettings&);

// What would run where nothing is kept, what is left out and why; many lines, ends with a newline.
std::string explain(const Scene&, const RenderSettings&);

// What a frame ran, as a tree like that of explain(), with measured times, items and bytes; many lines, ends with a newline.
std::string stats_text(const Frame&);

}  // namespace airlight
