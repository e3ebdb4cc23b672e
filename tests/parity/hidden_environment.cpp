#include "common/algorithms/hidden_environment.h"

#include "common/plan/brdf.h"
#include "common/plan/geometry.h"
#include "common/plan/hidden_environment.h"
#include "tests/parity/brdfs.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

enum class Hiding { some, nothing, everything };

// Records of any kind in turn: what a vertex may have, whatever stands around it.
SurfaceTransfer test_transfer(std::size_t vertices, Hiding hiding) {
  SurfaceTransfer t;
  for (std::uint32_t v = 0; v < 2 * vertices; ++v) {
    const bool some = hiding == Hiding::some && v % 5 > 1;
    if (!some) {
      const bool all = hiding == Hiding::everything || (hiding == Hiding::some && v % 35 == 0);
      t.record.push_back(all ? SurfaceTransfer::everything : SurfaceTransfer::nothing);
      continue;
    }
    t.record.push_back(static_cast<std::uint32_t>(t.records.size() / SurfaceTransfer::record_floats));
    for (std::uint32_t k = 0; k < SurfaceTransfer::record_floats; ++k) {
      const double first = k % 36 == 0 ? 0.5 : 0;
      t.records.push_back(static_cast<float>(first + 0.2 * uniform(190, v * 72 + k) - 0.1));
    }
  }
  return t;
}

Case hidden(Scene scene, Extent extent, Hiding hiding, bool glossy, const std::vector<std::shared_ptr<const Brdf>>& brdfs = {}) {
  Case c;
  FrameRequest request;
  request.extent = extent;
  scene.environment = Environment{nullptr, {0.4, 0.7, 1.2}, 0};
  for (Surface& s : scene.surfaces) s.material.specular = glm::vec3(glossy ? 0.3F : 0), s.material.shininess = 12;
  for (std::size_t k = 0; k < brdfs.size(); ++k) scene.surfaces[k].brdf = brdfs[k];
  const Geometry g = geometry_of(scene, 1);
  for (const Plan::Upload* upload : {&g.positions, &g.normals, &g.indices})
    c.buffers.emplace_back(upload->buffer, upload->make());
  const std::vector<float> table = hidden_environment_table(scene, test_transfer(g.vertices, hiding));
  const auto bytes = std::as_bytes(std::span(table));
  const Buffer buffer{{4}, bytes.size()};
  c.buffers.emplace_back(buffer, std::vector<std::byte>(bytes.begin(), bytes.end()));
  const View view = view_of(scene, request);
  const auto image = [&](std::uint32_t id, Format format, bool keep) { return Image{{id}, format, extent, 1, keep}; };
  const Image distance = image(5, Format::r32f, true), normal = image(6, Format::rgb32f, false),
              corners = image(8, Format::rgb32f, false), diffuse = image(9, Format::rgb32f, true),
              specular = glossy ? image(10, Format::rgb32f, true) : Image{};
  c.steps = {{SurfaceVisibility{.positions = g.positions.buffer,
                                .normals = g.normals.buffer,
                                .triangles = g.indices.buffer,
                                .view = view,
                                .distance = distance,
                                .normal = normal,
                                .material = image(7, Format::r32f, false),
                                .corners = corners},
              ""},
             {HiddenEnvironment{.normal = normal,
                                .corners = corners,
                                .triangles = g.indices.buffer,
                                .table = buffer,
                                .view = view,
                                .brdfs = static_cast<int>(brdfs_of(scene).all.size()),
                                .diffuse = diffuse,
                                .specular = specular},
              ""}};
  c.results = {{"distance", distance}, {"diffuse", diffuse}};
  if (glossy) c.results.emplace_back("specular", specular);
  return c;
}

Case matt(Extent e) { return hidden(test_scene(20000), e, Hiding::some, false); }
Case glossy(Extent e) { return hidden(test_scene(20000), e, Hiding::some, true); }
Case nothing(Extent e) { return hidden(test_scene(600), e, Hiding::nothing, true); }
Case everything(Extent e) { return hidden(test_scene(600), e, Hiding::everything, true); }
Case tabulated(Extent e) {
  return hidden(test_scene(2000), e, Hiding::some, true, {microfacet_table({24, 12, 12}, 0.3), microfacet_table({8, 8, 8}, 0.6)});
}
Case tabulated_and_glossy(Extent e) { return hidden(test_scene(600), e, Hiding::some, true, {microfacet_table({8, 8, 8}, 0.6)}); }
Case both_sides(Extent e) {  // the camera stands in the torus
  Scene scene = test_scene(2000);
  scene.camera.position = {1.0, 0.02, 0.0};
  scene.camera.look_at = {1.0, 0.0, 1.0};
  return hidden(scene, e, Hiding::some, true);
}

}  // namespace

std::span<const NamedCase> hidden_environment_cases() {
  static constexpr NamedCase cases[] = {{"hidden_environment/matt", matt},
                                        {"hidden_environment/glossy", glossy},
                                        {"hidden_environment/two_tabulated", tabulated},
                                        {"hidden_environment/tabulated_and_glossy", tabulated_and_glossy},
                                        {"hidden_environment/nothing", nothing},
                                        {"hidden_environment/everything", everything},
                                        {"hidden_environment/both_sides", both_sides}};
  return cases;
}

}  // namespace airlight
