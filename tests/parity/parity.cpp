// CPU against GL: every case on both backends, the difference printed also when it is small.
#include <gtest/gtest.h>

#include <cstdio>

#include "cpu/backend.h"
#include "gpu/backend.h"
#include "tests/parity/case.h"
#include "tests/parity/compare.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

class Parity : public testing::TestWithParam<NamedCase> {};
class ParityInParts : public Parity {};

std::string gtest_name(const testing::TestParamInfo<NamedCase>& info) {
  std::string name(info.param.name);
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

void cpu_equals_gl(const NamedCase& named, Extent extent) {
  const Case c = named.make(extent);
  CpuBackend cpu({});
  const std::unique_ptr<Backend> gl = make_gl_backend({});
  std::printf("%s against %s\n", cpu.describe().c_str(), gl->describe().c_str());
  NoProgress progress;
  Stats stats;
  for (Backend* backend : {static_cast<Backend*>(&cpu), gl.get()}) {
    upload(*backend, c);
    backend->run(c.steps, stats, progress);
  }
  // Only rasterised surfaces have edges at which the two may choose another triangle.
  std::vector<bool> edges;
  for (const auto& [name, result] : c.results) {
    if (name == "distance" || name == "depth") edges = edges_of(shape_of_result(result).extent, download(cpu, result));
  }
  const double share = edges.empty() ? 0 : tolerance("parity_edge_share");
  for (const auto& [name, result] : c.results) {
    const Difference d = difference(shape_of_result(result), download(cpu, result), download(*gl, result), edges);
    std::printf("%s %s: %s\n", std::string(named.name).c_str(), name.c_str(), d.text().c_str());
    ASSERT_TRUE(d.finite) << name;
    EXPECT_LE(d.share, share) << name;
    const bool tiny = named.name == "surface_visibility/torus_1M" && name == "normal";
    const bool sampled = named.name == "frame/half_airlight" || named.name == "frame/quarter_of_a_march";
    const double inside = tiny ? tolerance("parity_off_edges") : sampled ? tolerance("parity_sampled") : 0;
    EXPECT_LE(d.share_inside, inside) << name;
  }
}

TEST_P(Parity, CpuEqualsGl) { cpu_equals_gl(GetParam(), {160, 120}); }
TEST_P(ParityInParts, CpuEqualsGl) { cpu_equals_gl(GetParam(), {32, 24}); }

INSTANTIATE_TEST_SUITE_P(Cases, ParityInParts, testing::ValuesIn(long_cases()), gtest_name);
INSTANTIATE_TEST_SUITE_P(Cases, Parity, testing::ValuesIn(all_cases()), gtest_name);

}  // namespace

}  // namespace airlight
