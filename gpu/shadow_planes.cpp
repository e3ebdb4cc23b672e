#include <algorithm>
#include <glm/vec4.hpp>

#include "common/error.h"
#include "common/plan/shadow_quads.h"
#include "gpu/step_runner.h"

namespace airlight {

namespace {

constexpr int side = 32;           // of a tile: a multiple of the work group's 16 x 4
constexpr int short_list = 16;     // crossings a pixel that the lists begin with
constexpr GLuint run_binding = 3;  // uniform block
constexpr GLuint begin_binding = 0, planes_binding = 1, changes_binding = 2, lists_binding = 3, most_binding = 4;

struct RunBlock {
  glm::ivec4 corner_size;
  int tile_side, light, covering, capacity, any_plane, unused[3];
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

class ShadowRun {
 public:
  ShadowRun(const ShadowPlanes& a, StepRunner& r, Program& program, const Progress& progress)
      : a_(a), r_(r), program_(program), progress_(progress), limit_(r.storage_limit()) {}

  void light(int index, const ShadowQuads& quads, std::int64_t covering) {
    const Extent extent = a_.view.extent;
    const int columns = (extent.width + side - 1) / side, rows = (extent.height + side - 1) / side;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns;) {
        RunOfTiles run;
        run.first = column;
        do {
          run.add(quads, static_cast<std::size_t>(row * columns + column), column * side, row * side);
          ++column;
        } while (column < columns &&
                 run.bytes() + 3 * sizeof(glm::vec4) * quads.of_tile(static_cast<std::size_t>(row * columns + column)).size() <=
                     limit_ &&
                 list_bytes(run.count + 1) <= limit_);
        if (run.bytes() > limit_)
          throw MachineError("shadow planes: this OpenGL's storage buffers cannot hold the planes of one tile");
        while (!draw(run, row, index, covering)) {
          // Longer lists for fewer tiles.
          if (list_bytes(run.count) <= limit_) continue;
          const int fit = static_cast<int>(limit_ / list_bytes(1));
          if (fit == 0) throw MachineError("shadow planes: this OpenGL's storage buffers cannot hold the crossings of one tile");
          RunOfTiles part;
          part.first = run.first;
          for (column = run.first; part.count < fit; ++column)
            part.add(quads, static_cast<std::size_t>(row * columns + column), column * side, row * side);
          run = std::move(part);
        }
      }
    }
  }

 private:
  std::size_t list_bytes(int tiles) const {
    return static_cast<std::size_t>(tiles) * side * side * static_cast<std::size_t>(capacity_) * sizeof(glm::uvec2);
  }

  // False where the lists were too short; they are longer then.
  bool draw(const RunOfTiles& run, int row, int light, std::int64_t covering) {
    progress_.check();
    const Extent extent = a_.view.extent;
    const int x = run.first * side, y = row * side;
    const int width = std::min(run.count * side, extent.width - x), height = std::min(side, extent.height - y);
    const std::int64_t held = std::clamp<std::int64_t>(covering, -(1 << 30), 1 << 30);
    const bool any = !run.changes.empty();
    RunBlock block{{x, y, width, height}, side, light, static_cast<int>(held), capacity_, any ? 1 : 0, {}};
    r_.block(run_binding, block);
    if (any) {
      r_.storage(begin_binding, std::as_bytes(std::span(run.begin)));
      r_.storage(planes_binding, std::as_bytes(std::span(run.planes)));
      r_.storage(changes_binding, std::as_bytes(std::span(run.changes)));
      r_.scratch(lists_binding, list_bytes(run.count));
      const std::uint32_t none = 0;
      r_.storage(most_binding, std::as_bytes(std::span(&none, 1)));
    }
    program_.use();
    r_.gl().DispatchCompute(static_cast<GLuint>((width + 15) / 16), static_cast<GLuint>((height + 3) / 4), 1);
    r_.gl().MemoryBarrier(GL_ALL_BARRIER_BITS);
    if (!any) return true;
    std::uint32_t most = 0;
    r_.read_storage(most_binding, std::as_writable_bytes(std::span(&most, 1)));
    if (most <= static_cast<std::uint32_t>(capacity_)) return true;
    while (static_cast<std::uint32_t>(capacity_) < most) capacity_ *= 2;
    return false;
  }

  const ShadowPlanes& a_;
  StepRunner& r_;
  Program& program_;
  const Progress& progress_;
  std::size_t limit_;
  int capacity_ = short_list;
};

}  // namespace

void run(const ShadowPlanes& a, StepRunner& r, const Progress& progress) {
  const std::string lights = r.lights(a.lights);
  Program& program = r.compute("gpu/shadow_planes.glsl", {lights, a.scattered ? "WITH_SCATTERED" : "",
                                                          a.light_transmittance ? "WITH_LIGHT_TRANSMITTANCE" : "",
                                                          a.order == ShadowOrder::published ? "PUBLISHED_ORDER" : ""});
  r.read(0, a.distance);
  r.write(0, a.scattered);
  r.write(1, a.light_transmittance);
  if (a.tables) r.storage(tables_binding, a.tables);
  r.view(a.view);
  struct {
    float extinction, sky_distance, g;
    int kind;
  } const knobs{a.extinction, a.sky_distance, static_cast<float>(a.phase.g), static_cast<int>(a.phase.kind)};
  r.block(knobs_binding, knobs);
  program.set("first_row", 0);

  const std::vector<std::byte> bytes = r.content(a.volumes);
  const ShadowVolumesView volumes(bytes, a.lights.size());
  const ScreenRays rays(a.view);
  ShadowRun run(a, r, program, progress);
  ShadowQuads quads;
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    quads.make(rays, volumes.lights[i], volumes.of(volumes.lights[i]), side);
    run.light(static_cast<int>(i), quads, volumes.lights[i].covering);
  }
}

}  // namespace airlight
