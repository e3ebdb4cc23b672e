#include "gpu/shadow_runs.h"

#include <algorithm>
#include <glm/vec4.hpp>

#include "common/error.h"

namespace airlight {

namespace {

constexpr int side = 16;           // of a tile: a multiple of the work group's 16 x 4
constexpr int short_list = 16;     // crossings a pixel that the lists begin with
constexpr GLuint run_binding = 4;  // uniform block
constexpr GLuint begin_binding = 0, planes_binding = 1, changes_binding = 2, lists_binding = 3, most_binding = 4;
constexpr GLuint own = 16;  // the first of our buffers' numbers: others keep those of their bindings

struct RunBlock {
  glm::ivec4 corner_size;  // in the textures
  int tile_side, light, covering, capacity, any_plane;
  float sky_distance;
  int unused[2];
};

// The planes of neighbouring tiles of one row, as the shader reads them.
struct RunOfTiles {
  int first = 0, count = 0;  // columns of tiles
  std::vector<std::int32_t> begin{0};
  std::vector<glm::vec4> planes;
  std::vector<std::int32_t> changes;

  std::size_t bytes() const { return planes.size() * sizeof(glm::vec4); }
  void add(const ShadowQuads& quads, std::size_t tile, int x, int y) {
    for (const std::uint32_t i : quads.of_tile(tile)) {
      const ShadowQuad& q = quads.quads[i];
      const ScreenFunction* f[] = {&q.u, &q.v, &q.e, &q.k};
      glm::vec4 corner, across, down;
      for (int c = 0; c < 4; ++c) {
        corner[c] = static_cast<float>(f[c]->c[0] + f[c]->c[1] * x + f[c]->c[2] * y);
        across[c] = static_cast<float>(f[c]->c[1]);
        down[c] = static_cast<float>(f[c]->c[2]);
      }
      planes.insert(planes.end(), {corner, across, down});
      changes.push_back(q.change);
    }
    begin.push_back(static_cast<std::int32_t>(changes.size()));
    ++count;
  }
};

class ShadowRuns {
 public:
  ShadowRuns(Extent extent, float sky_distance, StepRunner& r, Program& program, const Progress& progress,
             const std::function<void(const ShadowRun&)>& draw)
      : extent_(extent),
        sky_distance_(sky_distance),
        r_(r),
        program_(program),
        progress_(progress),
        draw_(draw),
        limit_(r.storage_limit()),
        rows_(r.rows()),
        first_row_(rows_.first / side),
        texture_row_(r.held_rows(extent).first) {}

  void light(int index, const ShadowQuads& quads, std::int64_t covering) {
    const Extent extent = extent_;
    const int columns = (extent.width + side - 1) / side, end_row = (rows_.end + side - 1) / side;
    for (int row = first_row_; row < end_row; ++row) {
      const auto tile = [&](int column) {
        return static_cast<std::size_t>(row - first_row_) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
      };
      for (int column = 0; column < columns;) {
        RunOfTiles run;
        run.first = column;
        do {
          run.add(quads, tile(column), column * side, row * side);
          ++column;
        } while (column < columns && run.bytes() + 3 * sizeof(glm::vec4) * quads.of_tile(tile(column)).size() <= limit_ &&
                 list_bytes(run.count + 1) <= limit_);
        if (run.bytes() > limit_)
          throw MachineError("shadow planes: this OpenGL's storage buffers cannot hold the planes of one tile");
        while (!lists(run, row, index, covering)) {
          // Longer lists for fewer tiles.
          if (list_bytes(run.count) <= limit_) continue;
          const int fit = static_cast<int>(limit_ / list_bytes(1));
          if (fit == 0) throw MachineError("shadow planes: this OpenGL's storage buffers cannot hold the crossings of one tile");
          RunOfTiles part;
          part.first = run.first;
          for (column = run.first; part.count < fit; ++column) part.add(quads, tile(column), column * side, row * side);
          run = std::move(part);
        }
      }
    }
  }

 private:
  std::size_t list_bytes(int tiles) const {
    return static_cast<std::size_t>(tiles) * side * side * (static_cast<std::size_t>(capacity_) + 1) * sizeof(glm::uvec2);
  }

  // False where the lists were too short; they are longer then.
  bool lists(const RunOfTiles& run, int row, int light, std::int64_t covering) {
    progress_.check();
    const Extent extent = extent_;
    const int x = run.first * side, y = row * side;
    const int width = std::min(run.count * side, extent.width - x), height = std::min(side, rows_.end - y);
    const std::int64_t held = std::clamp<std::int64_t>(covering, -(1 << 30), 1 << 30);
    const bool any = !run.changes.empty();
    RunBlock block{
        {x, y - texture_row_, width, height}, side, light, static_cast<int>(held), capacity_, any ? 1 : 0, sky_distance_, {}};
    r_.block(run_binding, block);
    ShadowRun done{light, {width, height}, 1};
    if (any) {
      r_.fill(own + begin_binding, std::as_bytes(std::span(run.begin)));
      r_.fill(own + planes_binding, std::as_bytes(std::span(run.planes)));
      r_.fill(own + changes_binding, std::as_bytes(std::span(run.changes)));
      r_.reserve(own + lists_binding, list_bytes(run.count));
      const std::uint32_t none[2] = {0, 0};
      r_.fill(own + most_binding, std::as_bytes(std::span(none)));
      for (GLuint binding = begin_binding; binding <= most_binding; ++binding) r_.bind(binding, own + binding);
    }
    if (any || !draw_) dispatch_run(r_, program_, done);
    if (any) {
      std::uint32_t most[2] = {0, 0};  // crossings, lit parts
      r_.read_storage(own + most_binding, std::as_writable_bytes(std::span(most)));
      if (most[0] > static_cast<std::uint32_t>(capacity_)) {
        while (static_cast<std::uint32_t>(capacity_) < most[0]) capacity_ *= 2;
        return false;
      }
      done.most_lit = static_cast<int>(most[1]);
    }
    if (draw_) draw_(done);
    return true;
  }

  Extent extent_;
  float sky_distance_;
  StepRunner& r_;
  Program& program_;
  const Progress& progress_;
  const std::function<void(const ShadowRun&)>& draw_;
  std::size_t limit_;
  Rows rows_;
  int first_row_, texture_row_;  // of tiles that are made; of the image, that is row 0 of the textures
  int capacity_ = short_list;
};

}  // namespace

void each_shadow_run(const View& view, std::size_t lights, const Buffer& volumes, float sky_distance, StepRunner& r,
                     Program& lists, const Progress& progress, const std::function<void(const ShadowRun&)>& draw) {
  const std::vector<std::byte> bytes = r.content(volumes);
  const ShadowVolumesView content(bytes, lights);
  const ScreenRays rays(view);
  ShadowRuns runs(view.extent, sky_distance, r, lists, progress, draw);
  ShadowQuads quads;
  for (std::size_t i = 0; i < lights; ++i) {
    quads.make(rays, content.lights[i], content.of(content.lights[i]), side, r.rows());
    runs.light(static_cast<int>(i), quads, content.lights[i].covering);
  }
}

void each_lit_run(const View& view, std::size_t lights, const Buffer& volumes, float sky_distance, StepRunner& r,
                  const Progress& progress, const std::function<void(const ShadowRun&)>& draw) {
  each_shadow_run(view, lights, volumes, sky_distance, r, r.compute("gpu/lit_parts.glsl", {}), progress, draw);
}

void dispatch_run(StepRunner& r, Program& program, const ShadowRun& run) {
  program.use();
  r.gl().DispatchCompute(static_cast<GLuint>((run.extent.width + 15) / 16), static_cast<GLuint>((run.extent.height + 3) / 4), 1);
  r.gl().MemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace airlight
