#include "tests/stability/hostile.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>

#include "tests/stability/draw.h"
#include "tests/stability/hostile_meshes.h"

namespace airlight {

namespace {

class Maker {
 public:
  explicit Maker(std::uint32_t number) : draw_(number) {}

  HostileScene make() {
    size_ = draw_.chance(0.2) ? draw_.of(std::array{1e-3, 0.03, 30.0, 1e3}) : 1;
    if (size_ != 1) tell("sizes of " + std::to_string(size_));
    if (draw_.chance(0.15)) {
      tell("far from the origin");
      middle_ = 1e5 * draw_.direction();
    }
    camera();
    medium();
    const int surfaces = draw_.of(std::array{0, 0, 1, 1, 2, 3});
    for (int i = 0; i < surfaces; ++i) surface();
    lights();
    environment();
    return {scene_, traits_.empty() ? "nothing" : traits_};
  }

 private:
  void tell(const std::string& trait) { traits_ += (traits_.empty() ? "" : ", ") + trait; }

  void camera() {
    Camera& c = scene_.camera;
    c.position = middle_ + size_ * (draw_.between(1, 4) * draw_.direction());
    c.look_at = middle_ + size_ * draw_.vector(0.3);
    c.vertical_fov = draw_.between(30, 70);
    c.resolution = {24, 16};
    if (draw_.chance(0.15)) {
      c.vertical_fov = draw_.of(std::array{0.05, 1.0, 120.0, 170.0, 179.0});
      tell("field of view " + std::to_string(c.vertical_fov));
    }
    if (draw_.chance(0.05)) {
      c.resolution = draw_.of(std::array{Extent{1, 1}, Extent{1, 130}, Extent{700, 1}, Extent{66, 65}, Extent{8192, 1}});
      tell(std::to_string(c.resolution.width) + " x " + std::to_string(c.resolution.height) + " pixels");
    }
    if (draw_.chance(0.1)) {
      c.position = middle_ + size_ * draw_.vector(0.2);
      tell("camera among it all");
    }
    if (draw_.chance(0.1)) {  // rays along axes and planes of symmetry
      c.position = middle_ + glm::dvec3(0, 0, 3 * size_);
      c.look_at = middle_;
      tell("camera on an axis");
    }
    if (draw_.chance(0.4)) scene_.sky_distance = size_ * draw_.between(3, 20);
    if (draw_.chance(0.05)) {
      scene_.sky_distance = draw_.of(std::array{0.0, 1e-3, 1e9});
      tell("sky distance " + std::to_string(scene_.sky_distance));
    }
  }

  // The ray of a pixel.
  glm::dvec3 through(int i, int j) const {
    const Camera& c = scene_.camera;
    const glm::dvec3 forward = glm::normalize(c.look_at - c.position), right = glm::normalize(glm::cross(forward, c.up));
    const double tan = std::tan(glm::radians(c.vertical_fov) / 2), w = c.resolution.width, h = c.resolution.height;
    const double x = (2 * (i + 0.5) / w - 1) * tan * w / h, y = (1 - 2 * (j + 0.5) / h) * tan;
    return glm::normalize(forward + x * right + y * glm::cross(right, forward));
  }
  glm::dvec3 on_a_view_ray(double distance) {
    const Extent e = scene_.camera.resolution;
    const int i = draw_.whole(0, e.width - 1);
    return scene_.camera.position + distance * through(i, draw_.whole(0, e.height - 1));
  }

  glm::dvec3 albedo() {
    if (draw_.chance(0.15)) return glm::dvec3(draw_.of(std::array{0.0, 1.0}));
    const double red = draw_.unit();
    return draw_.chance(0.5) ? glm::dvec3(red) : glm::dvec3(red, draw_.unit(), draw_.unit());
  }

  void medium() {
    Medium& m = scene_.medium;
    m.albedo = albedo();
    m.phase.kind = draw_.chance(0.4) ? PhaseKind::isotropic : static_cast<PhaseKind>(draw_.whole(0, 5));
    if (m.phase.kind == PhaseKind::henyey_greenstein || m.phase.kind == PhaseKind::cornette_shanks) {
      m.phase.g = draw_.between(-0.7, 0.7);
      if (draw_.chance(0.25)) {
        m.phase.g = draw_.of(std::array{-0.99, 0.99, 1e-7});
        tell("g " + std::to_string(m.phase.g));
      }
    }
    const bool fog = draw_.chance(0.6);
    if (fog) m.extinction = draw_.magnitude(0.01, 1) / size_;
    if (fog && draw_.chance(0.15)) {
      m.extinction = draw_.of(std::array{1e-12, 1e-6, 10.0, 1e3, 1e4}) / size_;
      tell("fog of depth " + std::to_string(m.extinction * size_));
    }
    if (draw_.chance(0.2)) m.ambient = draw_.between(0, 0.5) * glm::dvec3(1, 0.5, 0);
    if (fog && draw_.chance(0.1)) m.emission = m.extinction * glm::dvec3(0.1, 0, 0.3);
    if (draw_.chance(0.6)) gaussians();
    if (draw_.chance(m.gaussians.empty() ? 0.35 : 0.1)) grid();
  }

  void gaussians() {
    const int count = draw_.of(std::array{1, 1, 2, 3, 5, 18, 40});
    const bool one_albedo = draw_.chance(0.7);
    for (int i = 0; i < count; ++i) {
      Gaussian g;
      g.center = middle_ + size_ * draw_.vector(0.8);
      g.radius = size_ * draw_.magnitude(0.1, 0.6);
      double depth = draw_.magnitude(0.03, 3);
      if (i == 0 && draw_.chance(0.2)) {
        g.radius =
            std::clamp(draw_.of(std::array{1e-6, 1e-3, 0.01, 30.0, 1e3, 1e6}) * (draw_.chance(0.5) ? size_ : 1), 1e-6, 1e6);
        tell("Gaussian of radius " + std::to_string(g.radius));
      }
      if (i == 0 && draw_.chance(0.15)) {
        depth = draw_.of(std::array{0.0, 1e-9, 100.0, 1e4});
        tell("Gaussian of depth " + std::to_string(depth));
      }
      if (i == 0 && draw_.chance(0.1)) {
        g.center = scene_.camera.position;
        tell("camera in a Gaussian's centre");
      }
      if (i == 1 && draw_.chance(0.1)) {
        g.center = scene_.medium.gaussians[0].center;
        tell("Gaussians in one place");
      }
      g.extinction = std::min(depth / (g.radius * 1.7724538509055159), 1e6);
      g.albedo = one_albedo && i > 0 ? scene_.medium.gaussians[0].albedo : albedo();
      if (!one_albedo && draw_.chance(0.1)) g.emission = g.extinction * glm::dvec3(0, 0.2, 0.1);
      scene_.medium.gaussians.push_back(g);
    }
  }

  void grid() {
    auto voxels = std::make_shared<VoxelGrid>();
    const int most = draw_.of(std::array{1, 2, 5, 9});
    for (int k = 0; k < 3; ++k) voxels->size[k] = draw_.whole(1, most);
    const double depth = draw_.magnitude(0.1, 5), empty = draw_.unit();
    for (int i = 0; i < voxels->size.x * voxels->size.y * voxels->size.z; ++i)
      voxels->values.push_back(draw_.chance(empty) ? 0 : static_cast<float>(draw_.magnitude(0.05, 1)));
    if (draw_.chance(0.1)) {
      voxels->values[0] = 1e4F;
      tell("a cell of depth 10000");
    }
    GridMedium grid{
        .voxels = voxels,
        .scale = depth / size_,
        .albedo = scene_.medium.gaussians.empty() || draw_.chance(0.3) ? albedo() : scene_.medium.gaussians[0].albedo};
    glm::dmat4 t(1.0);
    if (draw_.chance(0.5)) {
      const glm::dvec3 a = draw_.direction(), b = glm::normalize(glm::cross(a, draw_.direction()));
      t[0] = glm::dvec4(a, 0), t[1] = glm::dvec4(b, 0), t[2] = glm::dvec4(glm::cross(a, b), 0);
    }
    for (int k = 0; k < 3; ++k) t[k] *= size_ * draw_.between(0.6, 1.6) / voxels->size[k];
    if (draw_.chance(0.1)) {
      t[1] *= draw_.of(std::array{1e-3, 30.0, -1.0});
      tell("flat, long or mirrored cells");
    }
    const glm::dvec3 half = 0.5 * glm::dvec3(voxels->size);
    t[3] = glm::dvec4(middle_ - glm::dvec3(t * glm::dvec4(half, 0)) + size_ * draw_.vector(0.3), 1);
    grid.transform = t;
    scene_.medium.grid = grid;
  }

  void surface() {
    Surface s;
    std::string trait;
    s.mesh = hostile_mesh(draw_, trait);
    if (!trait.empty()) tell(trait);
    s.transform = glm::dmat4(size_ * draw_.between(0.3, 1));
    if (draw_.chance(0.2)) {
      s.transform[draw_.whole(0, 2)] *= draw_.of(std::array{1e-3, -1.0, 20.0});
      tell("stretched or mirrored mesh");
    }
    s.transform[3] = glm::dvec4(middle_ + size_ * draw_.vector(0.8), 1);
    if (draw_.chance(0.05)) {
      s.transform[3] = glm::dvec4(scene_.camera.position, 1);
      tell("camera in a mesh");
    }
    s.casts_shadow = draw_.chance(0.7);
    s.material.diffuse = glm::vec3(albedo());
    if (draw_.chance(0.4)) {
      s.material.diffuse *= 0.5F;
      s.material.specular = glm::vec3(0.5F, 0.3F, 0);
      s.material.shininess = static_cast<float>(draw_.magnitude(1, 100));
      if (draw_.chance(0.2)) {
        s.material.shininess = draw_.of(std::array{0.0F, 1e4F});
        tell("shininess " + std::to_string(s.material.shininess));
      }
    }
    scene_.surfaces.push_back(s);
  }

  glm::dvec3 vertex(const Surface& s, std::size_t i) const {
    return glm::dvec3(s.transform * glm::dvec4(glm::dvec3(s.mesh->positions[i % s.mesh->positions.size()]), 1.0));
  }

  // Where a lamp stands.
  glm::dvec3 lamp_place() {
    const Medium& m = scene_.medium;
    if (draw_.chance(0.6)) return middle_ + size_ * draw_.vector(1.5);
    switch (draw_.whole(0, 8)) {
      case 0:
        tell("lamp in the camera");
        return scene_.camera.position;
      case 1:
        tell("lamp far away");
        return middle_ + size_ * draw_.of(std::array{100.0, 1e4}) * draw_.direction();
      case 2:
        tell("lamp behind the camera");
        return 2.0 * scene_.camera.position - on_a_view_ray(size_ * draw_.between(0.1, 2));
      case 3:
        if (m.gaussians.empty()) break;
        tell("lamp in a Gaussian's centre");
        return m.gaussians[0].center;
      case 4:
        if (scene_.surfaces.empty()) break;
        tell("lamp in a vertex");
        return vertex(scene_.surfaces[0], static_cast<std::size_t>(draw_.whole(0, 1000)));
      case 5: {
        if (scene_.surfaces.empty()) break;
        tell("lamp on a triangle");
        const Surface& s = scene_.surfaces.back();
        const glm::uvec3 t = s.mesh->triangles[s.mesh->triangles.size() / 2];
        return (vertex(s, t.x) + vertex(s, t.y) + vertex(s, t.z)) / 3.0;
      }
      case 6: {
        if (!m.grid) break;
        tell("lamp on a cell's face");
        const glm::dvec3 half = glm::floor(0.5 * glm::dvec3(m.grid->voxels->size));
        return glm::dvec3(m.grid->transform * glm::dvec4(half, 1));
      }
      default:
        break;
    }
    tell("lamp on a view ray");
    return on_a_view_ray(size_ * draw_.between(0.5, 5));
  }

  void lights() {
    int count = draw_.of(std::array{0, 1, 1, 1, 2, 3});
    if (draw_.chance(0.03)) {
      count = 64;
      tell("64 lights");
    }
    for (int i = 0; i < count; ++i) {
      LightSource l;
      l.power = glm::dvec3(draw_.between(0.2, 2), draw_.between(0, 2), draw_.chance(0.8) ? 1 : 0);
      if (draw_.chance(0.3)) {
        l.type = LightType::directional;
        l.direction = draw_.direction();
        if (draw_.chance(0.2)) {
          const glm::dvec3 forward = glm::normalize(scene_.camera.look_at - scene_.camera.position);
          l.direction = draw_.of(std::array{forward, -forward, glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0)});
          tell("sun along the view or an axis");
        }
      } else {
        l.position = i > 0 && draw_.chance(0.05) ? scene_.lights[0].position : lamp_place();
        const double distance = glm::distance(l.position, middle_);
        l.power *= std::max(size_, distance) * std::max(size_, distance);
        l.radius = std::clamp(1e-3 * size_, 1e-6, 1e6);
        if (draw_.chance(0.15)) {
          l.radius = draw_.of(std::array{1e-6, 0.3, 30.0, 1e6});
          tell("lamp of radius " + std::to_string(l.radius));
        }
      }
      scene_.lights.push_back(l);
    }
  }

  void environment() {
    if (draw_.chance(0.3)) scene_.background = draw_.between(0, 1) * glm::dvec3(0.3, 0.5, 1);
    if (!draw_.chance(0.15)) return;
    tell("environment");
    scene_.background = glm::dvec3(0);
    Environment e{nullptr, glm::dvec3(draw_.unit(), draw_.unit(), 0.5), draw_.between(-180, 180)};
    if (draw_.chance(0.5)) {
      auto image = std::make_shared<HostImage>(Extent{16, 8}, 3);
      for (float& v : image->values) v = static_cast<float>(draw_.unit());
      if (draw_.chance(0.3)) image->at(3, 2, 0) = 1e3F;
      e.image = image;
      e.radiance = glm::dvec3(e.radiance.x);
    }
    scene_.environment = e;
  }

  Draw draw_;
  Scene scene_;
  std::string traits_;
  double size_ = 1;
  glm::dvec3 middle_{0};
};

}  // namespace

HostileScene hostile_scene(std::uint32_t number) { return Maker(number).make(); }

}  // namespace airlight
