#include <gtest/gtest.h>

#include <limits>

#include "bench/pareto/files.h"

namespace airlight {
namespace {

Measurement two_points() {
  Measurement m;
  m.devices = {{"cpu", "cpu, one"}};
  m.left_out = {"gl: \"none\""};
  Point p;
  p.configuration = {"marching", "cpu", {{"steps", "4"}}};
  p.ms = 12.5, p.small_ms = 0.5, p.error = {0.1, 0.05}, p.on_front = true;
  m.points.push_back(p);
  p.configuration = {"other, too", "cpu", {{"nodes", "8"}, {"steps", "2"}}};
  p.ms = 0, p.error.everywhere = std::numeric_limits<double>::infinity(), p.on_front = false;
  m.points.push_back(p);
  return m;
}

Origin somewhere() { return {"a, \"b\"", {8, 6}, {4, 3}, {{"tolerance", "1e-6"}}, "1", "c", "g++", "m"}; }

TEST(Files, CsvHasAColumnAKnob) {
  EXPECT_EQ(csv_of(two_points(), somewhere()),
            "scene,technique,backend,steps,nodes,error,error_off_edges,ms,small_ms,on_front\n"
            "\"a, \"\"b\"\"\",marching,cpu,4,,0.1,0.05,12.5,0.5,1\n"
            "\"a, \"\"b\"\"\",\"other, too\",cpu,2,8,inf,0.05,,0.5,0\n");
}

TEST(Files, JsonSaysWhereItComesFrom) {
  EXPECT_EQ(json_of(two_points(), somewhere()), R"({
  "scene": "a, \"b\"",
  "resolution": [8, 6], "truth_resolution": [4, 3], "truth": { "tolerance": "1e-6" },
  "version": "1", "commit": "c",
  "machine": "m", "compiler": "g++",
  "devices": { "cpu": "cpu, one" },
  "left_out": ["gl: \"none\""],
  "points": [
    { "technique": "marching", "backend": "cpu", "knobs": { "steps": "4" }, "error": 0.1, "error_off_edges": 0.05, "ms": 12.5, "small_ms": 0.5, "on_front": true },
    { "technique": "other, too", "backend": "cpu", "knobs": { "nodes": "8", "steps": "2" }, "error": null, "error_off_edges": 0.05, "ms": null, "small_ms": 0.5, "on_front": false }
  ]
}
)");
}

TEST(Files, TextsAreEscaped) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a\nb\""), "\"a\nb\"\"\"");
  EXPECT_EQ(json_string("a\"b\\c\n\x01\xc3\xa4"), "\"a\\\"b\\\\c\\u000a\\u0001\xc3\xa4\"");
}

TEST(Files, OriginNamesNoHostAndNoDate) {
  Origin a, b;
  add_machine(a), add_machine(b);
  EXPECT_EQ(a.machine + a.compiler + a.commit + a.version, b.machine + b.compiler + b.commit + b.version);
  for (const std::string& part : {a.machine, a.compiler, a.commit, a.version}) EXPECT_FALSE(part.empty());
}

}  // namespace
}  // namespace airlight
