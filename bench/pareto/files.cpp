#include "bench/pareto/files.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

#include "app/airlight.h"

namespace airlight {

namespace {

// A CSV field or a JSON string: both double or escape the quote.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string json_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + "\"";
}

}  // namespace

std::string machine_name() {
  std::ifstream info("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    name = line.substr(line.find(':') + 2);
    break;
  }
  return fmt::format("{}, {} cores", name, std::thread::hardware_concurrency());
}

std::string csv_of(const Measurement& m, const Origin& origin) {
  std::string text = "scene,technique,backend,knobs,error,error_off_edges,ms,small_ms,on_front\n";
  for (const Point& p : m.points) {
    const Configuration& c = p.configuration;
    text += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.4g},{:.4g},{}\n", csv_field(origin.scene), c.technique, c.backend,
                        csv_field(text_of(c.knobs)), p.error.everywhere, p.error.off_edges, p.ms, p.small_ms, p.on_front ? 1 : 0);
  }
  return text;
}

std::string json_of(const Measurement& m, const Origin& origin) {
  std::string devices, left_out, points;
  for (const std::string& d : m.devices) devices += (devices.empty() ? "" : ", ") + json_string(d);
  for (const std::string& l : m.left_out) left_out += (left_out.empty() ? "" : ", ") + json_string(l);
  for (const Point& p : m.points) {
    std::string knobs;
    for (const auto& [name, value] : p.configuration.knobs)
      knobs += (knobs.empty() ? "" : ", ") + json_string(name) + ": " + json_string(value);
    points += fmt::format(
        "{}\n    {{ \"technique\": {}, \"backend\": {}, \"knobs\": {{ {} }}, \"error\": {:.6g}, \"error_off_edges\": {:.6g}, "
        "\"ms\": {:.4g}, \"small_ms\": {:.4g}, \"on_front\": {} }}",
        points.empty() ? "" : ",", json_string(p.configuration.technique), json_string(p.configuration.backend), knobs,
        p.error.everywhere, p.error.off_edges, p.ms, p.small_ms, p.on_front);
  }
  return fmt::format(
      "{{\n  \"version\": {}, \"commit\": {}, \"machine\": {}, \"devices\": [{}],\n  \"scene\": {}, \"resolution\": [{}, {}], "
      "\"truth_resolution\": [{}, {}],\n  \"left_out\": [{}],\n  \"points\": [{}\n  ]\n}}\n",
      json_string(std::string(version())), json_string(origin.commit), json_string(origin.machine), devices,
      json_string(origin.scene), origin.extent.width, origin.extent.height, origin.truth_extent.width, origin.truth_extent.height,
      left_out, points);
}

}  // namespace airlight
