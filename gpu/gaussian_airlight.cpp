#include <algorithm>
#include <bit>
#include <glm/vec4.hpp>

#include "common/error.h"
#include "common/plan/gaussian_panels.h"
#include "gpu/medium.h"
#include "gpu/shadow_runs.h"

namespace airlight {

namespace {

constexpr GLuint squares_binding = 0, panels_binding = 1, shades_binding = 2, indices_binding = 4;  // 3: gpu/shadow_run.glsl
constexpr int most_before = 374;  // 1 + 4 + 9 + ... + 16^2 of GaussLegendre::before, four in a vector
constexpr int all_pieces = GaussianPanels::most_cuts + 2;

// The panels of all squares that have some of the rows, as the shader reads them; and what it may do in one dispatch
// (LoopBudget).
class PanelLists {
 public:
  // most_rounds: of loops in a dispatch, beside those for lit parts.
  PanelLists(const GaussianAirlight& a, Rows rows, std::int64_t most_rounds)
      : a_(a), most_rounds_(most_rounds), first_y_(rows.first / bin_side * bin_side) {
    const Extent extent = a.view.extent;
    std::vector<Square> squares;
    GaussianPanels panels(a);
    for (int y = first_y_; y < rows.end; y += bin_side) {
      for (int x = 0; x < extent.width; x += bin_side) {
        panels.each(x, y, bin_side, [&](int square_x, int square_y, int side) {
          if (square_x >= extent.width || square_y >= extent.height) return;
          squares.push_back({square_x, square_y - first_y_, side, add(panels, square_x % bin_side / side, bin_side / side)});
          side_ = std::min(side_, side);
        });
      }
    }
    // Squares of the smallest side that there is; a larger one stands at all of its places. Parts come behind them.
    columns_ = (extent.width + side_ - 1) / side_;
    const int lines = (rows.end - first_y_ + side_ - 1) / side_, count = columns_ * lines;
    squares_.resize(static_cast<std::size_t>(count));
    for (const Square& s : squares) {
      for (int line = s.y / side_; line < std::min((s.y + s.side) / side_, lines); ++line) {
        glm::ivec4* const row = squares_.data() + static_cast<std::ptrdiff_t>(columns_) * line;
        for (int column = s.x / side_; column < std::min((s.x + s.side) / side_, columns_); ++column)
          row[column] = s.lists + glm::ivec4(count, count, 0, 0);
      }
    }
    squares_.insert(squares_.end(), parts_.begin(), parts_.end());
  }

  void bind(StepRunner& r) {
    // A buffer of no bytes cannot be bound.
    for (std::vector<glm::ivec4>* list : {&panels_, &shades_}) {
      if (list->empty()) list->emplace_back(0);
    }
    if (indices_.empty()) indices_.push_back(0);
    const auto bound = [&](GLuint binding, std::span<const std::byte> bytes) {
      if (bytes.size() > r.storage_limit()) {
        throw MachineError("gaussian airlight: this OpenGL's storage buffers cannot hold the panels of " +
                           std::to_string(a_.gaussians.size()) + " Gaussians at this resolution");
      }
      r.storage(binding, bytes);
    };
    bound(squares_binding, std::as_bytes(std::span(squares_)));
    bound(panels_binding, std::as_bytes(std::span(panels_)));
    bound(shades_binding, std::as_bytes(std::span(shades_)));
    bound(indices_binding, std::as_bytes(std::span(indices_)));
  }
  // After others have had these bindings.
  static void bind_again(StepRunner& r) {
    for (const GLuint binding : {squares_binding, panels_binding, shades_binding, indices_binding}) r.bind(binding, binding);
  }
  int side() const { return side_; }
  int columns() const { return columns_; }
  int first_row() const { return first_y_ / side_; }
  std::int64_t rounds_of_a_piece() const { return rounds_of_a_piece_; }
  int dispatches() const { return dispatches_; }

 private:
  struct Square {
    int x, y, side;  // y: from the first row
    glm::ivec4 lists;
  };

  // Where a square's parts begin and end, then where its Gaussians do. Rounds of the squares that rays run as one belong to may
  // add up: each of `beside` in a row has its own dispatches.
  glm::ivec4 add(const GaussianPanels& p, int place, int beside) {
    const auto outside = static_cast<std::int64_t>(p.met().size() + 2 * a_.lights.size()) * 2;  // of panels
    room_ = most_rounds_ - outside;
    const auto first_panel = static_cast<int>(panels_.size() / 2), first_shade = static_cast<int>(shades_.size());
    const auto first_part = static_cast<int>(parts_.size());
    const auto met_gaussian = [&](std::uint32_t at) { return static_cast<int>(p.met()[at]); };
    std::int64_t rounds = 0;
    for (const GaussianPanels::Panel& one : p.panels()) {
      const glm::ivec2 active = list(p, one.active, met_gaussian), passed = list(p, one.passed, met_gaussian);
      std::int64_t of_lights = 0;  // with shadow volumes a dispatch takes one of them
      int pieces = 1;
      for (std::size_t k = 0; k < a_.lights.size(); ++k) {
        const GaussianPanels::Shade& s = p.shades()[one.shades + k];
        const std::int64_t of_this_light = 1 + s.shading.end - s.shading.begin;
        of_lights = a_.volumes ? std::max(of_lights, of_this_light) : of_lights + of_this_light;
        if (s.levels > 0) pieces += 2 * static_cast<int>(s.levels) + 1;
      }
      panels_.emplace_back(std::bit_cast<int>(one.begin), std::bit_cast<int>(one.end), active.x, active.y);
      panels_.emplace_back(passed.x, passed.y, first_shade + static_cast<int>(one.shades), one.samples);
      const int index = first_panel + static_cast<int>(&one - p.panels().data());
      const auto lights = static_cast<std::int64_t>(a_.lights.size());
      const std::int64_t once = 3 * lights + passed.y - passed.x + pieces * pieces / 2 + 3 * pieces;
      const std::int64_t a_piece =
          one.samples > 0 ? 1 + one.samples * (1 + active.y - active.x + of_lights + (a_.volumes ? 0 : one.samples)) : 0;
      rounds_of_a_piece_ = std::max(rounds_of_a_piece_, a_piece);
      rounds = split(index, pieces, once, a_piece, rounds, static_cast<int>(parts_.size()) == first_part);
    }
    for (const GaussianPanels::Shade& s : p.shades()) {
      const glm::ivec2 shading = list(p, s.shading, [](std::uint32_t word) { return std::bit_cast<int>(word); });
      shades_.emplace_back(shading, static_cast<int>(s.levels), s.shaded ? 1 : 0);
    }
    const std::vector<glm::ivec4> parts(parts_.begin() + first_part, parts_.end());
    parts_.resize(static_cast<std::size_t>(first_part));
    for (const glm::ivec4& one : parts) {
      for (int k = 0; k < beside; ++k) parts_.push_back(k == place ? one : glm::ivec4(0));
    }
    const auto first_met = static_cast<int>(indices_.size());
    for (const std::uint32_t g : p.met()) indices_.push_back(static_cast<int>(g));
    dispatches_ = std::max(dispatches_, static_cast<int>(parts_.size()) - first_part);
    return {first_part, static_cast<int>(parts_.size()), first_met, static_cast<int>(indices_.size())};
  }

  template <class Word>
  glm::ivec2 list(const GaussianPanels& p, GaussianPanels::Range r, Word&& word) {
    const auto begin = static_cast<int>(indices_.size());
    for (std::uint32_t i = r.begin; i < r.end; ++i) indices_.push_back(word(p.indices()[i]));
    return {begin, static_cast<int>(indices_.size())};
  }

  // Adds a panel to the part before it, or as one or more of its own. Returns the rounds of the last part.
  std::int64_t split(int panel, int pieces, std::int64_t once, std::int64_t a_piece, std::int64_t rounds, bool first) {
    const std::int64_t all = once + pieces * a_piece;
    if (!first && rounds + all <= room_ && parts_.back().w == all_pieces && parts_.back().z == 0) {
      parts_.back().y = panel + 1;
      return rounds + all;
    }
    if (all <= room_) {
      parts_.emplace_back(panel, panel + 1, 0, all_pieces);
      return all;
    }
    const std::int64_t fit = (room_ - once) / a_piece;
    if (fit < 1) {
      throw MachineError(
          "OpenGL: " + std::to_string(a_.gaussians.size()) +
          " Gaussians lie so that one piece of a ray meets more of them than a shader may, expected fewer samples");
    }
    const auto step = static_cast<int>(std::min<std::int64_t>(fit, all_pieces));
    for (int piece = 0; piece < pieces; piece += step) parts_.emplace_back(panel, panel + 1, piece, piece + step);
    return room_;
  }

  const GaussianAirlight& a_;
  std::int64_t most_rounds_, room_ = 0, rounds_of_a_piece_ = 1;
  int side_ = bin_side, columns_ = 0, first_y_, dispatches_ = 1;
  std::vector<glm::ivec4> squares_, parts_, panels_, shades_;
  std::vector<int> indices_;
};

struct Knobs {
  glm::vec4 albedo_extinction, ambient_sky_distance, emission_g;
  int phase_kind, side, columns, first_square_row;
  glm::vec4 rules[GaussianAirlight::most_samples * (GaussianAirlight::most_samples + 1) / 2];
  glm::vec4 before[most_before];
};

}  // namespace

void run(const GaussianAirlight& a, StepRunner& r, const Progress& progress) {
  std::vector<std::string> defines = bind_medium(r, a.gaussians, {}, {}, 1, LightDepth::analytic, a.erf);
  DepthTables depths(r, a.tables, a.depths, a.depth_volumes, defines);
  defines.push_back(r.lights(a.lights));
  if (a.per_light) defines.push_back("WITH_PER_LIGHT");
  if (a.optical_depth) defines.push_back("WITH_OPTICAL_DEPTH");
  if (a.extinction > 0) defines.push_back("WITH_TABLES");
  defines.push_back("MOST_CUTS " + std::to_string(all_pieces));
  defines.push_back("CUT_RATIO " + std::to_string(GaussianPanels::cut_ratio));
  defines.push_back("AROUND_LIGHT " + std::to_string(GaussianPanels::around_light) + "u");
  const bool shadowed = a.volumes && !a.lights.empty();
  if (shadowed) defines.push_back("WITH_LIT");
  if (a.noise.amplitude > 0) defines.push_back("WITH_NOISE");
  Program& program = r.compute("gpu/gaussian_airlight.glsl", defines);
  program.set("noise_amplitude", a.noise.amplitude);
  program.set("noise_inverse_scale", 1 / a.noise.scale);
  program.set("noise_offset", a.noise.offset);
  r.read(0, a.distance);
  r.read_write(0, a.airlight);
  r.read_write(1, a.per_light);
  r.write(2, a.transmittance);
  r.write(3, a.optical_depth);
  if (a.tables && a.depths.empty()) r.storage(tables_binding, a.tables);
  r.view(a.view);
  PanelLists lists(a, r.rows(), shadowed ? LoopBudget::most / 2 : LoopBudget::most);
  lists.bind(r);
  Knobs knobs{{a.albedo, a.extinction},
              {a.ambient, a.sky_distance},
              {a.emission, static_cast<float>(a.phase.g)},
              static_cast<int>(a.phase.kind),
              lists.side(),
              lists.columns(),
              lists.first_row(),
              {},
              {}};
  glm::vec4* to = knobs.rules;
  std::size_t beforehand = 0;
  for (int count = 1; count <= a.samples; ++count) {
    const GaussLegendre rule(count);
    for (std::size_t n = 0; n < rule.node.size(); ++n) *to++ = {rule.node[n], rule.weight[n], 0, 0};
    for (const float b : rule.before) {
      knobs.before[beforehand / 4][static_cast<int>(beforehand % 4)] = b;
      ++beforehand;
    }
  }
  r.block(knobs_binding, knobs);
  const auto each_part = [&](bool last, auto&& dispatch) {
    for (int part = 0; part < lists.dispatches(); ++part) {
      program.set("part", part);
      program.set("last_part", last && part + 1 == lists.dispatches() ? 1 : 0);
      dispatch();
    }
  };
  const auto lights = static_cast<int>(a.lights.size());
  if (!shadowed) {
    int first = 0;
    do {
      const int end = depths.hold(program, first, a.lights.size());
      program.set("pass_first_light", first);
      program.set("pass_end_light", end);
      each_part(end == lights, [&] { r.each_pixel(program, a.airlight.extent, progress); });
      first = end;
    } while (first < lights);
    return;
  }
  each_lit_run(a.view, a.lights.size(), a.volumes, a.sky_distance, r, progress, [&](const ShadowRun& run) {
    PanelLists::bind_again(r);
    depths.hold(program, run.light, a.lights.size());
    const int step = LoopBudget::lit_parts(lists.rounds_of_a_piece(), run.most_lit);
    program.set("most_lit", step);
    for (int first = 0; first == 0 || first < run.most_lit; first += step) {
      program.set("first_lit", first);
      each_part(run.light + 1 == lights && first + step >= run.most_lit, [&] { dispatch_run(r, program, run); });
    }
  });
}

}  // namespace airlight
