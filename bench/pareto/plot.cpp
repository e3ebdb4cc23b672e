#include "bench/pareto/plot.h"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "bench/pareto/axis.h"
#include "bench/pareto/canvas.h"
#include "bench/pareto/labels.h"

namespace airlight {

namespace {

constexpr double width = 900, height = 560;                      // [pixel]
constexpr Box area{84, 64, width - 84 - 176, height - 64 - 62};  // inside the axes
constexpr double right = area.x + area.width, bottom = area.y + area.height;
constexpr double label_size = 10.5, least_percent = 1e-7;  // float cannot tell less

// Okabe and Ito's colours, which colour-blind readers tell apart.
constexpr Colour colours[] = {{0, 0.447, 0.698}, {0.835, 0.369, 0}, {0, 0.62, 0.451}, {0.8, 0.475, 0.655}, {0.337, 0.706, 0.914}};

double percent(const Point& p) { return std::max(100 * p.error.everywhere, least_percent); }

class Drawing {
 public:
  Drawing(cairo_t* cairo, const Measurement& m, const Origin& origin) : canvas_(cairo), m_(m), origin_(origin) {
    std::vector<double> times, errors;
    for (const Point& p : m.points) {
      if (std::find(techniques_.begin(), techniques_.end(), p.configuration.technique) == techniques_.end())
        techniques_.push_back(p.configuration.technique);
      if (p.ms <= 0 || !(percent(p) < 1e30)) continue;
      shown_.push_back(&p);
      times.push_back(p.ms);
      errors.push_back(percent(p));
    }
    if (shown_.empty()) return;
    x_ = axis_over(times, area.x, right);
    y_ = axis_over(errors, bottom, area.y);
    std::stable_sort(shown_.begin(), shown_.end(), [](const Point* a, const Point* b) { return a->ms < b->ms; });
  }

  void draw() {
    canvas_.box(0, 0, width, height, grey(1));
    heading();
    axes();
    for (const auto& device : m_.devices) draw_front(device.first);
    for (const bool on_front : {false, true}) {
      for (const Point* p : shown_) {
        if (p->on_front == on_front) marker(*p);
      }
    }
    labels();
    legend();
  }

 private:
  void heading() {
    canvas_.text(
        area.x, 24,
        fmt::format("{}: time against error at {} × {} pixels", origin_.scene, origin_.extent.width, origin_.extent.height), 15,
        grey(0.1), 0, true);
    std::string where = origin_.machine;
    for (const auto& device : m_.devices) where += "; " + device.second;
    const double room = width - area.x - 12, size = 10.5;
    canvas_.text(area.x, 43, where, std::min(size, size * room / canvas_.text_width(where, size)), grey(0.4));
  }

  void axes() {
    for (const Tick& t : ticks(x_)) {
      canvas_.line(x_(t.value), area.y, x_(t.value), bottom, grey(t.power ? 0.82 : 0.93), 1);
      canvas_.text(x_(t.value), bottom + 18, t.label, 12, grey(0.2), 0.5);
    }
    for (const Tick& t : ticks(y_)) {
      canvas_.line(area.x, y_(t.value), right, y_(t.value), grey(t.power ? 0.82 : 0.93), 1);
      canvas_.text(area.x - 8, y_(t.value) + 4, t.label, 12, grey(0.2), 1);
    }
    canvas_.line(area.x, area.y, area.x, bottom, grey(0.25), 1.2);
    canvas_.line(area.x, bottom, right, bottom, grey(0.25), 1.2);
    canvas_.text(area.x + area.width / 2, bottom + 42, "time of a frame [ms]", 13, grey(0.1), 0.5);
    canvas_.upward_text(24, area.y + area.height / 2, "error of the image, relative RMSE [%]", 13, grey(0.1));
    if (shown_.empty()) canvas_.text(area.x + area.width / 2, area.y + 40, "nothing was timed", 13, grey(0.3), 0.5);
  }

  // In steps: what nobody has measured lies in no slope. From the top of the axes to their right.
  std::vector<std::pair<double, double>> front(const std::string& backend) const {
    std::vector<std::pair<double, double>> corners;
    for (const Point* p : shown_) {
      if (!p->on_front || p->configuration.backend != backend) continue;
      corners.emplace_back(x_(p->ms), corners.empty() ? area.y : corners.back().second);
      corners.emplace_back(x_(p->ms), y_(percent(*p)));
    }
    if (!corners.empty()) corners.emplace_back(right, corners.back().second);
    return corners;
  }

  void draw_front(const std::string& backend) {
    cairo_t* cairo = canvas_.cairo();
    dashes(backend);
    cairo_new_path(cairo);
    for (const auto& [x, y] : front(backend)) cairo_line_to(cairo, x, y);
    cairo_set_source_rgb(cairo, 0.45, 0.45, 0.45);
    cairo_set_line_width(cairo, 1.3);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, nullptr, 0, 0);
  }

  void dashes(const std::string& backend) {
    const double dash[] = {5, 3};
    cairo_set_dash(canvas_.cairo(), dash, backend == "gl" ? 2 : 0, 0);
  }

  Colour colour_of(const std::string& technique) const {
    const auto at = std::find(techniques_.begin(), techniques_.end(), technique) - techniques_.begin();
    return colours[static_cast<std::size_t>(at) % std::size(colours)];
  }

  void marker(const Point& p) {
    canvas_.marker(x_(p.ms), y_(percent(p)), p.on_front ? 4.6 : 3.2, p.configuration.backend == "gl", p.on_front,
                   colour_of(p.configuration.technique));
  }

  // Only knobs with more than one value among the technique's points tell them apart.
  std::string label_of(const Point& p) const {
    std::string text;
    for (const auto& knob : p.configuration.knobs) {
      const bool differs = std::any_of(m_.points.begin(), m_.points.end(), [&](const Point& other) {
        const Configuration& c = other.configuration;
        return c.technique == p.configuration.technique && std::find(c.knobs.begin(), c.knobs.end(), knob) == c.knobs.end();
      });
      if (differs) text += (text.empty() ? "" : ", ") + knob.first + " " + knob.second;
    }
    return text;
  }

  void labels() {
    std::vector<Label> wanted;
    std::vector<std::string> texts;
    std::vector<Box> taken;
    for (const Point* p : shown_) {
      const double x = x_(p->ms), y = y_(percent(*p)), r = p->on_front ? 5.5 : 4;
      taken.push_back({x - r, y - r, 2 * r, 2 * r});
      if (!p->on_front) continue;
      texts.push_back(label_of(*p));
      wanted.push_back({x, y, canvas_.text_width(texts.back(), label_size) + 4, label_size + 2});
    }
    for (const auto& device : m_.devices) {
      const std::vector<std::pair<double, double>> corners = front(device.first);
      for (std::size_t i = 1; i < corners.size(); ++i) {
        const auto& [x0, y0] = corners[i - 1];
        const auto& [x1, y1] = corners[i];
        taken.push_back({std::min(x0, x1), std::min(y0, y1), std::fabs(x1 - x0) + 1, std::fabs(y1 - y0) + 1});
      }
    }
    taken.push_back({right + 4, 0, width, area.y + legend_height()});
    // They may stand beyond the axes, below the legend.
    const std::vector<std::optional<Box>> boxes = placed(wanted, taken, {area.x, area.y, width - area.x - 6, area.height});
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!boxes[i] || texts[i].empty()) continue;
      const Box& b = *boxes[i];
      const double x = std::clamp(wanted[i].x, b.x, b.x + b.width), y = std::clamp(wanted[i].y, b.y, b.y + b.height);
      const double apart = std::hypot(x - wanted[i].x, y - wanted[i].y);
      if (apart > 14) canvas_.line(wanted[i].x, wanted[i].y, x, y, grey(0.6), 0.7);
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!boxes[i]) continue;
      canvas_.text(boxes[i]->x + 2, boxes[i]->y + label_size, texts[i], label_size, grey(0.2));
    }
  }

  double legend_height() const { return 21.0 * static_cast<double>(techniques_.size() + 2 * m_.devices.size() + 1) + 24; }

  void legend() {
    const double x = right + 22;
    double y = area.y + 8;
    for (const std::string& t : techniques_) {
      canvas_.box(x - 6, y - 6, 12, 12, colour_of(t));
      canvas_.text(x + 16, y + 4, t, 12, grey(0.15));
      y += 21;
    }
    y += 8;
    for (const auto& device : m_.devices) {
      const std::string& backend = device.first;
      canvas_.marker(x, y, 4.6, backend == "gl", true, grey(0.35));
      canvas_.text(x + 16, y + 4, backend, 12, grey(0.15));
      y += 21;
      dashes(backend);
      canvas_.line(x - 10, y, x + 10, y, grey(0.45), 1.3);
      cairo_set_dash(canvas_.cairo(), nullptr, 0, 0);
      canvas_.text(x + 16, y + 4, "front, " + backend, 12, grey(0.15));
      y += 21;
    }
    y += 8;
    canvas_.marker(x, y, 3.2, false, false, grey(0.35));
    canvas_.text(x + 16, y + 4, "beaten by another", 12, grey(0.15));
  }

  Canvas canvas_;
  const Measurement& m_;
  const Origin& origin_;
  std::vector<std::string> techniques_;
  std::vector<const Point*> shown_;  // timed, the fastest first
  LogAxis x_{1, 1000, area.x, right}, y_{0.1, 100, bottom, area.y};
};

cairo_status_t append(void* text, const unsigned char* bytes, unsigned size) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), size);
  return CAIRO_STATUS_SUCCESS;
}

void draw_on(cairo_surface_t* surface, double scale, const Measurement& m, const Origin& origin) {
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo(cairo_create(surface), cairo_destroy);
  cairo_scale(cairo.get(), scale, scale);
  Drawing(cairo.get(), m, origin).draw();
  if (const cairo_status_t status = cairo_status(cairo.get()); status != CAIRO_STATUS_SUCCESS) {
    throw MachineError(std::string("the figure cannot be drawn: ") + cairo_status_to_string(status));
  }
}

}  // namespace

Figure figure_of(const Measurement& m, const Origin& origin) {
  using Owned = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
  Figure figure;
  {
    const Owned svg(cairo_svg_surface_create_for_stream(append, &figure.svg, width, height), cairo_surface_destroy);
    draw_on(svg.get(), 1, m, origin);
    cairo_surface_finish(svg.get());
  }
  // Cairo numbers its surfaces through the whole process; nothing refers to that number.
  const std::string name = "id=\"surface";
  if (const std::size_t at = figure.svg.find(name); at != std::string::npos) {
    const std::size_t first = at + name.size();
    figure.svg.erase(first, figure.svg.find('"', first) - first);
  }
  constexpr double scale = 1.5;
  const Owned png(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(scale * width), static_cast<int>(scale * height)),
      cairo_surface_destroy);
  draw_on(png.get(), scale, m, origin);
  if (cairo_surface_write_to_png_stream(png.get(), append, &figure.png) != CAIRO_STATUS_SUCCESS) {
    throw MachineError("the figure cannot be encoded as PNG");
  }
  return figure;
}

}  // namespace airlight
