#include "bench/pareto/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace airlight {

namespace {

// Names of all swept knobs in the order of their first use.
std::vector<std::string> knob_names(const Measurement& m) {
  std::vector<std::string> names;
  for (const Point& p : m.points) {
    for (const auto& knob : p.configuration.knobs) {
      if (std::find(names.begin(), names.end(), knob.first) == names.end()) names.push_back(knob.first);
    }
  }
  return names;
}

std::string value_of(const Settings& knobs, const std::string& name) {
  for (const auto& [known, value] : knobs) {
    if (known == name) return value;
  }
  return {};
}

std::string csv_time(double ms) { return ms > 0 ? fmt::format("{:.5g}", ms) : std::string(); }

// JSON has no infinity.
std::string json_number(double v, bool there = true) { return there && std::isfinite(v) ? fmt::format("{:.6g}", v) : "null"; }

std::string json_object(const auto& pairs) {
  std::string text;
  for (const auto& [name, value] : pairs) text += (text.empty() ? " " : ", ") + json_string(name) + ": " + json_string(value);
  return "{" + text + " }";
}

std::string json_extent(Extent e) { return fmt::format("[{}, {}]", e.width, e.height); }

std::string json_point(const Point& p) {
  return fmt::format(
      "{{ \"technique\": {}, \"backend\": {}, \"knobs\": {}, \"error\": {}, \"error_off_edges\": {}, \"ms\": {}, "
      "\"small_ms\": {}, \"on_front\": {} }}",
      json_string(p.configuration.technique), json_string(p.configuration.backend), json_object(p.configuration.knobs),
      json_number(p.error.everywhere), json_number(p.error.off_edges), json_number(p.ms, p.ms > 0), json_number(p.small_ms),
      p.on_front);
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string json_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04x}", c);
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string csv_of(const Measurement& m, const Origin& origin) {
  const std::vector<std::string> knobs = knob_names(m);
  std::string text = "scene,technique,backend,";
  for (const std::string& name : knobs) text += csv_field(name) + ",";
  text += "error,error_off_edges,ms,small_ms,on_front\n";
  for (const Point& p : m.points) {
    const Configuration& c = p.configuration;
    text += fmt::format("{},{},{},", csv_field(origin.scene), csv_field(c.technique), csv_field(c.backend));
    for (const std::string& name : knobs) text += csv_field(value_of(c.knobs, name)) + ",";
    text += fmt::format("{:.6g},{:.6g},{},{},{}\n", p.error.everywhere, p.error.off_edges, csv_time(p.ms), csv_time(p.small_ms),
                        p.on_front ? 1 : 0);
  }
  return text;
}

std::string json_of(const Measurement& m, const Origin& o) {
  std::string left_out, points;
  for (const std::string& l : m.left_out) left_out += (left_out.empty() ? "" : ", ") + json_string(l);
  for (const Point& p : m.points) points += (points.empty() ? "\n    " : ",\n    ") + json_point(p);
  return fmt::format(
      "{{\n  \"scene\": {},\n  \"resolution\": {}, \"truth_resolution\": {}, \"truth\": {},\n  \"version\": {}, \"commit\": {},\n"
      "  \"machine\": {}, \"compiler\": {},\n  \"devices\": {},\n  \"left_out\": [{}],\n  \"points\": [{}\n  ]\n}}\n",
      json_string(o.scene), json_extent(o.extent), json_extent(o.truth_extent), json_object(o.truth_knobs),
      json_string(o.version), json_string(o.commit), json_string(o.machine), json_string(o.compiler), json_object(m.devices),
      left_out, points);
}

}  // namespace airlight
