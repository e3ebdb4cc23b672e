#include "common/transfer/occluders.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "common/error.h"

namespace airlight {

namespace {

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  double diagonal() const { return glm::length(high - low); }
};

}  // namespace

struct Occluders::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

Occluders::~Occluders() = default;

Occluders::Occluders(const Scene& scene) : state_(std::make_unique<State>()) {
  State& s = *state_;
  std::vector<glm::dvec3> world;
  Box all;
  smallest_ = std::numeric_limits<double>::infinity();
  for (const Surface& surface : scene.surfaces) {
    if (!surface.casts_shadow || surface.mesh->triangles.empty()) continue;
    const auto first = static_cast<std::uint32_t>(world.size());
    Box box;
    for (const glm::vec3& p : surface.mesh->positions) {
      world.emplace_back(surface.transform * glm::dvec4(glm::dvec3(p), 1.0));
      box.add(world.back()), all.add(world.back());
    }
    for (const glm::uvec3& t : surface.mesh->triangles) s.triangles.push_back(first + t);
    if (box.diagonal() > 0) smallest_ = std::min(smallest_, box.diagonal());
  }
  middle_ = (all.low + all.high) / 2.0;
  resolution_ = 4e-7 * all.diagonal();
  for (const glm::dvec3& p : world) s.positions.emplace_back(p - middle_);

  s.device = rtcNewDevice(nullptr);
  if (!s.device) throw MachineError("Embree gives no device: error " + std::to_string(rtcGetDeviceError(nullptr)));
  s.scene = rtcNewScene(s.device);
  rtcSetSceneFlags(s.scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips between neighbours
  RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree reads 16 bytes of each vertex: copied into buffers of its own.
  auto* positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), s.positions.size()));
  auto* triangles = static_cast<glm::uvec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), s.triangles.size()));
  if (positions && triangles) {
    std::copy(s.positions.begin(), s.positions.end(), positions);
    std::copy(s.triangles.begin(), s.triangles.end(), triangles);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(s.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(s.scene);
  if (const RTCError error = rtcGetDeviceError(s.device); error != RTC_ERROR_NONE)
    throw MachineError("Embree cannot hold the surfaces: error " + std::to_string(error));
}

unsigned Occluders::hidden(const glm::dvec3& from, const glm::vec3* directions, unsigned count) const {
  const glm::vec3 origin(from - middle_);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(64) int valid[16];
  RTCRay16 rays;
  for (unsigned i = 0; i < 16; ++i) {
    const glm::vec3& d = directions[std::min(i, count - 1)];
    valid[i] = i < count ? -1 : 0;
    rays.org_x[i] = origin.x, rays.org_y[i] = origin.y, rays.org_z[i] = origin.z;
    rays.dir_x[i] = d.x, rays.dir_y[i] = d.y, rays.dir_z[i] = d.z;
    rays.tnear[i] = 0, rays.tfar[i] = std::numeric_limits<float>::infinity();
    rays.time[i] = 0, rays.mask[i] = 0xffffffffU, rays.id[i] = 0, rays.flags[i] = 0;
  }
  rtcOccluded16(valid, state_->scene, &context, &rays);
  unsigned bits = 0;
  for (unsigned i = 0; i < count; ++i) bits |= rays.tfar[i] < 0 ? 1U << i : 0U;
  return bits;
}

namespace {

struct Query {
  const std::vector<glm::vec3>* positions;
  const std::vector<glm::uvec3>* triangles;
  glm::vec3 place, normal;
  float beside;
  bool found = false;
};

bool meet(RTCPointQueryFunctionArguments* arguments) {
  auto& q = *static_cast<Query*>(arguments->userPtr);
  const glm::uvec3& t = (*q.triangles)[arguments->primID];
  for (int k = 0; k < 3; ++k) {
    if (!(std::fabs(glm::dot((*q.positions)[t[k]] - q.place, q.normal)) > q.beside)) continue;
    q.found = true;
    arguments->query->radius = 0;  // no other is asked for
    return true;
  }
  return false;
}

}  // namespace

bool Occluders::near(const glm::dvec3& place, double radius, const glm::dvec3& normal, double beside) const {
  Query q{&state_->positions, &state_->triangles, place - middle_, normal, static_cast<float>(beside)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  RTCPointQuery query{q.place.x, q.place.y, q.place.z, 0, static_cast<float>(radius)};
  rtcPointQuery(state_->scene, &query, &context, meet, &q);
  return q.found;
}

}  // namespace airlight
