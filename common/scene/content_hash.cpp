#include "common/scene/content_hash.h"

#include <type_traits>
#include <vector>

#include "common/scene/sha256.h"

namespace airlight {

namespace {

// Hashes values by their bits, arrays with their sizes.
class Content {
 public:
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T v) {
    if constexpr (std::is_floating_point_v<T>) v += T(0);  // -0 is 0
    sha_.add(std::as_bytes(std::span(&v, 1)));
  }
  template <glm::length_t n, class T, glm::qualifier q>
  void add(const glm::vec<n, T, q>& v) {
    for (glm::length_t i = 0; i < n; ++i) add(v[i]);
  }
  template <class T>
  void add(const std::vector<T>& all) {
    add(static_cast<std::uint64_t>(all.size()));
    for (const T& one : all) add(one);
  }

  void add(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column) add(m[column]);
  }

  // Structured bindings: a new member does not compile until it is thought of here.
  void add(const Camera& camera) {
    const auto& [position, look_at, up, vertical_fov, resolution] = camera;  // the resolution is the caller's
    add(position), add(look_at), add(up), add(vertical_fov);
  }
  void add(const Phase& phase) {
    const auto& [kind, g] = phase;
    add(kind), add(g);
  }
  void add(const Gaussian& gaussian) {
    const auto& [center, radius, extinction, albedo, emission] = gaussian;
    add(center), add(radius), add(extinction), add(albedo), add(emission);
  }
  void add(const Medium& medium) {
    const auto& [phase, albedo, ambient, emission, extinction, gaussians, grid, noise] = medium;
    add(phase), add(albedo), add(ambient), add(emission), add(extinction), add(gaussians);
    const auto& [amplitude, noise_scale, offset] = noise;
    add(amplitude), add(noise_scale), add(offset);
    if (!grid) return;
    const auto& [voxels, transform, scale, grid_albedo] = *grid;
    add(voxels->size), add(voxels->values), add(transform), add(scale), add(grid_albedo);
  }
  void add(const LightSource& light) {
    const auto& [type, name, position, direction, power, radius] = light;
    add(type), add(position), add(direction), add(power), add(radius);
  }
  void add(const Mesh& mesh) {
    const auto& [positions, normals, triangles, file] = mesh;
    add(positions), add(normals), add(triangles);
  }
  void add(const Material& material) {
    const auto& [diffuse_part, specular, shininess] = material;
    add(diffuse_part), add(specular), add(shininess);
  }
  void add(const Surface& s) {
    const auto& [mesh, transform, casts_shadow, material, brdf] = s;
    add(*mesh), add(casts_shadow), add(material), add(transform);
    if (!brdf) return;
    const auto& [size, values] = *brdf;
    add(size), add(values);
  }
  void add(const Scene& scene) {
    const auto& [camera, sky_distance, medium, lights, surfaces, background, environment, technique, settings, hash] = scene;
    add(camera), add(sky_distance), add(medium), add(lights), add(surfaces), add(background);
    if (!environment) return;
    const auto& [image, radiance, rotation] = *environment;
    add(radiance), add(rotation);
    if (image) add(image->extent.width), add(image->extent.height), add(image->values);
  }
  std::string hex() const { return sha_.hex(); }

 private:
  Sha256 sha_;
};

}  // namespace

std::string content_hash(const Scene& scene) {
  Content content;
  content.add(scene);
  return content.hex();
}

}  // namespace airlight
