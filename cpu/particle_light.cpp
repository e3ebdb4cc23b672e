#include <algorithm>

#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/particle_light.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/medium.h"
#include "cpu/network.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

HWY_INLINE void light_lanes(const ParticleLight& a, const float* particles, const std::int32_t* lines, const float* voxels, int v,
                            float* first) {
  const int n = a.particle_count;
  const bool isotropic = a.phase.kind == PhaseKind::isotropic;
  const int directions = isotropic ? 1 : 2 * a.line_count;
  const ParticleLanes here{particles, n, v};
  const MediumLookup medium(a.gaussians, a.grid, voxels, a.light_steps);
  const Real3 place = here.place(a.unit);
  const Mask all = Real(0.0) < Real(1.0);
  // The phase function from a light's way, against which it goes, to direction i.
  const auto toward = [&](const Real3& way, int i) HWY_ATTR {
    const Real mu = dot(way, line_direction_of(lines + static_cast<std::ptrdiff_t>(line_fields) * (i / 2)));
    return phase_value(static_cast<int>(a.phase.kind), static_cast<float>(a.phase.g), i % 2 == 0 ? -mu : mu);
  };
  for (int i = 0; i < directions; ++i) {
    Real rgb[3];
    for (int c = 0; c < 3; ++c) rgb[c] = here.plane(particle_glow + c);
    store_rgb(rgb, n, v, first + 4 * static_cast<std::ptrdiff_t>(i) * n);
  }
  for (const Light& light : a.lights) {
    Real length;
    const Real3 way = toward_light(light, place, length);
    Real depth = depth_of_way(medium, place, way, length, all);
    Real arriving = 1.0;
    if (!light.directional) {
      const Real r = max(length, light.radius);
      depth = fma(length, a.extinction, depth);
      arriving = 1.0 / (r * r);
    }
    arriving = arriving * transmittance(depth);
    // So many directions do not have quite the phase function's mean about each way of the light: all that is scattered goes on.
    if (!isotropic) {
      Real sum = 0.0;
      for (int i = 0; i < directions; ++i) sum += toward(way, i);
      arriving = arriving * (static_cast<float>(directions) * phase_isotropic()) / sum;
    }
    for (int i = 0; i < directions; ++i) {
      const Real phase = isotropic ? phase_isotropic() : toward(way, i);
      HWY_ALIGN float values[16];
      store(arriving * phase, values);
      float* to = first + 4 * static_cast<std::ptrdiff_t>(i) * n;
      for (int k = 0; k < lanes && v + k < n; ++k) {
        for (int c = 0; c < 3; ++c) {
          const float albedo = particles[static_cast<std::ptrdiff_t>(particle_albedo + c) * n + v + k];
          to[4 * (v + k) + c] += values[k] * light.power[c] * albedo;
        }
      }
    }
  }
}

}  // namespace

static void light_particles(const ParticleLight& a, const float* particles, const std::int32_t* lines, const float* voxels,
                            int begin, int end, float* first) {
  for (int v = begin; v < end; v += lanes) light_lanes(a, particles, lines, voxels, v, first);
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(light_particles);

void run_volume(const ParticleLight& a, const BufferView& view, Workers& workers, Simd simd) {
  constexpr int batch = 64;  // a multiple of the most lanes
  workers.each((a.particle_count + batch - 1) / batch, [&](int n, int) {
    entry(HWY_DISPATCH_TABLE(light_particles), simd)(a, view.floats(a.particles), view.integers(a.lines), view.floats(a.voxels),
                                                     n * batch, std::min((n + 1) * batch, a.particle_count), view.made(a.first));
  });
}

}  // namespace airlight
#endif
