#include "common/plan/gaussian_panels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "common/plan/gaussian_shadows.h"
#include "common/plan/ray_cone.h"

namespace airlight {

namespace {

constexpr double panel_radii = 4;    // longest panel, in radii of the smallest Gaussian that is smooth over it
constexpr double panel_depth = 4;    // largest optical depth of a panel
constexpr double near_light = 0.7;   // of a panel's length: nearer lights have it cut
constexpr double unseen_depth = 90;  // of the homogeneous part: nothing is seen beyond
constexpr double horizon = 1e15;     // [m]
constexpr double finest = 4e-6;      // of the distance: shorter panels are not told apart in single precision
// Of a square's lists, of which each ray works through all. With more the square is worth quartering; what cannot be quartered
// has panels as they come after so many: what finer ones are worth falls with what stands before them.
struct Most {
  std::size_t panels, numbers;
};
constexpr Most most_of_square{1024, std::size_t{1} << 14U}, most_of_all{4096, std::size_t{1} << 24U};
constexpr double worth_quartering = 0.8;  // of a square's Gaussians at most: what a quarter meets on average
constexpr double sharing[2] = {64, 512};  // so many Gaussians of equal share make up for a node, and for two

double squared(double x) { return x * x; }

// An upper bound of exp(-q), q >= 0.
double falloff_bound(double q) {
  const double y = q / 16;
  return 1 / squared(squared(squared(squared(1 + y * (1 + y * (0.5 + y / 6))))));
}

// How much sooner than 1/r^2 alone a phase function makes the light near a lamp change.
double sharpness(const Phase& phase) {
  switch (phase.kind) {
    case PhaseKind::henyey_greenstein:
    case PhaseKind::cornette_shanks:
      return 1 - 0.6 * std::fabs(phase.g);
    case PhaseKind::mie_hazy:
    case PhaseKind::mie_murky:
      return 0.5;
    default:
      return 1;
  }
}

}  // namespace

struct GaussianPanels::Met {
  double begin, end;             // [m] along the rays, within its reach
  double least_foot, most_foot;  // [m]
  double radius, extinction, least_distance;
};

// What is asked once for many squares.
struct GaussianPanels::Neighbourhood {
  static constexpr int side = 4 * bin_side;

  GaussianReach reach{std::vector<GaussianDensity>{}};
  int x = -1, y = -1;                    // its upper left pixel
  std::vector<std::uint32_t> gaussians;  // that its rays may meet, ascending
  // Of one Build, for their memory.
  std::vector<Met> met;
  std::vector<std::uint32_t> stack;
  std::vector<Range> ranges;
  std::vector<std::pair<double, double>> stretches;

  void begin(const GaussianAirlight& a) {
    reach = GaussianReach(a.gaussians);
    x = y = -1;
  }

  void enter(const GaussianAirlight& a, int square_x, int square_y) {
    const int to_x = square_x - square_x % side, to_y = square_y - square_y % side;
    if (to_x == x && to_y == y) return;
    x = to_x, y = to_y;
    const RayCone cone(a.view, x, y, side);
    gaussians.clear();
    for (std::uint32_t i = 0; i < a.gaussians.size(); ++i) {
      if (cone.meets(a.gaussians[i])) gaussians.push_back(i);
    }
  }
};

struct GaussianPanels::Build {
  const GaussianAirlight& a;
  GaussianPanels& out;
  RayCone cone;
  std::vector<Met>& met;  // in the order of out.met_
  double sharp;
  Most most;
  bool everywhere;  // something is to be seen also where no Gaussian is
  int most_spared = 0;
  const GaussianReach& reach;
  // Lists of the recursion's branch: of Gaussians, and where the list of each light lies; with volumes only whether it is empty.
  std::vector<std::uint32_t>& stack;
  std::vector<Range>& ranges;
  Range last_active{};

  Build(const GaussianAirlight& algorithm, GaussianPanels& panels, int x, int y, int side, const Most& most_listed)
      : a(algorithm),
        out(panels),
        cone(a.view, x, y, side),
        met(panels.near_->met),
        sharp(sharpness(a.phase)),
        most(most_listed),
        everywhere(a.extinction > 0 || a.emission != glm::vec3(0)),
        reach(panels.near_->reach),
        stack(panels.near_->stack),
        ranges(panels.near_->ranges) {
    met.clear(), stack.clear(), ranges.clear();
    for (const std::uint32_t i : panels.near_->gaussians) meet(a.gaussians[i], i);
  }

  void meet(const GaussianDensity& g, std::uint32_t index) {
    const RayCone::Place p = cone.place(g.center);
    const double within = static_cast<double>(g.reach), radius = static_cast<double>(g.radius);
    const double h = cone.least_distance(p);
    if (h >= within) return;
    const double chord = std::sqrt((within - h) * (within + h));
    const double begin = std::max(0.0, cone.least_foot(p) - chord), end = cone.most_foot(p) + chord;
    if (end <= 0) return;
    out.met_.push_back(index);
    met.push_back({begin, end, cone.least_foot(p), cone.most_foot(p), radius, static_cast<double>(g.extinction), h});
  }

  // Cuts in which a light's peak has to be taken apart; 0: none.
  std::uint32_t levels(const Light& light, double begin, double end) const {
    if (light.directional) return 0;
    const RayCone::Place p = cone.place(light.vector);
    const double beside = std::max(static_cast<double>(light.radius), cone.least_distance(p));
    const double gap = std::max({0.0, begin - cone.most_foot(p), cone.least_foot(p) - end});
    double scale = std::sqrt(beside * beside + gap * gap) * sharp;
    std::uint32_t n = 0;
    for (const double length = end - begin; scale < near_light * length && n < 40; scale *= static_cast<double>(cut_ratio)) ++n;
    return n;
  }

  // Lists of the lights' Gaussians that may shade the sphere, from the lists at `from`; onto the stacks.
  void filter_shades(std::size_t from, const Sphere& s) {
    for (std::size_t k = 0; k < a.lights.size(); ++k) {
      const Range before = ranges[from + k];
      if (!a.depths.empty()) {
        ranges.push_back({0, before.end > 0 && reach.shades(a.lights[k], s) ? 1U : 0U});
        continue;
      }
      const LightWays ways(a.lights[k], s);
      const auto begin = static_cast<std::uint32_t>(stack.size());
      for (std::uint32_t i = before.begin; i < before.end; ++i) {
        const std::uint32_t index = stack[i];
        if (ways.meet(a.gaussians[index])) stack.push_back(index);
      }
      ranges.push_back({begin, static_cast<std::uint32_t>(stack.size())});
    }
  }

  // The longest panel over which all that shades the sphere from a light is smooth.
  double smooth_shadow(std::size_t light, Range shading, const Sphere& s) const {
    double longest = 1e300;
    if (shading.begin == shading.end) return longest;
    if (!a.depths.empty()) return panel_radii * reach.smooth(a.lights[light], s);
    const LightWays ways(a.lights[light], s);
    for (std::uint32_t i = shading.begin; i < shading.end; ++i)
      longest = std::min(longest, panel_radii * ways.smooth(a.gaussians[stack[i]], a.lights[light]));
    return longest;
  }

  bool full() const { return out.panels_.size() > most.panels || out.indices_.size() > most.numbers; }

  // Panels from begin to end. `active`: places in met, on the stack; the lights' lists begin at `from` of ranges.
  void cut(double begin, double end, Range active, std::size_t from, int depth) {
    const std::size_t stack_size = stack.size(), ranges_size = ranges.size();
    const Sphere sphere = cone.around(begin, end);
    const auto first = static_cast<std::uint32_t>(stack.size());
    double longest = 2 * (end - begin), density = static_cast<double>(a.extinction);
    for (std::uint32_t i = active.begin; i < active.end; ++i) {
      const std::uint32_t at = stack[i];
      const Met& m = met[at];
      if (m.begin >= end || m.end <= begin) continue;
      longest = std::min(longest, panel_radii * m.radius);
      const double away = std::max({0.0, begin - m.most_foot, m.least_foot - end});
      density += m.extinction * falloff_bound((squared(m.least_distance) + squared(away)) / squared(m.radius));
      stack.push_back(at);
    }
    const Range inside{first, static_cast<std::uint32_t>(stack.size())};
    const bool any = inside.begin < inside.end;
    if (any || everywhere) {
      const std::size_t shading = ranges.size();
      filter_shades(from, sphere);
      std::uint32_t cuts = 0;
      bool sampled = any;
      for (std::size_t k = 0; k < a.lights.size(); ++k) {
        const Range r = ranges[shading + k];
        longest = std::min(longest, smooth_shadow(k, r, sphere));
        if (!any && r.begin == r.end) continue;
        sampled = true;
        if (const std::uint32_t n = levels(a.lights[k], begin, end); n > 0) cuts += 2 * n + 1;
      }
      if (sampled && any) longest = std::min(longest, panel_depth / density);
      const bool fine = end - begin <= longest || full();
      const bool good = !sampled || (fine && cuts <= most_cuts);
      if (good || depth == 0 || end - begin < finest * end) {
        add(begin, end, inside, shading, sphere, (end - begin) / longest);
      } else {
        const double middle = begin + (end - begin) / 2;
        cut(begin, middle, inside, shading, depth - 1);
        cut(middle, end, inside, shading, depth - 1);
      }
    }
    stack.resize(stack_size);
    ranges.resize(ranges_size);
  }

  void add(double begin, double end, Range inside, std::size_t shading, const Sphere& sphere, double part) {
    Panel p;
    p.begin = static_cast<float>(begin);
    p.end = static_cast<float>(end);
    p.active.begin = static_cast<std::uint32_t>(out.indices_.size());
    for (std::uint32_t i = inside.begin; i < inside.end; ++i) out.indices_.push_back(stack[i]);
    p.active.end = static_cast<std::uint32_t>(out.indices_.size());
    // Both lists ascend.
    p.passed.begin = p.active.end;
    std::uint32_t now = p.active.begin;
    for (std::uint32_t i = last_active.begin; i < last_active.end; ++i) {
      const std::uint32_t index = out.indices_[i];
      while (now < p.active.end && out.indices_[now] < index) ++now;
      if (now == p.active.end || out.indices_[now] != index) out.indices_.push_back(index);
    }
    p.passed.end = static_cast<std::uint32_t>(out.indices_.size());
    last_active = p.active;
    p.shades = static_cast<std::uint32_t>(out.shades_.size());
    bool sampled = p.active.begin < p.active.end;
    std::uint32_t cuts = 0;
    bool plain = p.active.begin == p.active.end && p.passed.begin == p.passed.end;
    for (std::size_t k = 0; k < a.lights.size(); ++k) {
      Shade s;
      const Range list = ranges[shading + k];
      s.shaded = list.begin < list.end;
      s.shading.begin = static_cast<std::uint32_t>(out.indices_.size());
      const LightWays ways(a.lights[k], sphere);
      for (std::uint32_t i = list.begin; i < list.end && a.depths.empty(); ++i) {
        out.indices_.push_back(stack[i] | (ways.behind(a.gaussians[stack[i]]) ? around_light : 0));
      }
      s.shading.end = static_cast<std::uint32_t>(out.indices_.size());
      const bool closed = closed_form(p, s);
      plain = plain && closed;
      sampled = sampled || !closed;
      // Only a panel that cannot be divided any more has more cuts than there is room for.
      const std::uint32_t n = closed ? 0 : levels(a.lights[k], begin, end);
      if (n > 0 && cuts + 2 * n + 1 <= most_cuts) s.levels = n, cuts += 2 * n + 1;
      out.shades_.push_back(s);
    }
    if (plain && !out.panels_.empty() && out.panels_.back().active.begin == out.panels_.back().active.end) {
      Panel& before = out.panels_.back();
      bool joins = before.end >= p.begin;
      for (std::size_t k = 0; k < a.lights.size(); ++k) joins = joins && closed_form(before, out.shades_[before.shades + k]);
      if (joins) {  // two closed forms are one
        before.end = p.end;
        out.shades_.resize(p.shades);
        return;
      }
    }
    if (sampled) p.samples = samples(part);
    out.panels_.push_back(p);
  }

  // How many nodes fewer a panel may have.
  int spared() const {
    double sum = 0, squares = 0;
    for (const Met& m : met) {
      const double depth = m.extinction * m.radius * falloff_bound(squared(m.least_distance / m.radius));
      sum += depth, squares += depth * depth;
    }
    int n = 0;
    for (const double many : sharing) n += sum * sum > many * squares ? 1 : 0;
    return n;
  }
  // `part`: of the longest panel.
  int samples(double part) const {
    const double n = std::ceil(static_cast<double>(a.samples) * (0.4 + 0.6 * std::min(part, 1.0)) - 1e-9);
    return std::clamp(static_cast<int>(n) - most_spared, std::min(2, a.samples), a.samples);
  }

  void run() {
    if (!shines(a, out.met_)) return;
    most_spared = spared();
    const double extinction = static_cast<double>(a.extinction);
    // Not sky_distance: surfaces may be farther away than that.
    const double limit = std::min(horizon, extinction > 0 ? unseen_depth / extinction : horizon);
    for (std::uint32_t i = 0; i < met.size(); ++i) stack.push_back(i);
    const Range all{0, static_cast<std::uint32_t>(stack.size())};
    for (std::size_t k = 0; k < a.lights.size(); ++k) {
      if (!a.depths.empty()) {
        ranges.push_back({0, a.gaussians.empty() ? 0U : 1U});
        continue;
      }
      const auto begin = static_cast<std::uint32_t>(stack.size());
      for (std::uint32_t i = 0; i < a.gaussians.size(); ++i) stack.push_back(i);
      ranges.push_back({begin, static_cast<std::uint32_t>(stack.size())});
    }
    // Stretches with Gaussians, joined where they overlap; between and behind them only what is everywhere.
    std::vector<std::pair<double, double>>& stretches = out.near_->stretches;
    stretches.clear();
    for (const Met& m : met) stretches.emplace_back(m.begin, std::min(m.end, limit));
    std::sort(stretches.begin(), stretches.end());
    double at = 0;
    const auto between = [&](double to) {  // lengths that grow with distance
      for (double next = 0; everywhere && at < to; at = next) {
        next = std::min(to, std::max(4 * at, 1.0));
        cut(at, next, all, 0, 60);
      }
    };
    for (std::size_t i = 0; i < stretches.size();) {
      double begin = stretches[i].first, end = stretches[i].second;
      for (; i < stretches.size() && stretches[i].first <= end; ++i) end = std::max(end, stretches[i].second);
      if (!(begin < limit)) break;
      between(begin);
      cut(begin, end, all, 0, 60);
      at = end;
    }
    between(limit);
  }
};

namespace {

bool everything_shines(const GaussianAirlight& a) { return !a.lights.empty() || a.emission != glm::vec3(0); }
bool glows(const GaussianDensity& g) { return g.emission != glm::vec3(0); }

}  // namespace

bool shines(const GaussianAirlight& a, std::span<const std::uint32_t> met) {
  return everything_shines(a) || std::any_of(met.begin(), met.end(), [&](auto i) { return glows(a.gaussians[i]); });
}

bool shines(const GaussianAirlight& a) {
  return everything_shines(a) || std::any_of(a.gaussians.begin(), a.gaussians.end(), glows);
}

GaussianPanels::GaussianPanels() : near_(std::make_unique<Neighbourhood>()) {}
GaussianPanels::~GaussianPanels() = default;

void GaussianPanels::begin(const GaussianAirlight& a) {
  algorithm_ = &a;
  near_->begin(a);
}

bool GaussianPanels::quarters_meet_fewer(int x, int y, int side) const {
  if (side == 1) return false;
  std::size_t met = 0;
  for (int k = 0; k < 4; ++k) {
    const RayCone quarter(algorithm_->view, x + k % 2 * side / 2, y + k / 2 * side / 2, side / 2);
    for (const std::uint32_t i : met_) met += quarter.meets(algorithm_->gaussians[i]) ? 1 : 0;
  }
  return static_cast<double>(met) < 4 * worth_quartering * static_cast<double>(met_.size());
}

bool GaussianPanels::make(int x, int y, int side) {
  near_->enter(*algorithm_, x, y);
  const auto build = [&](const Most& most) {
    panels_.clear(), shades_.clear(), indices_.clear(), met_.clear();
    Build one(*algorithm_, *this, x, y, side, most);
    one.run();
    return !one.full();
  };
  if (build(most_of_square)) return true;
  if (quarters_meet_fewer(x, y, side)) return false;
  build(most_of_all);
  return true;
}

}  // namespace airlight
