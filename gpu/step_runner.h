// What the GL side of an algorithm works with: programs, textures, buffers, and the loop over the pixels. One run() an algorithm,
// in the file of its name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/algorithms/algorithm.h"
#include "common/plan/rows.h"
#include "common/progress.h"
#include "gpu/context.h"
#include "gpu/held.h"
#include "gpu/shader.h"

namespace airlight {

// Where the blocks and buffers stand that gpu/screen.glsl and gpu/dialect.glsl declare.
constexpr GLuint view_binding = 0, lights_binding = 1, knobs_binding = 2;  // uniform blocks
constexpr GLuint tables_binding = 7, many_lights_binding = 6;              // storage buffers

struct HeldTexture {
  Image image;
  Rows rows;  // that it holds: its first row of pixels is rows.first of the image
  std::unique_ptr<Texture> texture;
  std::uint64_t key = 0;   // of its content; 0: none
  bool transient = false;  // goes back to the pool after its last reader
};

struct HeldStorage {
  std::unique_ptr<GlBuffer> buffer;
  std::uint64_t key = 0;
};

class StepRunner {
 public:
  explicit StepRunner(GlContext&);
  ~StepRunner();

  const GlFunctions& gl() const { return gl_; }
  TexturePool& pool() { return pool_; }

  // Compiled once and kept. `defines` end with the empty string or nothing: both are passed over.
  Program& compute(const char* file, const std::vector<std::string>& defines);
  Program& raster(const char* file);  // with VERTEX and FRAGMENT defined

  void read(GLuint unit, const Image&);                      // as a texture
  void write(GLuint unit, const Image&);                     // as an image; absent: nothing
  void read_write(GLuint unit, const Image&);                // the same, to read back what was written
  void storage(GLuint binding, const Buffer&);               // as a storage buffer
  void storage(GLuint binding, std::span<const std::byte>);  // values made for this step: fills buffer number `binding`, binds it
  GLuint buffer_name(const Buffer&) const;
  std::vector<std::byte> content(const Buffer&) const;  // back on the host, for what is set up there
  // Buffers of steps, by number: filled; made at least that large, with undefined content; bound; read back.
  void fill(GLuint number, std::span<const std::byte>);
  void reserve(GLuint number, std::size_t bytes);
  void bind(GLuint binding, GLuint number);
  void read_storage(GLuint number, std::span<std::byte>);
  void write_storage(GLuint number, std::size_t at, std::span<const std::byte>);
  void copy(GLuint from_buffer, GLuint number, std::size_t at, std::size_t bytes);  // the beginning of a buffer to `at`
  void copy_back(GLuint number, GLuint to_buffer, std::size_t bytes);
  std::size_t storage_limit() const;  // [byte] of one storage buffer
  template <class T>
  void block(GLuint binding, const T& values) {  // std140
    block_bytes(binding, std::as_bytes(std::span(&values, 1)));
  }
  // Which rows textures of an extent hold during a run: as steps say, else all.
  void begin_run(std::span<const Step>, std::span<const StepRows>);
  Rows held_rows(Extent) const;
  void begin_step(Rows made) { rows_ = made; }
  Rows rows() const { return rows_; }  // that the step makes
  void view(const View&);
  // Returns the define under which gpu/screen.glsl finds them: few are a uniform block, which is read faster.
  std::string lights(std::span<const Light>);

  // A buffer made on the device from another, again only when that one's content changes.
  GLuint derived(const Buffer& from, std::size_t bytes, const std::function<void(GLuint name)>& make);

  // Runs a compute shader of gpu/screen.glsl for every pixel of the step's rows, a band of rows at a time, looking at progress
  // between them. `part`: of these rows alone, which begin at a multiple of 4.
  void each_pixel(Program&, Extent, const Progress&, Rows part = {});
  void each(Program&, std::size_t items, std::size_t group);  // a compute shader over a list

  std::map<Handle, HeldTexture> images;
  std::map<Handle, HeldStorage> buffers;

 private:
  const Texture& texture(const Image&) const;
  void bind_image(GLuint unit, const Image&, GLenum access);
  void block_bytes(GLuint binding, std::span<const std::byte>);

  const GlFunctions& gl_;
  TexturePool pool_;
  std::map<std::string, std::unique_ptr<Program>> programs_;
  std::map<GLuint, GlBuffer> blocks_, small_;
  std::map<Handle, HeldStorage> derived_;
  Rows rows_;
  std::map<std::pair<int, int>, Rows> held_;  // by extent
};

void run(const SurfaceVisibility&, StepRunner&, const Progress&);
void run(const ShadowPlanes&, StepRunner&, const Progress&);
void run(const ViewTransmittance&, StepRunner&, const Progress&);
void run(const SurfaceAirlight&, StepRunner&, const Progress&);
void run(const MeanDepthLattice&, StepRunner&, const Progress&);
void run(const MeanDepth&, StepRunner&, const Progress&);
void run(const EnvironmentLight&, StepRunner&, const Progress&);
void run(const SurfaceShading&, StepRunner&, const Progress&);
void run(const HomogeneousAirlight&, StepRunner&, const Progress&);
void run(const DensityInjection&, StepRunner&, const Progress&);
void run(const OpticalDepthPropagation&, StepRunner&, const Progress&);
void run(const VisibilityNetwork&, StepRunner&, const Progress&);
void run(const ParticleLight&, StepRunner&, const Progress&);
void run(const NetworkIteration&, StepRunner&, const Progress&);
void run(const SourceFunction&, StepRunner&, const Progress&);
void run(const RayMarch&, StepRunner&, const Progress&);
void run(const ParticleSplats&, StepRunner&, const Progress&);
void run(const GaussianAirlight&, StepRunner&, const Progress&);
void run(const ProjectedGaussians&, StepRunner&, const Progress&);
void run(const LightMarch&, StepRunner&, const Progress&);
void run(const Subsample&, StepRunner&, const Progress&);
void run(const DepthAwareUpsample&, StepRunner&, const Progress&);
void run(const FillAirlight&, StepRunner&, const Progress&);
void run(const EnvironmentAirlight&, StepRunner&, const Progress&);
void run(const HiddenEnvironment&, StepRunner&, const Progress&);
void run(const EnvironmentIndirect&, StepRunner&, const Progress&);
void run(const Compose&, StepRunner&, const Progress&);

}  // namespace airlight
