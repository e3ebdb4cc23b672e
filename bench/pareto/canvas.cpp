#include "bench/pareto/canvas.h"

#include <numbers>

namespace airlight {

namespace {

constexpr const char* family = "DejaVu Sans";  // fontconfig takes another where there is none

void select(cairo_t* cairo, double size, bool bold) {
  cairo_select_font_face(cairo, family, CAIRO_FONT_SLANT_NORMAL, bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
}

}  // namespace

Canvas::Canvas(cairo_t* cairo) : cairo_(cairo) {
  // Widths that do not depend on the surface: labels stand at the same places in both files.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
}

void Canvas::set(const Colour& k) { cairo_set_source_rgb(cairo_, k.r, k.g, k.b); }

void Canvas::line(double x0, double y0, double x1, double y1, const Colour& colour, double line_width) {
  set(colour);
  cairo_set_line_width(cairo_, line_width);
  cairo_move_to(cairo_, x0, y0);
  cairo_line_to(cairo_, x1, y1);
  cairo_stroke(cairo_);
}

void Canvas::box(double x, double y, double width, double height, const Colour& fill) {
  set(fill);
  cairo_rectangle(cairo_, x, y, width, height);
  cairo_fill(cairo_);
}

void Canvas::marker(double x, double y, double radius, bool square, bool filled, const Colour& colour) {
  cairo_new_path(cairo_);
  if (square) {
    const double half = radius * 0.9;  // about the area of the disc
    cairo_rectangle(cairo_, x - half, y - half, 2 * half, 2 * half);
  } else {
    cairo_arc(cairo_, x, y, radius, 0, 2 * std::numbers::pi);
  }
  set(filled ? colour : grey(1));
  cairo_fill_preserve(cairo_);
  set(colour);
  cairo_set_line_width(cairo_, 1.4);
  cairo_stroke(cairo_);
}

double Canvas::text_width(const std::string& s, double size) {
  select(cairo_, size, false);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, s.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(double x, double y, const std::string& s, double size, const Colour& colour, double align, bool bold) {
  select(cairo_, size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, s.c_str(), &extents);
  set(colour);
  cairo_move_to(cairo_, x - align * extents.x_advance, y);
  cairo_show_text(cairo_, s.c_str());
}

void Canvas::upward_text(double x, double y, const std::string& s, double size, const Colour& colour) {
  cairo_save(cairo_);
  cairo_translate(cairo_, x, y);
  cairo_rotate(cairo_, -std::numbers::pi / 2);
  text(0, 0, s, size, colour, 0.5);
  cairo_restore(cairo_);
}

}  // namespace airlight
