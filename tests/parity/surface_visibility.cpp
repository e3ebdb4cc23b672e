#include "common/plan/geometry.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Case visibility(const Scene& scene, Extent extent, bool with_corners = false) {
  Case c;
  FrameRequest request;
  request.extent = extent;
  const Geometry g = geometry_of(scene, 1);
  for (const Plan::Upload* upload : {&g.positions, &g.normals, &g.indices}) {
    c.buffers.emplace_back(upload->buffer, upload->make());
  }
  const Image distance{{4}, Format::r32f, extent, 1, true}, normal{{5}, Format::rgb32f, extent, 1, true},
      material{{6}, Format::r32f, extent, 1, true}, corners{{7}, Format::rgb32f, extent, 1, true};
  c.steps = {{SurfaceVisibility{.positions = g.positions.buffer,
                                .normals = g.normals.buffer,
                                .triangles = g.indices.buffer,
                                .view = view_of(scene, request),
                                .distance = distance,
                                .normal = normal,
                                .material = material,
                                .corners = with_corners ? corners : Image{}},
              ""}};
  c.results = {{"distance", distance}, {"normal", normal}, {"material", material}};
  if (with_corners) c.results.emplace_back("corners", corners);
  return c;
}

Case torus(Extent e) { return visibility(test_scene(70000), e); }
Case coarse_torus(Extent e) { return visibility(test_scene(600), e); }

// Where two triangles meet the backends may choose either: few of them.
Case corners(Extent e) {
  Scene scene = test_scene(600);
  scene.surfaces.resize(1);
  scene.surfaces[0].mesh = square(2.5);
  return visibility(scene, e, true);
}

Case camera_in_torus(Extent e) {  // triangles cross the near plane on all sides
  Scene scene = test_scene(2000);
  scene.camera.position = {1.0, 0.02, 0.0};
  scene.camera.look_at = {1.0, 0.0, 1.0};
  return visibility(scene, e);
}

Case nothing(Extent e) {
  Scene scene = test_scene(600);
  scene.surfaces.clear();
  return visibility(scene, e);
}

Case many_triangles(Extent e) { return visibility(test_scene(1000000), e); }

}  // namespace

std::span<const NamedCase> surface_visibility_cases() {
  static constexpr NamedCase cases[] = {
      {"surface_visibility/torus_70k", torus}, {"surface_visibility/torus_600", coarse_torus},
      {"surface_visibility/corners", corners}, {"surface_visibility/camera_in_torus", camera_in_torus},
      {"surface_visibility/nothing", nothing}, {"surface_visibility/torus_1M", many_triangles}};
  return cases;
}

}  // namespace airlight
