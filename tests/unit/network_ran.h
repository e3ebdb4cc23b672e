// The steps of an illumination network, run on the CPU for the tests of what they make.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "cpu/backend.h"
#include "tests/parity/network.h"

namespace airlight {

// A case with its steps run, and what came out of them.
class RanNetwork {
 public:
  // `with_everywhere`: what there is to scatter toward the camera is made as well.
  RanNetwork(const Scene& scene, const std::vector<LightSource>& lights, const NetworkParts& parts,
             bool with_everywhere = false) {
    t = test_network(case_, scene, lights, parts);
    case_.steps = {{t.network, ""}, {t.light, ""}, {t.iteration, ""}};
    if (with_everywhere) case_.steps.push_back({t.source, ""});
    upload(backend_, case_);
    NoProgress progress;
    backend_.run(case_.steps, stats, progress);
    links = download(backend_, t.network.links);
    first = download(backend_, t.light.first);
    sources = download(backend_, t.iteration.sources);
    residuals = download(backend_, t.iteration.residuals);
    if (with_everywhere) everywhere = download(backend_, t.source.sources);
    const auto floats = [&](std::size_t k) {
      const std::vector<std::byte>& bytes = case_.buffers[k].second;
      return std::span(reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float));
    };
    particles.assign(floats(0).begin(), floats(0).end());
    const std::span<const float> line_bits = floats(1);
    lines.assign(reinterpret_cast<const std::int32_t*>(line_bits.data()),
                 reinterpret_cast<const std::int32_t*>(line_bits.data()) + line_bits.size());
    shape = t.network.shape();
  }

  double link(std::size_t line, int plane, std::size_t record) const {
    return static_cast<double>(links[shape.record(line, plane) + record]);
  }
  double particle(std::size_t plane, std::size_t v) const { return static_cast<double>(particles[plane * shape.particles + v]); }
  // What a list stands for of the cross-section: its optical depth is to be its particles' mass.
  double area(std::size_t line, const std::vector<std::size_t>& list, std::size_t record) const {
    double depth = 0;
    for (std::size_t k = 0; k <= list.size(); ++k) depth += link(line, link_depth, record + k);
    double mass = 0;
    for (const std::size_t v : list) mass += particle(particle_mass, v);
    return mass / depth;
  }
  glm::dvec3 axis(std::size_t line, int field) const {
    const std::int32_t* l = lines.data() + line * line_fields + field;
    return glm::dvec3(l[0], l[1], l[2]) / static_cast<double>(lattice_length);
  }
  // body(pixel, its particles in order, its first record)
  template <class Body>
  void each_list(std::size_t line, Body&& body) const {
    const float* begin = links.data() + line * (shape.slots + 1);
    for (std::size_t c = 0; c < shape.slots; ++c) {
      const auto a = static_cast<std::size_t>(begin[c]), b = static_cast<std::size_t>(begin[c + 1]);
      std::vector<std::size_t> list;
      for (std::size_t k = a; k < b; ++k) list.push_back(static_cast<std::size_t>(link(line, link_particle, k + c)));
      if (!list.empty()) body(c, list, a + c);
    }
  }

  TestNetwork t;
  Stats stats;
  NetworkShape shape;
  std::vector<float> links, first, sources, residuals, particles, everywhere;
  std::vector<std::int32_t> lines;

 private:
  Case case_;
  CpuBackend backend_{CpuOptions{.threads = 2}};
};

}  // namespace airlight
