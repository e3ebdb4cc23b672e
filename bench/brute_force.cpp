#include "bench/brute_force.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "common/error.h"
#include "common/formulas/float.h"
#include "common/plan/geometry.h"

namespace airlight {

namespace {

constexpr int packet = 16, side = 4;  // rays of 4 x 4 pixels together

struct Release {
  void operator()(RTCDeviceTy* d) const { rtcReleaseDevice(d); }
  void operator()(RTCSceneTy* s) const { rtcReleaseScene(s); }
};
using Tree = std::unique_ptr<RTCSceneTy, Release>;

// The surfaces, those that cast shadows alone or all; number i of the scene has the ID i.
Tree tree_of(RTCDevice device, const Scene& scene, bool casters_alone) {
  Tree tree(rtcNewScene(device));
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& s = scene.surfaces[i];
    if ((casters_alone && !s.casts_shadow) || s.mesh->triangles.empty()) continue;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* places = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                   sizeof(glm::vec3), s.mesh->positions.size()));
    for (const glm::vec3& p : s.mesh->positions)
      *places++ = glm::vec3(glm::dvec3(s.transform * glm::dvec4(glm::dvec3(p), 1.0)) - scene.camera.position);
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                            s.mesh->triangles.size());
    std::memcpy(indices, s.mesh->triangles.data(), s.mesh->triangles.size() * sizeof(glm::uvec3));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree.get(), geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(tree.get());
  return tree;
}

// The rays of a packet on their way, an array a coordinate, so that compilers make vectors of them.
struct Packet {
  alignas(64) int valid[packet];
  alignas(64) float x[packet], y[packet], z[packet], length[packet];
  alignas(64) float sum[3][packet];
};

}  // namespace

struct BruteForce::State {
  const Scene& scene;
  int threads;
  std::unique_ptr<RTCDeviceTy, Release> device;
  Tree all, casters;
  std::vector<Light> lights;
  std::vector<glm::mat3> normal_matrices;
  float extinction, sky;

  explicit State(const Scene& s, int n) : scene(s), threads(n), device(rtcNewDevice(nullptr)) {
    if (!device) throw MachineError("Embree does not start");
    all = tree_of(device.get(), scene, false);
    casters = tree_of(device.get(), scene, true);
    lights = lights_of(scene);
    for (const Surface& one : scene.surfaces)
      normal_matrices.emplace_back(glm::transpose(glm::inverse(glm::dmat3(one.transform))));
    extinction = static_cast<float>(scene.medium.extinction);
    double far_away = extinction > 0 ? 12 / scene.medium.extinction : 0, lamp = 0;
    for (const Light& l : lights) {
      if (!l.directional) lamp = std::max(lamp, static_cast<double>(glm::length(l.vector)));
    }
    sky = static_cast<float>(std::min(scene.sky_distance, far_away + lamp));
  }

  // The ways from places t along the rays to a light.
  void shadow(const Packet& p, const float* t, const Light& light, RTCRay16& ray) const {
    for (int i = 0; i < packet; ++i) {
      ray.org_x[i] = p.x[i] * t[i], ray.org_y[i] = p.y[i] * t[i], ray.org_z[i] = p.z[i] * t[i];
      glm::vec3 way = -light.vector;
      float length = 1e30F;
      if (!light.directional) {
        way = light.vector - glm::vec3(ray.org_x[i], ray.org_y[i], ray.org_z[i]);
        length = std::max(glm::length(way), 1e-18F);
        way = way * (1 / length);
      }
      ray.dir_x[i] = way.x, ray.dir_y[i] = way.y, ray.dir_z[i] = way.z;
      ray.tnear[i] = 1e-4F * (1 + t[i]);
      ray.tfar[i] = length;
      ray.time[i] = 0, ray.mask[i] = ~0U, ray.id[i] = 0, ray.flags[i] = 0;
    }
  }
  void pixels(const View&, int x, int y, int steps, HostImage&) const;
  void surfaces(const RTCRayHit16&, Packet&) const;
};

void BruteForce::State::surfaces(const RTCRayHit16& hit, Packet& p) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRay16 ray;
  for (const Light& light : lights) {
    float t[packet];
    for (int i = 0; i < packet; ++i) t[i] = p.length[i];
    shadow(p, t, light, ray);
    float length[packet];
    for (int i = 0; i < packet; ++i) length[i] = ray.tfar[i];
    rtcOccluded16(p.valid, casters.get(), &context, &ray);
    for (int i = 0; i < packet; ++i) {
      if (p.valid[i] == 0 || hit.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID || ray.tfar[i] < 0) continue;
      const Surface& s = scene.surfaces[hit.hit.geomID[i]];
      const glm::uvec3 triangle = s.mesh->triangles[hit.hit.primID[i]];
      const float u = hit.hit.u[i], v = hit.hit.v[i];
      const glm::vec3 d(p.x[i], p.y[i], p.z[i]), way(ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]);
      const glm::mat3& turn = normal_matrices[hit.hit.geomID[i]];
      const glm::vec3 na = glm::normalize(turn * s.mesh->normals[triangle.x]),
                      nb = glm::normalize(turn * s.mesh->normals[triangle.y]),
                      nc = glm::normalize(turn * s.mesh->normals[triangle.z]);
      f32::Float nx, ny, nz;
      f32::shading_normal(d.x, d.y, d.z, na.x, na.y, na.z, nb.x, nb.y, nb.z, nc.x, nc.y, nc.z, u, v, nx, ny, nz);
      const glm::vec3 n(nx.v, ny.v, nz.v), flat(hit.hit.Ng_x[i], hit.hit.Ng_y[i], hit.hit.Ng_z[i]);
      // Light that falls on the other side does not come through.
      if (s.casts_shadow && (glm::dot(flat, d) > 0) == (glm::dot(flat, way) > 0)) continue;
      const glm::vec3 mirror = d - 2 * glm::dot(n, d) * n;
      const float cosine = glm::dot(n, way);
      f32::Float irradiance = light.directional ? f32::Float(1.0F) : f32::point_irradiance(length[i], light.radius, extinction);
      irradiance *= f32::transmittance(extinction * p.length[i]);
      const f32::Float diffuse = f32::lambert(cosine) * irradiance;
      const f32::Float apart = f32::unit_distance(mirror.x, mirror.y, mirror.z, way.x, way.y, way.z);
      const f32::Float specular = f32::phong(cosine, apart, s.material.shininess) * irradiance;
      for (int c = 0; c < 3; ++c)
        p.sum[c][i] += light.power[c] * (s.material.diffuse[c] * diffuse.v + s.material.specular[c] * specular.v);
    }
  }
}

void BruteForce::State::pixels(const View& view, int x, int y, int steps, HostImage& image) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const int width = view.extent.width, height = view.extent.height;
  Packet p;
  RTCRayHit16 hit;
  for (int i = 0; i < packet; ++i) {
    const int column = x + i % side, row = y + i / side;
    p.valid[i] = column < width && row < height ? -1 : 0;
    const float across = (2 * (static_cast<float>(column) + 0.5F) / static_cast<float>(width) - 1) * view.tan_half_fov *
                         static_cast<float>(width) / static_cast<float>(height);
    const float up = (1 - 2 * (static_cast<float>(row) + 0.5F) / static_cast<float>(height)) * view.tan_half_fov;
    const glm::vec3 d = glm::normalize(across * view.right + up * view.up + view.forward);
    p.x[i] = d.x, p.y[i] = d.y, p.z[i] = d.z;
    hit.ray.org_x[i] = hit.ray.org_y[i] = hit.ray.org_z[i] = 0;
    hit.ray.dir_x[i] = d.x, hit.ray.dir_y[i] = d.y, hit.ray.dir_z[i] = d.z;
    hit.ray.tnear[i] = 0, hit.ray.tfar[i] = INFINITY, hit.ray.time[i] = 0, hit.ray.mask[i] = ~0U, hit.ray.flags[i] = 0;
    hit.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    for (auto& sum : p.sum) sum[i] = 0;
  }
  rtcIntersect16(p.valid, all.get(), &context, &hit);
  const Medium& medium = scene.medium;
  for (int i = 0; i < packet; ++i) {
    const bool met = hit.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    p.length[i] = met ? hit.ray.tfar[i] : sky;
    const float length = met ? p.length[i] : static_cast<float>(std::min(scene.sky_distance, 1e30));
    const f32::Float tau = f32::optical_depth(length, extinction), through = f32::transmittance(tau);
    for (int c = 0; c < 3; ++c) {
      const auto ambient = extinction > 0 ? static_cast<float>(medium.ambient[c]) : 0.0F;
      p.sum[c][i] =
          f32::opacity(tau).v * ambient + through.v * (met ? scene.surfaces[hit.hit.geomID[i]].material.diffuse[c] * ambient
                                                           : static_cast<float>(scene.background[c]));
    }
  }
  surfaces(hit, p);
  if (extinction > 0) {
    const int kind = static_cast<int>(medium.phase.kind);
    const auto g = static_cast<float>(medium.phase.g);
    RTCRay16 ray;
    alignas(64) float t[packet], length[packet];
    for (int step = 0; step < steps; ++step) {
      for (int i = 0; i < packet; ++i) t[i] = p.length[i] * ((static_cast<float>(step) + 0.5F) / static_cast<float>(steps));
      for (const Light& light : lights) {
        shadow(p, t, light, ray);
        for (int i = 0; i < packet; ++i) ray.tnear[i] = 0, length[i] = ray.tfar[i];
        rtcOccluded16(p.valid, casters.get(), &context, &ray);
        for (int i = 0; i < packet; ++i) {
          const float mu = p.x[i] * ray.dir_x[i] + p.y[i] * ray.dir_y[i] + p.z[i] * ray.dir_z[i];
          const float r = std::max(length[i], light.radius);
          const float weight = light.directional ? 1 : 1 / (r * r), way = light.directional ? 0 : length[i];
          const f32::Float once = f32::phase_value(kind, g, mu) * f32::transmittance(extinction * (t[i] + way));
          const float value = ray.tfar[i] < 0 ? 0 : once.v * weight * extinction * p.length[i] / static_cast<float>(steps);
          for (int c = 0; c < 3; ++c) p.sum[c][i] += value * light.power[c] * static_cast<float>(medium.albedo[c]);
        }
      }
    }
  }
  for (int i = 0; i < packet; ++i) {
    if (p.valid[i] == 0) continue;
    for (int c = 0; c < 3; ++c) image.at(x + i % side, y + i / side, c) = p.sum[c][i];
  }
}

BruteForce::BruteForce(const Scene& scene, int threads) {
  if (!scene.medium.gaussians.empty() || scene.medium.grid) throw InputError("brute force: the medium is not homogeneous");
  state_ = std::make_unique<State>(scene, threads);
}
BruteForce::~BruteForce() = default;

HostImage BruteForce::render(Extent extent, int steps) const {
  const State& s = *state_;
  FrameRequest request;
  request.extent = extent;
  const View view = view_of(s.scene, request);
  HostImage image(extent, 3);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(s.threads));
  tbb::parallel_for(tbb::blocked_range<int>(0, (extent.height + side - 1) / side), [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row < rows.end(); ++row) {
      for (int x = 0; x < extent.width; x += side) s.pixels(view, x, row * side, steps, image);
    }
  });
  return image;
}

}  // namespace airlight
