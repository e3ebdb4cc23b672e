#include "bench/pareto/plot.h"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>

#include "common/error.h"

namespace airlight {

namespace {

constexpr double width = 900, height = 620;
constexpr double left = 86, right = 24, top = 52, bottom = 64;

struct Colour {
  double r, g, b;
};
constexpr Colour colours[] = {{0.12, 0.38, 0.67}, {0.85, 0.37, 0.05}, {0.18, 0.53, 0.25}, {0.55, 0.24, 0.57}, {0.65, 0.55, 0.1}};

// A logarithmic axis from one power of ten (or its double or fivefold) to another.
struct Axis {
  double least, most, from, to;  // values, and their places [pixel]
  double operator()(double v) const { return from + (to - from) * std::log(v / least) / std::log(most / least); }
};

Axis axis_over(double least, double most, double from, double to) {
  const auto down = [](double v) {
    const double ten = std::pow(10, std::floor(std::log10(v) + 1e-9));
    return v >= 5 * ten ? 5 * ten : v >= 2 * ten ? 2 * ten : ten;
  };
  const double low = down(least * 0.8), high = most * 1.4;
  return {low, std::max(high, low * 10), from, to};
}

class Figure {
 public:
  Figure(cairo_t* cairo, const Measurement& m, const std::string& title) : c_(cairo), m_(m), title_(title) {}

  void draw() {
    double fastest = 1e300, slowest = 0, best = 1e300, worst = 0;
    for (const Point& p : m_.points) {
      if (!shown(p)) continue;
      fastest = std::min(fastest, p.ms), slowest = std::max(slowest, p.ms);
      best = std::min(best, percent(p)), worst = std::max(worst, percent(p));
      const std::string& t = p.configuration.technique;
      if (std::find(techniques_.begin(), techniques_.end(), t) == techniques_.end()) techniques_.push_back(t);
      if (std::find(backends_.begin(), backends_.end(), p.configuration.backend) == backends_.end())
        backends_.push_back(p.configuration.backend);
    }
    cairo_set_source_rgb(c_, 1, 1, 1);
    cairo_paint(c_);
    cairo_select_font_face(c_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    text(left, 24, title_, 17, 0.1);
    if (techniques_.empty()) {
      text(left, top + 30, "no technique of this version renders this scene", 14, 0.3);
      return;
    }
    x_ = axis_over(fastest, slowest, left, width - right);
    y_ = axis_over(best, worst, height - bottom, top);
    axes();
    fronts();
    for (const Point& p : m_.points) {
      if (shown(p)) marker(x_(p.ms), y_(percent(p)), p, 1);
    }
    labels();
    legend();
  }

 private:
  static double percent(const Point& p) { return 100 * std::max(p.error.everywhere, 1e-8); }
  static bool shown(const Point& p) { return p.ms > 0; }

  void text(double x, double y, const std::string& s, double size, double grey, double align = 0) {
    cairo_set_font_size(c_, size);
    cairo_text_extents_t extents;
    cairo_text_extents(c_, s.c_str(), &extents);
    cairo_set_source_rgb(c_, grey, grey, grey);
    cairo_move_to(c_, x - align * extents.x_advance, y);
    cairo_show_text(c_, s.c_str());
  }

  void line(double x0, double y0, double x1, double y1, double grey, double line_width) {
    cairo_set_source_rgb(c_, grey, grey, grey);
    cairo_set_line_width(c_, line_width);
    cairo_move_to(c_, x0, y0);
    cairo_line_to(c_, x1, y1);
    cairo_stroke(c_);
  }

  // Lines at 1, 2, ... 9 of each power of ten; numbers at 1, 2 and 5 where the axis is short, else at 1.
  template <class Tick>
  static void ticks(const Axis& axis, const Tick& tick) {
    const bool short_axis = axis.most / axis.least < 400;
    for (double ten = std::pow(10, std::floor(std::log10(axis.least))); ten <= axis.most; ten *= 10) {
      for (int k = 1; k < 10; ++k) {
        const double v = k * ten;
        if (v < axis.least * 0.999 || v > axis.most) continue;
        tick(v, k == 1, k == 1 || (short_axis && (k == 2 || k == 5)));
      }
    }
  }

  void axes() {
    ticks(x_, [&](double v, bool whole, bool numbered) {
      line(x_(v), top, x_(v), height - bottom, whole ? 0.8 : 0.93, 1);
      if (numbered) text(x_(v), height - bottom + 19, fmt::format("{:g}", v), 13, 0.25, 0.5);
    });
    ticks(y_, [&](double v, bool whole, bool numbered) {
      line(left, y_(v), width - right, y_(v), whole ? 0.8 : 0.93, 1);
      if (numbered) text(left - 8, y_(v) + 4, fmt::format("{:g} %", v), 13, 0.25, 1);
    });
    line(left, top, left, height - bottom, 0.3, 1.2);
    line(left, height - bottom, width - right, height - bottom, 0.3, 1.2);
    text((left + width - right) / 2, height - 18, "frame time [ms]", 14, 0.15, 0.5);
    text(left, top - 10, "relative RMSE", 14, 0.15);
  }

  Colour colour_of(const std::string& technique) const {
    const auto at = std::find(techniques_.begin(), techniques_.end(), technique) - techniques_.begin();
    return colours[static_cast<std::size_t>(at) % std::size(colours)];
  }

  std::vector<const Point*> front(const std::string& backend) const {
    std::vector<const Point*> on;
    for (const Point& p : m_.points) {
      if (p.on_front && p.configuration.backend == backend) on.push_back(&p);
    }
    std::sort(on.begin(), on.end(), [](const Point* a, const Point* b) { return a->ms < b->ms; });
    return on;
  }

  void fronts() {
    for (const std::string& backend : backends_) {
      const std::vector<const Point*> on = front(backend);
      cairo_set_source_rgb(c_, 0.45, 0.45, 0.45);
      cairo_set_line_width(c_, 1.4);
      for (std::size_t i = 0; i < on.size(); ++i) {
        const double x = x_(on[i]->ms), y = y_(percent(*on[i]));
        if (i == 0) cairo_move_to(c_, x, top);
        cairo_line_to(c_, x, i == 0 ? y : y_(percent(*on[i - 1])));  // only what is measured: steps, no slopes
        cairo_line_to(c_, x, y);
      }
      if (!on.empty()) cairo_line_to(c_, width - right, y_(percent(*on.back())));
      cairo_stroke(c_);
    }
  }

  // Discs for the first backend, squares for the second; hollow off the front.
  void marker(double x, double y, const Point& p, double alpha) {
    const Colour k = colour_of(p.configuration.technique);
    const double r = p.on_front ? 5 : 3.5;
    cairo_new_sub_path(c_);
    if (p.configuration.backend == "gl") {
      cairo_rectangle(c_, x - r, y - r, 2 * r, 2 * r);
    } else {
      cairo_arc(c_, x, y, r, 0, 2 * std::numbers::pi);
    }
    cairo_set_source_rgba(c_, p.on_front ? k.r : 1, p.on_front ? k.g : 1, p.on_front ? k.b : 1, alpha);
    cairo_fill_preserve(c_);
    cairo_set_source_rgb(c_, k.r, k.g, k.b);
    cairo_set_line_width(c_, 1.3);
    cairo_stroke(c_);
  }

  struct Box {
    double x, y, w, h;
    bool meets(const Box& o) const { return x < o.x + o.w && o.x < x + w && y < o.y + o.h && o.y < y + h; }
  };

  // Front points by their knobs, where there is room: right of the point and above, or left and below.
  void labels() {
    std::vector<Box> taken;
    for (const Point& p : m_.points) {
      if (p.on_front) taken.push_back({x_(p.ms) - 5, y_(percent(p)) - 5, 10, 10});
    }
    cairo_set_font_size(c_, 11);
    for (const std::string& backend : backends_) {
      for (const Point* p : front(backend)) {
        const std::string s = text_of(p->configuration.knobs);
        cairo_text_extents_t e;
        cairo_text_extents(c_, s.c_str(), &e);
        const double x = x_(p->ms), y = y_(percent(*p));
        for (const auto& [dx, dy] : {std::pair(9.0, -7.0), std::pair(9.0, 14.0), std::pair(-9.0 - e.x_advance, 16.0),
                                     std::pair(-9.0 - e.x_advance, -7.0), std::pair(9.0, -21.0), std::pair(9.0, 27.0)}) {
          const Box box{x + dx - 1, y + dy - 10, e.x_advance + 2, 13};
          const bool inside = box.x > left && box.x + box.w < width - 4 && box.y > top - 6 && box.y + box.h < height - bottom;
          if (!inside || std::any_of(taken.begin(), taken.end(), [&](const Box& t) { return t.meets(box); })) continue;
          taken.push_back(box);
          text(x + dx, y + dy, s, 11, 0.25);
          break;
        }
      }
    }
  }

  void legend() {
    double y = top + 16;
    const double x = width - right - 190;
    const double rows = static_cast<double>(techniques_.size() * backends_.size());
    cairo_set_source_rgba(c_, 1, 1, 1, 0.88);
    cairo_rectangle(c_, x - 14, top + 2, 200, rows * 19 + 8);
    cairo_fill(c_);
    for (const std::string& t : techniques_) {
      for (const std::string& b : backends_) {
        Point p{{t, b, {}}, {}};
        p.on_front = true;
        marker(x, y - 4, p, 1);
        text(x + 14, y, t + ", " + b, 13, 0.15);
        y += 19;
      }
    }
  }

  cairo_t* c_;
  const Measurement& m_;
  const std::string& title_;
  std::vector<std::string> techniques_, backends_;
  Axis x_{}, y_{};
};

// Draws on a surface and writes it under a temporary name first.
template <class Write>
void render(cairo_surface_t* made, const Measurement& m, const std::string& title, double scale, const std::string& target,
            const Write& write) {
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(made, cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> context(cairo_create(made), cairo_destroy);
  cairo_scale(context.get(), scale, scale);
  Figure(context.get(), m, title).draw();
  write(made);
  std::error_code failure;
  if (cairo_status(context.get()) == CAIRO_STATUS_SUCCESS) std::filesystem::rename(target + ".part", target, failure);
  if (failure || !std::filesystem::exists(target)) throw MachineError(target + ": cannot be written");
}

}  // namespace

void draw(const Measurement& m, const std::string& title, const std::string& name) {
  render(cairo_svg_surface_create((name + ".svg.part").c_str(), width, height), m, title, 1, name + ".svg",
         [](cairo_surface_t* s) { cairo_surface_finish(s); });
  render(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(1.5 * width), static_cast<int>(1.5 * height)), m, title,
         1.5, name + ".png", [&](cairo_surface_t* s) { cairo_surface_write_to_png(s, (name + ".png.part").c_str()); });
}

}  // namespace airlight
