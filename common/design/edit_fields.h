// The keys of each edit, told once: for reading, for writing, and for what a misspelt one may have been.
//
// A visitor has value(key, member, Range), list(key, member, Range), plane, puff, rectangle, text, settings and seed; where the
// member is a std::optional, or required is false, the key may be missing.
#pragma once

#include <string_view>

#include "common/design/edits.h"
#include "common/scene/limits.h"

namespace airlight::edit_fields {

inline constexpr bool required = true;
inline constexpr Range rate{0, 1e6, "1/s", true}, seconds{0, 1e5, "s", true}, time{0, 1e5, "s"}, speed{-1e6, 1e6, "m/s"},
    largest_speed{0, 1e6, "m/s"}, acceleration{-1e6, 1e6, "m/s^2"}, drag{0, 1e6, "1/s"}, diffusion{0, 1e6, "m^2/s"},
    step{1e-6, 1e6, "m"}, distance{0, 1e6, "m"}, screen{-1e6, 1e6, "half heights"};

template <class V>
void visit(V& v, Stroke& s) {
  v.list("screen", s.screen, screen);
  v.plane("plane", s.plane);
  v.list("points", s.points, limits::coordinate);
}

template <class V>
void visit(V& v, Puff& p) {
  v.value("radius", p.radius, limits::radius);
  v.value("extinction", p.extinction, limits::extinction);
  v.value("albedo", p.albedo, limits::fraction);
  v.value("emission", p.emission, limits::emission);
}

template <class V>
void visit(V& v, ScreenRectangle& r) {
  v.value("from", r.from, screen, required);
  v.value("to", r.to, screen, required);
}

template <class V>
void visit(V& v, PaintEdit& e) {
  visit(v, e.stroke);
  visit(v, e.puff);
  v.value("spacing", e.spacing, step);
  v.value("scatter", e.scatter, distance);
  v.seed("seed", e.seed);
}

template <class V>
void visit(V& v, AirbrushEdit& e) {
  v.list("points", e.points, limits::coordinate, required);
  visit(v, e.puff);
  v.value("rate", e.rate, rate);
  v.value("seconds", e.seconds, seconds, required);
  v.value("velocity", e.velocity, speed);
  v.value("spread", e.spread, largest_speed);
  v.value("acceleration", e.acceleration, acceleration);
  v.value("drag", e.drag, drag);
  v.value("diffusion", e.diffusion, diffusion);
  v.value("bounce", e.bounce, limits::fraction);
  v.seed("seed", e.seed);
}

template <class V>
void visit(V& v, EraseEdit& e) {
  visit(v, e.stroke);
  v.value("radius", e.radius, limits::length);
  v.value("amount", e.amount, limits::extinction);
}

template <class V>
void visit(V& v, EmitEdit& e) {
  v.value("position", e.position, limits::coordinate, required);
  visit(v, e.puff);
  v.value("rate", e.rate, rate);
  v.value("lifetime", e.lifetime, seconds);
  v.value("time", e.time, time);
  v.value("velocity", e.velocity, speed);
  v.value("spread", e.spread, largest_speed);
  v.value("acceleration", e.acceleration, acceleration);
  v.seed("seed", e.seed);
}

template <class V>
void visit(V& v, CopyEdit& e) {
  visit(v, e.rectangle);
}

template <class V>
void visit(V& v, PasteEdit& e) {
  v.value("offset", e.offset, limits::coordinate, required);
}

template <class V>
void visit(V& v, MoveEdit& e) {
  visit(v, e.rectangle);
  v.value("offset", e.offset, limits::coordinate, required);
}

template <class V>
void visit(V& v, LightEdit& e) {
  v.light("light", e.light);
  v.value("position", e.position, limits::coordinate);
  v.value("direction", e.direction, limits::component);
  v.value("power", e.power, limits::intensity);
}

template <class V>
void visit(V& v, FogEdit& e) {
  v.value("extinction", e.extinction, limits::extinction, required);
}

template <class V>
void visit(V& v, CameraEdit& e) {
  v.value("position", e.position, limits::coordinate);
  v.value("look_at", e.look_at, limits::coordinate);
  v.value("up", e.up, limits::component);
  v.value("vertical_fov", e.vertical_fov, limits::field_of_view);
}

template <class V>
void visit(V& v, TechniqueEdit& e) {
  v.text("name", e.name);
  v.settings("settings", e.settings);
}

template <class V>
void visit(V&, UndoEdit&) {}
template <class V>
void visit(V&, RedoEdit&) {}

}  // namespace airlight::edit_fields
