#include "common/reference/paths.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "common/formulas/double.h"
#include "common/reference/phase_sampling.h"

namespace airlight {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

Random::Key key_of(const glm::dvec2& at, std::uint32_t seed) {
  const auto x = std::bit_cast<std::uint64_t>(at.x), y = std::bit_cast<std::uint64_t>(at.y);
  const auto mixed = philox({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(x >> 32), static_cast<std::uint32_t>(y),
                             static_cast<std::uint32_t>(y >> 32)},
                            {seed, 0});
  return {mixed[0], mixed[1]};
}

// The angle at a point light over 0..length of a line, in which places are drawn evenly; no difference of large numbers.
struct AngleAtLight {
  double foot, height, angle;  // [m], [m], [rad]

  AngleAtLight(const glm::dvec3& origin, const glm::dvec3& direction, const RelativeLight& light, double length) {
    const glm::dvec3 way = light.vector - origin;
    foot = glm::dot(direction, way);
    height = std::max(glm::length(way - foot * direction), light.radius);
    angle = std::atan2(length * height, height * height - foot * (length - foot));
  }
  double place(double u) const {
    const double sine = std::sin(u * angle), cosine = std::cos(u * angle);
    return square(0) * sine / (height * cosine + foot * sine);
  }
  double square(double t) const { return height * height + (t - foot) * (t - foot); }  // of the distance from the light
  double density(double t) const { return height / (square(t) * angle); }              // [1/m]
};

}  // namespace

Paths::Paths(const RelativeMedium& medium, const Visibility& visibility, const std::vector<RelativeLight>& lights,
             const EnvironmentLighting* environment, const PathSettings& settings)
    : medium_(medium), visibility_(visibility), lights_(lights), environment_(environment), settings_(settings) {
  near_ = infinity;
  if (!(medium.extinction > 0) || environment) return;
  for (const RelativeLight& light : lights) {
    if (light.directional && light.power != glm::dvec3(0)) return;
    if (!light.directional) begins_.push_back(light.vector);
  }
  for (const Gaussian& one : medium.gaussians) {
    if (one.emission != glm::dvec3(0)) begins_.push_back(one.center);
  }
  double farthest = 0;
  for (const glm::dvec3& place : begins_) farthest = std::max(farthest, glm::length(place));
  near_ = farthest + 3 / (medium.extinction * (1 - std::fabs(medium.phase.g)));
}

// How much light is to be expected at a place, for Russian roulette: any positive function keeps its mean. Fog without bounds may
// absorb nothing; light then comes back from any distance, ever more rarely. Weights that grow as d^1.5 away from the lamps keep
// both the lengths of paths and their variance finite: d^1 leaves the former unbounded, d^2 the latter.
double Paths::importance(const glm::dvec3& point) const {
  if (near_ == infinity) return 1;
  double nearest = infinity;
  for (const glm::dvec3& place : begins_) nearest = std::min(nearest, glm::length(place - point));
  return std::pow(std::min(1.0, near_ / nearest), 1.5);
}

Paths::Vertex Paths::free_flight(const LineInMedium& line, Random& random) const {
  Vertex v;
  v.met = -std::expm1(-line.depth());
  v.t = line.place(-std::log1p(-random.next() * v.met));
  v.extinction = line.extinction(v.t);
  v.scattering = line.scattering(v.t);
  return v;
}

// Light of unit power that arrives at t from the light, is scattered along the line and arrives at its origin [1/m and 1/sr].
glm::dvec3 Paths::scattered_at(const LineInMedium& line, double t, const glm::dvec3& scattering,
                               const RelativeLight& light) const {
  if (scattering == glm::dvec3(0)) return glm::dvec3(0);
  const glm::dvec3 point = line.at(t);
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  if (settings_.shadows && visibility_.blocked(point, none, light)) return glm::dvec3(0);
  double r = 0, mu = 0, falloff = 1;
  if (light.directional) {
    mu = -glm::dot(light.vector, line.direction());
  } else {
    const AngleAtLight seen(line.at(0), line.direction(), light, 0);
    r = std::sqrt(seen.square(t));
    mu = (seen.foot - t) / r;
    falloff = 1 / (r * r);
  }
  const double phase = f64::phase_value(static_cast<int>(medium_.phase.kind), medium_.phase.g, mu);
  return falloff * phase * std::exp(-line.depth(t) - depth_to_light(medium_, point, light, r)) * scattering;
}

// One sample of what the line scatters of a light, its power left out.
glm::dvec3 Paths::scattered(const LineInMedium& line, const Vertex& v, const RelativeLight& light, Random& random) const {
  const auto flight_density = [&](double t, double extinction) { return extinction * std::exp(-line.depth(t)) / v.met; };
  if (light.directional) return scattered_at(line, v.t, v.scattering, light) / flight_density(v.t, v.extinction);
  const AngleAtLight seen(line.at(0), line.direction(), light, line.reach());
  const bool at_flight = random.next() < 0.5;
  const double t = at_flight ? v.t : std::clamp(seen.place(random.next()), 0.0, line.reach());
  const double extinction = at_flight ? v.extinction : line.extinction(t);
  const double density = 0.5 * (flight_density(t, extinction) + seen.density(t));
  return scattered_at(line, t, at_flight ? v.scattering : line.scattering(t), light) / density;
}

// One sample of what is scattered along the line at t of the environment, per unit of scattering.
glm::dvec3 Paths::scattered_environment(const LineInMedium& line, double t, Random& random) const {
  const ScatteredDirection from = scattered_direction(medium_.phase, line.direction(), random);
  LightSource source;
  source.type = LightType::directional;
  source.direction = -from.direction;
  const double depth = depth_to_light(medium_, line.at(t), {source, glm::dvec3(0)}, 0);
  return from.weight * std::exp(-depth) * environment_->radiance(from.direction);
}

void Paths::walk(const LineInMedium& view, Random& random, std::vector<glm::dvec3>& of_light, glm::dvec3& of_others) const {
  std::optional<LineInMedium> flight;  // after the first vertex
  glm::dvec3 weight(1);
  double first = 0;  // largest weight after the first vertex
  for (int order = 1;; ++order) {
    const LineInMedium& line = flight ? *flight : view;
    const Vertex v = free_flight(line, random);
    if (!(v.met > 0 && v.extinction > 0)) return;
    if (order > 1 || settings_.single) {
      for (std::size_t i = 0; i < lights_.size(); ++i) {
        if (lights_[i].power != glm::dvec3(0)) of_light[i] += weight * lights_[i].power * scattered(line, v, lights_[i], random);
      }
    }
    if (order > 1) of_others += weight * (v.met / v.extinction) * line.glow(v.t);
    if (environment_ && (order > 1 || settings_.single))
      of_others += weight * (v.met / v.extinction * v.scattering) * scattered_environment(line, v.t, random);
    if (order == settings_.max_bounces) return;
    weight *= v.met / v.extinction * v.scattering;
    if (order == 1) first = largest(weight);

    // Russian roulette below a fifth of what the path began with.
    const glm::dvec3 point = line.at(v.t);
    const double survives = 5 * largest(weight) / first * importance(point);
    if (!(survives >= 1)) {
      if (!(random.next() < survives)) return;
      weight /= survives;
    }
    const ScatteredDirection to = scattered_direction(medium_.phase, line.direction(), random);
    weight *= to.weight;
    flight.emplace(medium_, point, to.direction, settings_.shadows ? visibility_.free_length(point, to.direction) : infinity);
  }
}

PathEstimate Paths::along(const LineInMedium& view, const glm::dvec2& at, const Progress* stop) const {
  PathEstimate estimate;
  estimate.of_light.resize(lights_.size());
  if (!(-std::expm1(-view.depth()) > 0)) return estimate;
  const Random::Key key = key_of(at, settings_.seed);
  std::vector<glm::dvec3> of_light(lights_.size());
  glm::dvec3 mean(0), squares(0);  // of the sum over the lights; squares of distances from the mean, as Welford 1962
  for (int path = 0; path < settings_.paths; ++path) {
    if (stop && path % 64 == 0) stop->check();
    std::fill(of_light.begin(), of_light.end(), glm::dvec3(0));
    Random random(key, static_cast<std::uint64_t>(path));
    glm::dvec3 sum(0);
    walk(view, random, of_light, sum);
    const double n = path + 1;
    estimate.of_others += (sum - estimate.of_others) / n;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      sum += of_light[i];
      estimate.of_light[i] += (of_light[i] - estimate.of_light[i]) / n;
    }
    const glm::dvec3 apart = sum - mean;
    mean += apart / n;
    squares += apart * (sum - mean);
  }
  const double n = settings_.paths;
  estimate.standard_error = glm::sqrt(squares / (n * (n - 1)));
  return estimate;
}

}  // namespace airlight
