#include "common/plan/step_skips.h"

namespace airlight {

namespace {

constexpr std::string_view no_gaussian = "their squares meet no Gaussian", no_surface = "no surface is there",
                           none_through_fog = "no surface is there, or fog hides it";

struct InWords {
  StepSkips operator()(const auto&) const { return {}; }
  StepSkips operator()(const SurfaceVisibility&) const {
    return {"no triangle is in their tile", "triangles", "off the screen or between pixels"};
  }
  StepSkips operator()(const ShadowPlanes&) const {
    return {"no plane is in their tile", "rays of lights", "none of the light's planes is in their tile"};
  }
  StepSkips operator()(const HomogeneousAirlight&) const { return {"others have the same", {}, {}}; }
  StepSkips operator()(const SurfaceAirlight&) const { return {none_through_fog, {}, {}}; }
  StepSkips operator()(const SurfaceShading&) const { return {none_through_fog, {}, {}}; }
  StepSkips operator()(const MeanDepth&) const { return {no_surface, {}, {}}; }
  StepSkips operator()(const LightMarch&) const { return {no_surface, {}, {}}; }
  StepSkips operator()(const HiddenEnvironment&) const { return {no_surface, {}, {}}; }
  StepSkips operator()(const EnvironmentIndirect&) const { return {no_surface, {}, {}}; }
  StepSkips operator()(const DensityInjection&) const { return {{}, "cells of Gaussians", "out of reach"}; }
  StepSkips operator()(const OpticalDepthPropagation&) const { return {{}, "ways of rays through Gaussians", "out of reach"}; }
  StepSkips operator()(const VisibilityNetwork&) const { return {{}, "lists of particles", "empty"}; }
  StepSkips operator()(const SourceFunction&) const { return {{}, "bricks of nodes", "nothing scatters there"}; }
  StepSkips operator()(const RayMarch&) const {
    return {"they meet no medium, or are known from others", "steps along rays", "nothing is seen so far away"};
  }
  StepSkips operator()(const GaussianAirlight&) const {
    return {"their squares meet no Gaussian, or they are known from others", "panels along rays",
            "behind surfaces, or nothing is seen so far away"};
  }
  StepSkips operator()(const ProjectedGaussians&) const { return {no_gaussian, {}, {}}; }
  StepSkips operator()(const ParticleSplats&) const { return {"their squares meet no splat", {}, {}}; }
};

}  // namespace

StepSkips step_skips(const Algorithm& what) { return std::visit(InWords{}, what); }

}  // namespace airlight
