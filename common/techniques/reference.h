#pragma once

#include "common/techniques/technique.h"

namespace airlight {

// Ground truth in double precision (common/reference): it has knobs like any technique, but no plan and no backend.
Technique reference_technique();

}  // namespace airlight
