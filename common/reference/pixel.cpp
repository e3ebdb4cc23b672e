#include "common/reference/pixel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "common/error.h"
#include "common/formulas/double.h"
#include "common/reference/environment_indirect.h"
#include "common/reference/indirect.h"
#include "common/reference/indirect_exact.h"
#include "common/reference/paths.h"
#include "common/scene/brdf.h"

namespace airlight {

Reference::Reference(const Scene& scene, const ReferenceSettings& settings)
    : scene_(scene), medium_(scene.medium, scene.camera.position), settings_(settings), visibility_(scene) {
  if (scene.environment) environment_.emplace(*scene.environment);
  for (const LightSource& l : scene.lights) lights_.emplace_back(l, scene.camera.position);
  const glm::dvec3& albedo = medium_.albedo;
  if (settings.max_bounces > 1000 && medium_.extinction > 0 && std::max({albedo.x, albedo.y, albedo.z}) == 1) {
    for (const RelativeLight& l : lights_) {
      if (l.directional && l.power != glm::dvec3(0)) {
        throw InputError(
            "max_bounces: fog without bounds that absorbs nothing scatters a directional light without end, expected "
            "at most 1000 or an albedo below 1");
      }
    }
    if (environment_) {
      throw InputError(
          "max_bounces: fog without bounds that absorbs nothing scatters an environment without end, expected at most 1000 or an "
          "albedo below 1");
    }
  }
  forward_ = glm::normalize(scene.camera.look_at - scene.camera.position);
  right_ = glm::normalize(glm::cross(forward_, scene.camera.up));
  up_ = glm::cross(right_, forward_);
  tan_half_fov_ = std::tan(scene.camera.vertical_fov * std::numbers::pi / 360);
}

glm::dvec3 Reference::direction(glm::dvec2 at, Extent extent) const {
  const double x = f64::image_plane_x(at.x, -0.5, extent.width, extent.height, tan_half_fov_);
  const double y = f64::image_plane_y(at.y, -0.5, extent.height, tan_half_fov_);
  return glm::normalize(x * right_ + y * up_ + forward_);
}

Reference::Seen Reference::look(const glm::dvec3& d) const {
  Seen seen;
  seen.direction = d;
  const double near_plane = static_cast<double>(View{}.near_plane) / glm::dot(d, forward_);
  const auto hit = visibility_.nearest(glm::dvec3(0), d, near_plane);
  if (!hit) return seen;
  const Triangles& all = visibility_.triangles();
  const auto& t = all[hit->triangle];
  const glm::dvec3 a = all.position(t, 0), b = all.position(t, 1), c = all.position(t, 2);
  seen.hit = true;
  seen.distance = hit->distance;
  seen.triangle = hit->triangle;
  seen.surface = static_cast<int>(t.surface);
  seen.point = d * hit->distance;

  // Weights of the corners: volumes beside the opposite edges.
  const double u = glm::dot(d, glm::cross(b, c)), v = glm::dot(d, glm::cross(c, a)), w = glm::dot(d, glm::cross(a, b));
  const double wb = v / (u + v + w), wc = w / (u + v + w);
  const glm::dvec3 na = all.normal(t, 0), nb = all.normal(t, 1), nc = all.normal(t, 2);
  f64::shading_normal(d.x, d.y, d.z, na.x, na.y, na.z, nb.x, nb.y, nb.z, nc.x, nc.y, nc.z, wb, wc, seen.normal.x, seen.normal.y,
                      seen.normal.z);
  seen.face = glm::normalize(glm::cross(b - a, c - a));
  return seen;
}

bool Reference::lit(const Seen& seen, const RelativeLight& light) const {
  const glm::dvec3 way = light.way_from(seen.point);
  if (!(glm::dot(seen.normal, way) > 0)) return false;
  return !settings_.shadows || !visibility_.blocked(seen.point, seen.triangle, light);
}

// On a facing plane, per unit of the light's power.
double Reference::irradiance(const Seen& seen, const RelativeLight& light) const {
  if (!lit(seen, light)) return 0;
  const double length = light.directional ? 0 : glm::length(light.vector - seen.point);
  const double r = std::max(length, light.radius);
  return std::exp(-depth_to_light(medium_, seen.point, light, length)) / (light.directional ? 1 : r * r);
}

// Of one light [W/m^2/sr].
Integral Reference::indirect(const Seen& seen, const glm::dvec3& mirror, const RelativeLight& light) const {
  const Surface& surface = scene_.surfaces[static_cast<std::size_t>(seen.surface)];
  const Material& material = surface.material;
  if (settings_.indirect == Indirect::exact) {
    const glm::dvec3 face = glm::dot(seen.face, seen.direction) > 0 ? -seen.face : seen.face;
    return exact_indirect(medium_, visibility_, light, {seen.point, seen.normal, face, mirror, seen.triangle, &surface},
                          settings_.shadows, settings_.indirect_tolerance);
  }
  if (settings_.indirect == Indirect::off || !(medium_.extinction > 0)) return {};
  return {indirect_reflection(medium_, light, seen.point, seen.normal, mirror, material) * light.power * medium_.albedo,
          glm::dvec3(0)};
}

// As it leaves the surface, or as it is far away [W/m^2/sr]. Its light is given as it arrives through the homogeneous part, as
// that of a directional light is.
Integral Reference::environment(const glm::dvec3& d, const Seen& seen) const {
  if (!environment_) return {};
  if (!seen.hit) return {environment_->radiance(d), glm::dvec3(0)};
  LightSource source;
  source.type = LightType::directional;
  return environment_->reflected(seen.normal, d - 2 * glm::dot(d, seen.normal) * seen.normal,
                                 scene_.surfaces[static_cast<std::size_t>(seen.surface)], [&](const glm::dvec3& u) {
                                   source.direction = -u;
                                   const RelativeLight light(source, glm::dvec3(0));
                                   if (settings_.environment_shadows && visibility_.blocked(seen.point, seen.triangle, light))
                                     return 0.0;
                                   return std::exp(-depth_to_light(medium_, seen.point, light, 0));
                                 });
}

void Reference::shade(const glm::dvec3& d, const Seen& seen, ReferencePixel& pixel, glm::dvec3& error) const {
  const Integral from_environment = environment(d, seen);
  pixel.surface_environment = pixel.transmittance * from_environment.value;
  error += pixel.transmittance * from_environment.error;
  if (!seen.hit) {
    pixel.surface = pixel.transmittance * scene_.background + pixel.surface_environment;
    return;
  }
  const Surface& surface = scene_.surfaces[static_cast<std::size_t>(seen.surface)];
  const Material& material = surface.material;
  const glm::dvec3 mirror = d - 2 * glm::dot(d, seen.normal) * seen.normal;
  for (const RelativeLight& light : lights_) {
    const Integral scattered = indirect(seen, mirror, light);
    pixel.surface_indirect += scattered.value;
    error += pixel.transmittance * scattered.error;
    const double e = irradiance(seen, light);
    if (!(e > 0)) continue;
    const glm::dvec3 to_light = glm::normalize(light.way_from(seen.point));
    if (surface.brdf) {
      pixel.surface_direct += e * light.power * tabulated_reflection(*surface.brdf, seen.normal, to_light, -d);
      continue;
    }
    const double cosine = glm::dot(seen.normal, to_light);
    const glm::dvec3 reflection =
        f64::lambert(cosine) * glm::dvec3(material.diffuse) +
        f64::phong(cosine, f64::unit_distance(mirror.x, mirror.y, mirror.z, to_light.x, to_light.y, to_light.z),
                   static_cast<double>(material.shininess)) *
            glm::dvec3(material.specular);
    pixel.surface_direct += e * light.power * reflection;
  }
  if (environment_ && settings_.indirect == Indirect::exact) {
    const glm::dvec3 face = glm::dot(seen.face, seen.direction) > 0 ? -seen.face : seen.face;
    const Integral scattered = exact_environment_indirect(medium_, visibility_, *environment_,
                                                          {seen.point, seen.normal, face, mirror, seen.triangle, &surface});
    pixel.surface_indirect += scattered.value;
    error += pixel.transmittance * scattered.error;
  }
  if (!medium_.empty()) pixel.surface_ambient = glm::dvec3(material.diffuse) * medium_.ambient;
  pixel.surface_direct *= pixel.transmittance;
  pixel.surface_indirect *= pixel.transmittance;
  pixel.surface_ambient *= pixel.transmittance;
  pixel.surface = pixel.surface_direct + pixel.surface_indirect + pixel.surface_ambient + pixel.surface_environment;
}

ReferencePixel Reference::pixel(glm::dvec2 at, Extent extent, const ReferenceParts& parts, const Progress* stop) const {
  const glm::dvec3 d = direction(at, extent);
  const Seen seen = look(d);
  ReferencePixel pixel;
  pixel.depth = seen.distance;
  pixel.normal = seen.normal;
  pixel.surface_index = seen.surface;
  const double sky = scene_.sky_distance < 1e30 ? scene_.sky_distance : std::numeric_limits<double>::infinity();
  const RayInMedium ray(medium_, glm::dvec3(0), d, seen.hit ? seen.distance : sky);
  const double tau = ray.depth();
  pixel.optical_depth = std::min(tau, 1e30);
  pixel.transmittance = std::exp(-tau);
  glm::dvec3 error(0);
  if (parts.surface) shade(d, seen, pixel, error);
  if (parts.airlight) add_airlight(ray, at, pixel, error, stop);
  for (int c = 0; c < 3; ++c) {
    if (error[c] > 0) pixel.error = std::max(pixel.error, error[c] / pixel.beauty()[c]);
  }
  return pixel;
}

void Reference::add_airlight(const RayInMedium& ray, const glm::dvec2& at, ReferencePixel& pixel, glm::dvec3& error,
                             const Progress* stop) const {
  for (const RelativeLight& light : lights_) {
    if (settings_.single_by_paths) {
      pixel.airlight_of_light.emplace_back(0);
      continue;
    }
    const auto shadow =
        settings_.shadows ? visibility_.shadows(glm::dvec3(0), ray.direction(), ray.reach(), light) : std::vector<Interval>();
    const Integral part = ray.scattered(light, shadow, settings_.tolerance);
    pixel.airlight_of_light.push_back(part.value);
    pixel.airlight += part.value;
    error += part.error;
  }
  if (settings_.any_paths()) {
    const Paths paths(medium_, visibility_, lights_, environment_ ? &*environment_ : nullptr,
                      {settings_.max_bounces, settings_.paths, settings_.single_by_paths, settings_.shadows, settings_.seed});
    const PathEstimate more = paths.along(ray, at, stop);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      pixel.airlight_of_light[i] += more.of_light[i];
      pixel.airlight += more.of_light[i];
    }
    pixel.airlight += more.of_others;
    pixel.standard_error = more.standard_error;
  }
  if (environment_ && !medium_.empty() && !settings_.single_by_paths) {
    const Integral part =
        environment_->scattered([&](const RelativeLight& l) { return ray.scattered(l, {}, settings_.tolerance); });
    pixel.airlight += part.value;
    error += part.error;
  }
  const Integral emitted = ray.emitted(settings_.tolerance);
  pixel.airlight += emitted.value - std::expm1(-ray.depth()) * medium_.ambient;
  error += emitted.error;
}

std::vector<Interval> Reference::shadows(glm::dvec2 at, Extent extent, std::size_t light) const {
  const glm::dvec3 d = direction(at, extent);
  const Seen seen = look(d);
  const RayInMedium ray(medium_, glm::dvec3(0), d, seen.hit ? seen.distance : scene_.sky_distance);
  return visibility_.shadows(glm::dvec3(0), d, ray.reach(), lights_.at(light));
}

}  // namespace airlight
