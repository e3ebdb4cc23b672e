// A table of floats becomes one of which a part is kept in 16 bits (common/half.h): an invocation a float of the new one.
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer TableBuffer { float table_of_floats[]; };
layout(std430, binding = 1) writeonly buffer PackedBuffer { uint packed_words[]; };

uniform int first_item;
uniform int head;   // floats that stay as they are
uniform int count;  // halves after them
uniform int words;  // that these take
uniform int end;    // of the new table
uniform float scale;

uint half_of(int i) {
  if (i >= count) return 0u;
  float held = min(table_of_floats[head + i] * scale, 65504.0);
  uint bits = floatBitsToUint(held);
  uint normal = ((bits + 0xfffu + ((bits >> 13) & 1u)) >> 13) - 0x1c000u;
  uint tiny = floatBitsToUint(held + 0.5) - 0x3f000000u;
  return bits < 0x38800000u ? tiny : normal;
}

void main() {
  int n = first_item + int(gl_WorkGroupID.x) * 64 + int(gl_LocalInvocationIndex);
  if (n >= end) return;
  int word = n - head;
  if (word < 0) packed_words[n] = floatBitsToUint(table_of_floats[n]);
  else if (word < words) packed_words[n] = half_of(2 * word) | (half_of(2 * word + 1) << 16);
  else packed_words[n] = floatBitsToUint(table_of_floats[n - words + count]);
}
