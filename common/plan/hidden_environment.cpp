#include "common/plan/hidden_environment.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "common/algorithms/environment_light.h"
#include "common/algorithms/hidden_environment.h"
#include "common/formulas/double.h"
#include "common/plan/brdf.h"
#include "common/plan/hash.h"
#include "common/plan/spherical_harmonics.h"

namespace airlight {

namespace {

constexpr int order = 6;
constexpr std::size_t bands = 36;

// The surface of each vertex; a midpoint has that of its ends.
std::vector<std::uint32_t> surfaces_of(const Scene& scene, const SurfaceTransfer& transfer) {
  std::vector<std::uint32_t> of;
  of.reserve(transfer.vertices());
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
    of.insert(of.end(), scene.surfaces[s].mesh->positions.size(), static_cast<std::uint32_t>(s));
  for (const glm::uvec2& ends : transfer.midpoints) of.push_back(of[ends.x]);
  return of;
}

// Unit length but where an edge is cut, where they are means: what is between the ends stays as it was.
std::vector<glm::vec3> normals_of(const Scene& scene, const SurfaceTransfer& transfer) {
  std::vector<glm::vec3> normals;
  for (const Surface& s : scene.surfaces) {
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(s.transform)));
    for (const glm::vec3& n : s.mesh->normals) normals.emplace_back(glm::normalize(turn * glm::dvec3(n)));
  }
  for (const glm::uvec2& ends : transfer.midpoints) normals.push_back((normals[ends.x] + normals[ends.y]) / 2.0F);
  return normals;
}

// The record of a place of which all is hidden above the horizon of this normal.
std::array<float, SurfaceTransfer::record_floats> all_hidden(const glm::vec3& normal) {
  const glm::dvec3 n(normal);
  const double length = glm::length(n), scale = length > 0 ? 1 / length : 0;
  double v[bands];
  f64::sh_basis(order, -n.z * scale, n.x * scale, n.y * scale, v);
  std::array<float, SurfaceTransfer::record_floats> record{};
  for (int l = 0; l < order; ++l) {
    const double lambert = f64::sh_lobe_factor(l, 1), half = 2 * std::numbers::pi * f64::sh_lobe_factor(l, 0);
    const auto band = static_cast<std::size_t>(l);
    for (std::size_t k = band * band; k < (band + 1) * (band + 1); ++k)
      record[k] = static_cast<float>(lambert * v[k]), record[bands + k] = static_cast<float>(half * v[k]);
  }
  return record;
}

template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::uint64_t transfer_key(const Scene& scene, int rays) {
  Hash key;
  key.add(std::string_view("surface transfer 1"));
  key.add(rays);
  for (const Surface& s : scene.surfaces) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) key.add(s.transform[column][row]);
    }
    key.add(s.casts_shadow);
    key.add(s.mesh->positions.size());
    key.bytes(std::as_bytes(std::span(s.mesh->positions)));
    key.bytes(std::as_bytes(std::span(s.mesh->normals)));
    key.add(s.mesh->triangles.size());
    key.bytes(std::as_bytes(std::span(s.mesh->triangles)));
  }
  return key.value();
}

HarmonicProduct::HarmonicProduct(const EnvironmentHarmonics& environment) : matrix_(3 * bands * bands) {
  const std::vector<float> products = triple_products(order);
  const auto count = static_cast<std::size_t>(products[0]);
  for (std::size_t n = 0; n < count; ++n) {
    const float* t = &products[4 * n + 1];
    const auto i = static_cast<std::size_t>(t[0]), j = static_cast<std::size_t>(t[1]), k = static_cast<std::size_t>(t[2]);
    for (std::size_t c = 0; c < 3; ++c) matrix_[(c * bands + i) * bands + j] += static_cast<double>(t[3]) * environment[c][k];
  }
}

void HarmonicProduct::times(const float* hidden, std::span<double, 108> product) const {
  for (std::size_t i = 0; i < product.size(); ++i) {
    const double* row = &matrix_[i * bands];
    double sum = 0;
    for (std::size_t j = 0; j < bands; ++j) sum += row[j] * static_cast<double>(hidden[j]);
    product[i] = sum;
  }
}

std::vector<float> hidden_environment_table(const Scene& scene, const SurfaceTransfer& transfer) {
  const EnvironmentHarmonics environment = environment_harmonics(*scene.environment);
  const HarmonicProduct product(environment);
  const std::vector<std::uint32_t> surface = surfaces_of(scene, transfer);
  std::vector<std::array<double, order>> lobe(scene.surfaces.size());
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    for (int l = 0; l < order; ++l)
      lobe[s][static_cast<std::size_t>(l)] = f64::sh_lobe_factor(l, static_cast<double>(scene.surfaces[s].material.shininess));
  }
  const std::vector<glm::vec3> normals = normals_of(scene, transfer);
  const std::size_t vertices = transfer.vertices();
  const SceneBrdfs brdfs = brdfs_of(scene);
  std::vector<float> table(static_cast<std::size_t>(hidden_head_floats), 0), lobes;
  table[0] = static_cast<float>(vertices);
  for (const auto& brdf : brdfs.all) {
    const std::vector<float> of_brdf = brdf_lobes(*brdf);
    table.insert(table.end(), of_brdf.begin(), of_brdf.end());
  }
  table.reserve(table.size() + transfer.record.size() * static_cast<std::size_t>(hidden_vertex_floats));
  std::array<double, 3 * bands> hidden{};
  for (std::size_t v = 0; v < transfer.record.size(); ++v) {
    const std::uint32_t number = transfer.record[v], s = surface[v % vertices];
    const int brdf = brdfs.of_surface[s];
    if (number == SurfaceTransfer::nothing) {
      table.insert(table.end(), {0, 0, 0, -1, static_cast<float>(brdf)});
      continue;
    }
    std::array<float, SurfaceTransfer::record_floats> all{};
    const float* record = all.data();
    if (number == SurfaceTransfer::everything) {
      all = all_hidden(v < vertices ? normals[v] : -normals[v - vertices]);
    } else {
      record = &transfer.records[number * SurfaceTransfer::record_floats];
    }
    for (const auto& channel : environment) {
      double sum = 0;
      for (std::size_t k = 0; k < bands; ++k) sum += static_cast<double>(record[k]) * channel[k];
      table.push_back(static_cast<float>(std::max(sum, 0.0)));
    }
    const bool lobe_wanted = brdf >= 0 || scene.surfaces[s].material.specular != glm::vec3(0);
    const std::size_t lobes_before = lobes.size() / static_cast<std::size_t>(hidden_lobe_floats);
    table.push_back(lobe_wanted ? static_cast<float>(lobes_before) : -1.0F);
    table.push_back(static_cast<float>(brdf));
    if (!lobe_wanted) continue;
    product.times(record + bands, hidden);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t l = 0; l < order; ++l) {
        for (std::size_t k = l * l; k < (l + 1) * (l + 1); ++k)
          lobes.push_back(static_cast<float>((brdf >= 0 ? 1 : lobe[s][l]) * hidden[c * bands + k]));
      }
    }
  }
  table.insert(table.end(), lobes.begin(), lobes.end());
  return table;
}

HiddenSizes hidden_sizes(const Scene& scene, const SurfaceTransfer* transfer) {
  HiddenSizes sizes;
  const SceneBrdfs brdfs = brdfs_of(scene);
  const auto has_lobe = [&](std::size_t s) {
    return brdfs.of_surface[s] >= 0 || scene.surfaces[s].material.specular != glm::vec3(0);
  };
  std::size_t lobes = 0, records = 0;
  bool any = false;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Mesh& mesh = *scene.surfaces[s].mesh;
    sizes.vertices += mesh.positions.size(), sizes.triangles += mesh.triangles.size();
    lobes += has_lobe(s) ? 2 * mesh.positions.size() : 0;
    any = any || has_lobe(s);
  }
  if (transfer) {
    sizes.vertices = transfer->vertices();
    sizes.triangles = std::max(sizes.triangles, transfer->triangles.size());
    const std::vector<std::uint32_t> surface = surfaces_of(scene, *transfer);
    lobes = 0;
    for (std::size_t v = 0; v < transfer->record.size(); ++v)
      lobes += transfer->record[v] != SurfaceTransfer::nothing && has_lobe(surface[v % sizes.vertices]) ? 1 : 0;
  } else {
    constexpr std::size_t more = 2 * SurfaceTransfer::most_cuts;
    sizes.vertices += more, sizes.triangles += more;
    lobes += any ? 2 * more : 0;
  }
  records = 2 * sizes.vertices;
  sizes.table =
      hidden_head_floats + brdfs.all.size() * brdf_lobe_floats + records * hidden_vertex_floats + lobes * hidden_lobe_floats;
  return sizes;
}

std::vector<std::byte> cut_positions(const Scene& scene, const SurfaceTransfer& transfer) {
  std::vector<glm::dvec3> world;
  for (const Surface& s : scene.surfaces) {
    for (const glm::vec3& p : s.mesh->positions) world.emplace_back(s.transform * glm::dvec4(glm::dvec3(p), 1.0));
  }
  for (const glm::uvec2& ends : transfer.midpoints) world.push_back((world[ends.x] + world[ends.y]) / 2.0);
  std::vector<glm::vec3> positions;
  positions.reserve(world.size());
  for (const glm::dvec3& p : world) positions.emplace_back(p - scene.camera.position);
  return bytes_of(positions);
}

std::vector<std::byte> cut_normals(const Scene& scene, const SurfaceTransfer& transfer) {
  return bytes_of(normals_of(scene, transfer));
}

std::vector<std::byte> cut_triangles(const Scene& scene, const SurfaceTransfer& transfer) {
  if (!transfer.triangles.empty()) return bytes_of(transfer.triangles);
  std::vector<glm::uvec4> triangles;
  std::uint32_t first = 0;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Mesh& mesh = *scene.surfaces[s].mesh;
    for (const glm::uvec3& t : mesh.triangles) triangles.emplace_back(first + t, static_cast<std::uint32_t>(s));
    first += static_cast<std::uint32_t>(mesh.positions.size());
  }
  return bytes_of(triangles);
}

}  // namespace airlight
