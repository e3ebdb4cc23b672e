// Opacity propagation (Giroud and Biri): the medium's extinction is put on a grid, the optical depth from each light is carried
// through it once, and view rays are marched with a lookup where marching has a way to each light.
#pragma once

#include "common/techniques/technique.h"

namespace airlight {

Technique opacity_propagation();

}  // namespace airlight
