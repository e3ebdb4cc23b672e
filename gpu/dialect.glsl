// The GLSL build of the formulas (common/formulas/README.md): real is float.
#define real float
#define mask bool
#define table int
#define FORMULA
#define OUT(type) out type
#define IN_LIST(name, count) real name[count]
#define OUT_LIST(name, count) out real name[count]
#define IN_OUT_LIST(name, count) inout real name[count]
#define EXACT precise

// Every table of a step lies in this buffer; a `table` is where it begins.
layout(std430, binding = 7) readonly buffer Tables { float table_values[]; };

bool any_lane(mask m) { return m; }
real select(mask m, real a, real b) { return m ? a : b; }
real round_even(real x) { return roundEven(x); }
real exp2_int(real n) { return intBitsToFloat((int(n) + 127) << 23); }
real exponent_of(real x) { return float((floatBitsToInt(x) >> 23) - 127); }
real mantissa_of(real x) { return intBitsToFloat((floatBitsToInt(x) & 0x007fffff) | 0x3f800000); }
real fetch(table t, real i) { return table_values[t + int(i)]; }
real element(table t, int i) { return table_values[t + i]; }
int integer_element(table t, int i) { return int(table_values[t + i]); }

// sum_ik a_i b_k t[at + i stride + k], i and k in 0..3.
real weighted_row(int p, real b0, real b1, real b2, real b3) {
  return fma(b0, table_values[p], fma(b1, table_values[p + 1], fma(b2, table_values[p + 2], b3 * table_values[p + 3])));
}
real weighted_patch(table t, real at, int stride, real a0, real a1, real a2, real a3, real b0, real b1, real b2, real b3) {
  int p = t + int(at);
  return fma(a0, weighted_row(p, b0, b1, b2, b3),
             fma(a1, weighted_row(p + stride, b0, b1, b2, b3),
                 fma(a2, weighted_row(p + 2 * stride, b0, b1, b2, b3), a3 * weighted_row(p + 3 * stride, b0, b1, b2, b3))));
}

// Element p of the buffer and the next; of halves, counted from its beginning, as common/half.h has them: an unpacked tiny one would be
// flushed to 0 on the way.
real half_value(int p) {
  int word = floatBitsToInt(table_values[p >> 1]);
  int bits = (word >> (16 * (p & 1))) & 0x7fff;
  return bits < 0x400 ? float(bits) * (1.0 / 16777216.0) : intBitsToFloat((bits << 13) + 0x38000000);
}
real weighted_pair(bool halves, int p, real u) {
  real a = halves ? half_value(p) : table_values[p];
  real b = halves ? half_value(p + 1) : table_values[p + 1];
  return fma(u, b - a, a);
}
// The value between eight neighbouring elements of a box, as common/formulas/README.md tells. `halves` is a constant.
real weighted_cell_of(bool halves, int first, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  int width = int(nx);
  int layer = width * int(ny);
  int p = first + int(x) + width * int(y) + layer * int(z);
  real a = weighted_pair(halves, p, u);
  real near_layer = fma(v, weighted_pair(halves, p + width, u) - a, a);
  p += layer;
  real b = weighted_pair(halves, p, u);
  real far_layer = fma(v, weighted_pair(halves, p + width, u) - b, b);
  return fma(w, far_layer - near_layer, near_layer);
}
real weighted_cell(table t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  return weighted_cell_of(false, t, x, y, z, nx, ny, u, v, w);
}
real weighted_half_cell(table t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  return weighted_cell_of(true, 2 * t, x, y, z, nx, ny, u, v, w);
}

#include "common/formulas/elementary.h"
#include "common/formulas/formulas.h"
