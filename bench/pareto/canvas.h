// The strokes and texts that a figure is made of, on any cairo surface.
#pragma once

#include <cairo.h>

#include <string>

namespace airlight {

struct Colour {
  double r = 0, g = 0, b = 0;
};
constexpr Colour grey(double v) { return {v, v, v}; }

// Does not own the context.
class Canvas {
 public:
  explicit Canvas(cairo_t*);

  void line(double x0, double y0, double x1, double y1, const Colour&, double line_width);
  void box(double x, double y, double width, double height, const Colour& fill);
  // A disc, or a square, of a backend's points; hollow ones are white inside.
  void marker(double x, double y, double radius, bool square, bool filled, const Colour&);
  // Its base line begins, has its middle or ends at x for align = 0, 1/2, 1.
  void text(double x, double y, const std::string&, double size, const Colour&, double align = 0, bool bold = false);
  double text_width(const std::string&, double size);
  // As text(), reading upwards, about its middle.
  void upward_text(double x, double y, const std::string&, double size, const Colour&);

  cairo_t* cairo() const { return cairo_; }

 private:
  void set(const Colour&);

  cairo_t* cairo_;
};

}  // namespace airlight
