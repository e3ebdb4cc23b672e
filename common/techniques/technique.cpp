#include "common/techniques/technique.h"

#include "common/error.h"
#include "common/spelling.h"
#include "common/techniques/gaussian_airlight.h"
#include "common/techniques/illumination_network.h"
#include "common/techniques/marching.h"
#include "common/techniques/opacity_propagation.h"
#include "common/techniques/reference.h"
#include "common/techniques/shadow_planes.h"

namespace airlight {

std::span<const Technique> techniques() {
  static const std::vector<Technique> all{shadow_planes(),        gaussian_airlight(), opacity_propagation(),
                                          illumination_network(), marching(),          reference_technique()};
  return all;
}

const Technique& technique(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Technique& t : techniques()) {
    if (t.name == name) return t;
    known.push_back(t.name);
  }
  throw InputError("unknown technique \"" + std::string(name) + "\", expected " + joined(known, " | "));
}

}  // namespace airlight
