// Tables of which a part is kept in 16 bits.
#pragma once

#include <cstddef>

#include "gpu/step_runner.h"

namespace airlight {

// As pack_halves() in cpu/halves.h, from the step's buffer `number`.
void pack_halves(StepRunner&, GLuint number, std::size_t head, std::size_t count, float scale, const Buffer& to);

}  // namespace airlight
