// The rules by which a plan leaves out what a scene does not need. --explain and --stats call them by these names;
// docs/RESULTS.md tells what each gains, and which test shows that the image stays as it is.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace airlight {

enum class Rule {
  unchanged,
  dark_lights,
  lamps_out_of_reach,
  no_scattering,
  no_tables,
  no_shadows,
  casters_out_of_reach,
  tiles_without_planes,
  behind_fog,
  no_indirect,
  no_light_march,
  no_reflectances,
  environment_airlight,
  environment_shadows,
  environment_indirect,
  no_depth_lattice,
  empty_gaussians,
  coincident_gaussians,
  out_of_view,
  no_nodes,
  no_noise,
  no_light_volumes,
  no_injection,
  homogeneous,
  every_pixel,
  no_fog,
  even_airlight,
  splatted,
  no_network,
  unhindered_network,
};

// Each rule with its name; in the order of the enumeration.
constexpr std::array<std::pair<Rule, std::string_view>, 30> rule_names{{
    {Rule::unchanged, "unchanged"},                        // a step whose inputs are those of a frame before
    {Rule::dark_lights, "dark-lights"},                    // lights without power
    {Rule::lamps_out_of_reach, "lamps-out-of-reach"},      // lamps whose light fog swallows before the camera
    {Rule::no_scattering, "no-scattering"},                // airlight where nothing scatters
    {Rule::no_tables, "no-tables"},                        // airlight tables where no lamp shines in fog
    {Rule::no_shadows, "no-shadows"},                      // shadow planes where nothing throws a shadow that can be seen
    {Rule::casters_out_of_reach, "casters-out-of-reach"},  // their silhouettes, where fog swallows the light before them
    {Rule::tiles_without_planes, "tiles-without-planes"},  // lit parts where no plane is met
    {Rule::behind_fog, "behind-fog"},                      // light on surfaces that fog hides
    {Rule::no_indirect, "no-indirect"},                    // light scattered onto surfaces where there is none
    {Rule::no_light_march, "no-light-march"},              // the lights' way through Gaussians to surfaces
    {Rule::no_reflectances, "no-reflectances"},            // tabulated reflectances without lights
    {Rule::environment_airlight, "environment-airlight"},  // what no medium scatters of an environment
    {Rule::environment_shadows, "environment-shadows"},    // what nothing hides of it
    {Rule::environment_indirect, "environment-indirect"},  // what nothing scatters of it onto surfaces
    {Rule::no_depth_lattice, "no-depth-lattice"},          // mean depths on lattices, where those of pixels are faster
    {Rule::empty_gaussians, "empty-gaussians"},            // Gaussians without extinction
    {Rule::coincident_gaussians, "coincident-gaussians"},  // Gaussians that lie on others of the same radius
    {Rule::out_of_view, "out-of-view"},                    // Gaussians that no ray meets
    {Rule::no_nodes, "no-nodes"},                          // nodes along view rays on which nothing shines
    {Rule::no_noise, "no-noise"},                          // noise without Gaussians
    {Rule::no_light_volumes, "no-light-volumes"},          // volumes of depths toward lights, where closed forms are faster
    {Rule::no_injection, "no-injection"},                  // a grid of the extinction, where closed forms are faster
    {Rule::homogeneous, "homogeneous"},                    // marching toward lights through fog alone
    {Rule::every_pixel, "every-pixel"},                    // low-resolution airlight where it gains nothing
    {Rule::no_fog, "no-fog"},                              // marching of fog beside splats
    {Rule::even_airlight, "even-airlight"},                // rays through fog that have what others of their length have
    {Rule::splatted, "splatted"},                          // the source function of particles that are seen themselves
    {Rule::no_network, "no-network"},                      // particles that stand for nothing
    {Rule::unhindered_network, "unhindered-network"},      // surfaces between particles: an approximation, not a gain
}};

constexpr std::string_view name_of(Rule rule) { return rule_names[static_cast<std::size_t>(rule)].second; }

}  // namespace airlight
