#include "gpu/halves.h"

#include "common/half.h"

namespace airlight {

void pack_halves(StepRunner& r, GLuint number, std::size_t head, std::size_t count, float scale, const Buffer& to) {
  Program& program = r.compute("gpu/pack_halves.glsl", {});
  const std::size_t floats = to.bytes / sizeof(float);
  program.set("head", static_cast<int>(head));
  program.set("count", static_cast<int>(count));
  program.set("words", static_cast<int>(floats_of_halves(count)));
  program.set("end", static_cast<int>(floats));
  program.set("scale", scale);
  r.bind(0, number);
  r.storage(1, to);
  r.each(program, floats, 64);
}

}  // namespace airlight
