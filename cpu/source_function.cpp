#include <algorithm>
#include <array>
#include <vector>

#include "common/formulas/float.h"
#include "cpu/kernels.h"
#include "cpu/network_links.h"

namespace airlight {

namespace {

constexpr std::size_t chunk = 4;  // lines whose beams are held at once: what a cache of one core holds

// Radiance on one bundle of lines: of each link, what leaves it along the line and against it; and where particles are.
struct Beams {
  std::vector<float> forward, backward;  // rgb and an unused float a record
  std::vector<std::int32_t> along;       // a record, of its particle

  void make(const Links& links, const std::int32_t* line, const float* particles, const float* source, const float* source_back,
            const float* sky, const NetworkShape& shape) {
    forward.resize(4 * shape.records());
    backward.resize(4 * shape.records());
    along.resize(shape.records());
    links.each_list([&](std::size_t at, std::size_t n) {
      const auto sweep = [&](bool back, const float* sent, float* out) {
        Rgb beam = rgb_at(sky, back ? 1 : 0);
        for (std::size_t step = 0; step <= n; ++step) {
          const std::size_t k = at + (back ? n - step : step);
          const Rgb a = rgb_at(sent, links.particle_at(k == at ? k : k - 1));
          const Rgb b = rgb_at(sent, links.particle_at(k == at + n ? k - 1 : k));
          for (std::size_t c = 0; c < 4; ++c) {
            beam.v[c] += links.given[k] * 0.5F * (a.v[c] + b.v[c]) - links.lost[k] * beam.v[c];
            out[4 * k + c] = beam.v[c];
          }
        }
      };
      sweep(false, source, forward.data());
      sweep(true, source_back, backward.data());
      for (std::size_t k = at; k < at + n; ++k) {
        std::int32_t sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          sum +=
              line[line_direction + axis] * static_cast<std::int32_t>(particles[axis * shape.particles + links.particle_at(k)]);
        along[k] = sum;
      }
    });
  }
};

// A node of the box.
struct Node {
  std::int32_t place[3];
  glm::vec3 to_camera{0, 0, 0};  // unit length
};

std::int32_t dot_of(const std::int32_t* a, const Node& node) {
  return a[0] * node.place[0] + a[1] * node.place[1] + a[2] * node.place[2];
}

void add_scaled(float (&sum)[3], const float* beam, float weight) {
  for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * beam[c];
}

// Where the last node lay, from which the next one is not far.
struct Cursor {
  std::size_t number[2] = {0, 0};                   // of its pixel, across and down
  std::size_t pixel = ~std::size_t{0}, before = 0;  // how many particles lie before it on its line
};

// Adds what arrives at the node along one bundle, each way with its weight. `sky`: what does both ways where nothing is met.
void add_beams(const Links& links, const std::int32_t* line, const std::int32_t* edges, const Beams& beams, const float* sky,
               const Node& node, float forward, float backward, Cursor& cursor, float (&sum)[3]) {
  const auto nothing_met = [&] {
    add_scaled(sum, sky, forward);
    add_scaled(sum, sky + 4, backward);
  };
  float width[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const std::int32_t across = dot_of(line + (k == 0 ? line_across : line_down), node);
    const std::int32_t *first = edges + (k == 0 ? 0 : line[line_pixels] + 1), *last = first + line[line_pixels + k];
    if (across < *first || across >= *last) return nothing_met();
    std::size_t& number = cursor.number[k];
    while (across < first[number]) --number;
    while (across >= first[number + 1]) ++number;
    width[k] = static_cast<float>(first[number + 1] - first[number]);
  }
  const std::size_t c = cursor.number[0] + static_cast<std::size_t>(line[line_pixels]) * cursor.number[1];
  const auto first = static_cast<std::size_t>(links.begin[c]), n = static_cast<std::size_t>(links.begin[c + 1]) - first;
  if (n == 0) return nothing_met();
  const std::size_t at = first + c;
  const std::int32_t here = dot_of(line + line_direction, node);
  const auto begin = beams.along.begin() + static_cast<std::ptrdiff_t>(at);
  if (cursor.pixel != c) {
    cursor.before = static_cast<std::size_t>(std::upper_bound(begin, begin + static_cast<std::ptrdiff_t>(n), here) - begin);
    cursor.pixel = c;
  }
  std::size_t& k = cursor.before;
  while (k < n && begin[static_cast<std::ptrdiff_t>(k)] <= here) ++k;
  while (k > 0 && begin[static_cast<std::ptrdiff_t>(k) - 1] > here) --k;
  const float *along = beams.forward.data() + 4 * at, *against = beams.backward.data() + 4 * at;
  // Between particles k - 1 and k. Outside all, light fades out to what enters or leaves within about the width of a pixel.
  if (k == 0) {
    const auto away = static_cast<float>(begin[0] - here);
    const float share = away / (away + width[0]);
    add_scaled(sum, sky, forward * share);
    add_scaled(sum, along, forward * (1 - share));
    add_scaled(sum, against + 4, backward * (1 - share));
    add_scaled(sum, against, backward * share);
    return;
  }
  if (k == n) {
    const auto away = static_cast<float>(here - begin[static_cast<std::ptrdiff_t>(n) - 1]);
    const float share = away / (away + width[0]);
    add_scaled(sum, along + 4 * (n - 1), forward * (1 - share));
    add_scaled(sum, along + 4 * n, forward * share);
    add_scaled(sum, against + 4 * n, backward * (1 - share));
    add_scaled(sum, sky + 4, backward * share);
    return;
  }
  const std::int32_t before = begin[static_cast<std::ptrdiff_t>(k) - 1], after = begin[static_cast<std::ptrdiff_t>(k)];
  const float share = static_cast<float>(here - before) / static_cast<float>(after - before);
  add_scaled(sum, along + 4 * (k - 1), forward * (1 - share));
  add_scaled(sum, along + 4 * k, forward * share);
  add_scaled(sum, against + 4 * k, backward * (1 - share));
  add_scaled(sum, against + 4 * (k + 1), backward * share);
}

// Between nodes lookups are linear, and have the mean of what is there to fourth order with nodes that are lower by a twelfth of
// their second differences; not below a half.
float sharpened(float value, float second_difference) { return std::max(value - second_difference / 12, 0.5F * value); }

// Nodes as the table has them, a brick after another.
struct BrickNodes {
  const SourceFunction& a;
  const float* numbers;  // of all bricks, as the table has them
  std::array<std::size_t, 3> size;

  std::size_t at(std::size_t brick, const std::array<std::size_t, 3>& number) const {
    return number[0] + size[0] * (number[1] + size[1] * (number[2] + size[2] * brick));
  }
  // The one beside a node, in the next brick if need be. Itself where there is none.
  std::size_t beside(std::size_t brick, std::array<std::size_t, 3> number, std::size_t axis, bool after) const {
    const std::size_t here = at(brick, number), last = size[axis] - 1;
    if (number[axis] != (after ? last : 0)) {
      number[axis] += after ? 1 : ~std::size_t{0};
      return at(brick, number);
    }
    std::array<std::int32_t, 3> next = a.brick(brick);
    next[axis] += after ? 1 : -1;
    const auto x = static_cast<std::int32_t>(a.bricks.x), y = static_cast<std::int32_t>(a.bricks.y);
    if (next[axis] < 0 || next[axis] >= static_cast<std::int32_t>(a.bricks[static_cast<int>(axis)])) return here;
    const float found = numbers[next[0] + x * (next[1] + y * next[2])];
    if (found < 0) return here;
    number[axis] = after ? 1 : last - 1;
    return at(static_cast<std::size_t>(found), number);
  }
};

// Unit direction of a line.
glm::vec3 direction_of(const std::int32_t* line) {
  const glm::vec3 w(line[line_direction], line[line_direction + 1], line[line_direction + 2]);
  const f32::Float length = f32::sqrt(f32::fma(w.x, w.x, f32::fma(w.y, w.y, w.z * w.z)));
  return w * (1 / length.v);
}

}  // namespace

void run_volume(const SourceFunction& a, const BufferView& view, Workers& workers, Simd) {
  const NetworkShape shape = a.shape();
  const bool isotropic = a.phase.kind == PhaseKind::isotropic;
  const auto nx = static_cast<std::size_t>(a.nodes.x), ny = static_cast<std::size_t>(a.nodes.y),
             nz = static_cast<std::size_t>(a.nodes.z);
  const std::int32_t* lines = view.integers(a.lines);
  const float *particles = view.floats(a.particles), *sent = view.floats(a.particle_sources);
  const std::vector<float> head = a.head();
  const BrickNodes all{a, head.data() + 8, {nx, ny, nz}};
  view.counts.parts = SourceFunction::product(a.bricks);
  view.counts.skipped_parts = view.counts.parts - a.filled.size();
  std::vector<float> sums(4 * a.all_nodes(), 0.0F);  // rgb and weights
  std::vector<float> sky(4 * 2 * shape.lines, 0.0F);
  if (a.sky) std::copy_n(view.floats(a.sky), sky.size(), sky.begin());
  std::vector<Beams> beams(chunk);
  for (std::size_t first = 0; first < shape.lines; first += chunk) {
    const std::size_t count = std::min(chunk, shape.lines - first);
    workers.each(static_cast<int>(count), [&](int n, int) {
      const std::size_t l = first + static_cast<std::size_t>(n), of_a_way = isotropic ? 0 : 4 * shape.particles;
      const std::int32_t* line = lines + line_fields * l;
      beams[static_cast<std::size_t>(n)].make(Links(shape, view.floats(a.links), l), line, particles, sent + of_a_way * 2 * l,
                                              sent + of_a_way * (2 * l + 1), sky.data() + 8 * l, shape);
    });
    workers.each(static_cast<int>(a.filled.size() * ny * nz), [&](int row, int) {
      const auto j = static_cast<std::size_t>(row) % ny, k = static_cast<std::size_t>(row) / ny % nz;
      const std::size_t number_of_brick = static_cast<std::size_t>(row) / ny / nz;
      const std::array<std::int32_t, 3> brick = a.brick(number_of_brick);
      std::vector<Node> nodes(nx);
      for (std::size_t i = 0; i < nx; ++i) {
        const std::size_t number[3] = {i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::int32_t cells = static_cast<std::int32_t>(all.size[axis]) - 1;
          nodes[i].place[axis] = static_cast<std::int32_t>(a.first[static_cast<int>(axis)]) +
                                 a.stride * (brick[axis] * cells + static_cast<std::int32_t>(number[axis]));
        }
        if (isotropic) continue;
        const std::int32_t(&place)[3] = nodes[i].place;
        const glm::vec3 way = a.camera - glm::vec3(place[0], place[1], place[2]) * a.unit;
        const f32::Float squared = f32::fma(way.x, way.x, f32::fma(way.y, way.y, way.z * way.z));
        nodes[i].to_camera = way * (1 / f32::sqrt(f32::max(squared, 1e-30)).v);
      }
      // Each node has its sum over the lines in their order; nodes next to each other lie next to each other on a line.
      for (std::size_t n = 0; n < count; ++n) {
        const std::int32_t* line = lines + line_fields * (first + n);
        const Links links(shape, view.floats(a.links), first + n);
        const glm::vec3 w = direction_of(line);
        Cursor cursor;
        for (std::size_t i = 0; i < nx; ++i) {
          float forward = 1, backward = 1;
          if (!isotropic) {
            const glm::vec3& t = nodes[i].to_camera;
            const f32::Float mu = f32::fma(w.x, t.x, f32::fma(w.y, t.y, w.z * t.z));
            const int kind = static_cast<int>(a.phase.kind);
            forward = f32::phase_value(kind, a.phase.g, mu).v;
            backward = f32::phase_value(kind, a.phase.g, -mu).v;
          }
          float* out = sums.data() + 4 * all.at(number_of_brick, {i, j, k});
          float sum[3] = {out[0], out[1], out[2]};
          add_beams(links, line, lines + shape.edges(first + n), beams[n], sky.data() + 8 * (first + n), nodes[i], forward,
                    backward, cursor, sum);
          std::copy_n(sum, 3, out);
          out[3] += forward + backward;
        }
      }
    });
  }
  float* out = view.made(a.sources);
  std::copy(head.begin(), head.end(), out);
  const std::size_t of_brick = nx * ny * nz;
  for (std::size_t n = 0; n < a.all_nodes(); ++n) {
    const std::size_t brick = n / of_brick, within = n % of_brick;
    const std::array<std::size_t, 3> number{within % nx, within / nx % ny, within / nx / ny};
    std::size_t before[3], after[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
      before[axis] = all.beside(brick, number, axis, false), after[axis] = all.beside(brick, number, axis, true);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto mean = [&](std::size_t node) { return sums[4 * node + c] / sums[4 * node + 3]; };
      const float here = mean(n);
      float bent = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (before[axis] != n && after[axis] != n) bent += mean(before[axis]) - 2 * here + mean(after[axis]);
      }
      const float value = sharpened(here, bent);
      out[head.size() + of_brick * (3 * brick + c) + within] = value;
      out[3] = std::max(out[3], value);
    }
  }
}

}  // namespace airlight
