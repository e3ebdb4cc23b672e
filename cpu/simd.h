// The SIMD build of the formulas, namespace airlight::HWY_NAMESPACE: one lane a work item, so that every target gives the same
// bits. Included after hwy/foreach_target.h by each kernel file, anew for every target (so: a guard that toggles, not #pragma
// once).
#if defined(AIRLIGHT_CPU_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_SIMD_H
#undef AIRLIGHT_CPU_SIMD_H
#else
#define AIRLIGHT_CPU_SIMD_H
#endif

#include <hwy/highway.h>
#include <cmath>
#include <cstdint>

#include "common/half.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using Vec = hn::Vec<Floats>;
using IntVec = hn::Vec<Ints>;
constexpr int lanes = HWY_TARGET == HWY_SCALAR ? 1 : HWY_MIN(16, HWY_MAX_BYTES / 4);

struct Mask {
  hn::Mask<Floats> m;
};
HWY_INLINE Mask operator&&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE Mask operator||(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE Mask operator!(Mask a) { return {hn::Not(a.m)}; }
HWY_INLINE bool any_lane(Mask a) { return !hn::AllFalse(Floats(), a.m); }

struct Real {
  Vec v;
  Real() = default;  // trivial: a constructor that the compiler makes for a struct of these has no target
  HWY_INLINE Real(Vec x) : v(x) {}
  HWY_INLINE Real(double x) : v(hn::Set(Floats(), static_cast<float>(x))) {}
  HWY_INLINE Real(int x) : v(hn::Set(Floats(), static_cast<float>(x))) {}
  HWY_INLINE Real(float x) : v(hn::Set(Floats(), x)) {}
  HWY_INLINE Real& operator+=(Real b);
  HWY_INLINE Real& operator-=(Real b);
  HWY_INLINE Real& operator*=(Real b);
};
HWY_INLINE Real operator+(Real a, Real b) { return hn::Add(a.v, b.v); }
HWY_INLINE Real operator-(Real a, Real b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Real operator*(Real a, Real b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Real operator/(Real a, Real b) { return hn::Div(a.v, b.v); }
HWY_INLINE Real operator-(Real a) { return hn::Neg(a.v); }
HWY_INLINE Real& Real::operator+=(Real b) { return *this = *this + b; }
HWY_INLINE Real& Real::operator-=(Real b) { return *this = *this - b; }
HWY_INLINE Real& Real::operator*=(Real b) { return *this = *this * b; }
HWY_INLINE Mask operator<(Real a, Real b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE Mask operator<=(Real a, Real b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE Mask operator>(Real a, Real b) { return {hn::Gt(a.v, b.v)}; }
HWY_INLINE Mask operator>=(Real a, Real b) { return {hn::Ge(a.v, b.v)}; }

HWY_INLINE Real load(const float* p) { return hn::LoadU(Floats(), p); }
HWY_INLINE void store(Real a, float* p) { hn::StoreU(a.v, Floats(), p); }
HWY_INLINE Real first_lanes() { return hn::ConvertTo(Floats(), hn::Iota(Ints(), 0)); }  // 0, 1, 2 ...

#define FORMULA HWY_INLINE
#define OUT(type) type&
#define IN_LIST(name, count) const real* name
#define OUT_LIST(name, count) real* name
#define IN_OUT_LIST(name, count) real* name
#define EXACT

using real = Real;
using mask = Mask;
using table = const float*;

HWY_INLINE real select(mask m, real a, real b) { return hn::IfThenElse(m.m, a.v, b.v); }
HWY_INLINE real sqrt(real x) { return hn::Sqrt(x.v); }
HWY_INLINE real abs(real x) { return hn::Abs(x.v); }
// a < b ? a : b in every bit, zeros of both signs among them: what x86 does by itself. Other targets' Min and Max differ there.
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
HWY_INLINE real min(real a, real b) { return hn::Min(a.v, b.v); }
HWY_INLINE real max(real a, real b) { return hn::Max(a.v, b.v); }
#else
HWY_INLINE real min(real a, real b) { return select(a < b, a, b); }
HWY_INLINE real max(real a, real b) { return select(a > b, a, b); }
#endif
HWY_INLINE real floor(real x) { return hn::Floor(x.v); }
HWY_INLINE real fma(real a, real b, real c) {
#if HWY_TARGET == HWY_SCALAR  // Highway's own is not fused there
  return hn::Set(Floats(), std::fma(hn::GetLane(a.v), hn::GetLane(b.v), hn::GetLane(c.v)));
#else
  return hn::MulAdd(a.v, b.v, c.v);
#endif
}
HWY_INLINE real round_even(real x) { return hn::Round(x.v); }
HWY_INLINE IntVec to_int(real x) { return hn::ConvertTo(Ints(), x.v); }
HWY_INLINE real exp2_int(real n) { return hn::BitCast(Floats(), hn::ShiftLeft<23>(hn::Add(to_int(n), hn::Set(Ints(), 127)))); }
HWY_INLINE real exponent_of(real x) {
  return hn::ConvertTo(Floats(), hn::Sub(hn::ShiftRight<23>(hn::BitCast(Ints(), x.v)), hn::Set(Ints(), 127)));
}
HWY_INLINE real mantissa_of(real x) {
  const Ints di;
  return hn::BitCast(Floats(), hn::Or(hn::And(hn::BitCast(di, x.v), hn::Set(di, 0x007fffff)), hn::Set(di, 0x3f800000)));
}
HWY_INLINE real fetch(table t, real i) { return hn::GatherIndex(Floats(), t, to_int(i)); }
HWY_INLINE real element(table t, int i) { return t[i]; }
HWY_INLINE int integer_element(table t, int i) { return static_cast<int>(t[i]); }
// Neighbouring pixels mostly need the same patch: each different one is read once, for all lanes that need it.
HWY_INLINE real weighted_patch(table t, real at, int stride, real a0, real a1, real a2, real a3, real b0, real b1, real b2,
                               real b3) {
  const Ints di;
  const IntVec index = to_int(at);
  HWY_ALIGN std::int32_t where[lanes];
  hn::Store(index, di, where);
  const auto row = [&](const float* q)
                       HWY_ATTR { return fma(b0, real(q[0]), fma(b1, real(q[1]), fma(b2, real(q[2]), b3 * real(q[3])))); };
  real result = 0.0;
  auto waiting = hn::Eq(index, index);
  do {
    const std::int32_t first = where[hn::FindFirstTrue(di, waiting)];
    const float* p = t + first;
    const auto here = hn::Eq(index, hn::Set(di, first));
    const real value = fma(a0, row(p), fma(a1, row(p + stride), fma(a2, row(p + 2 * stride), a3 * row(p + 3 * stride))));
    result = hn::IfThenElse(hn::RebindMask(Floats(), here), value.v, result.v);
    waiting = hn::AndNot(here, waiting);
  } while (!hn::AllFalse(di, waiting));
  return result;
}
// Elements of a table, floats or halves, made floats: one; as many as there are lanes from q on, of floats no more than
// `readable`; those with numbers i and i + 1, by one load, for a gather costs by the element.
HWY_INLINE Real value_of(float x) { return x; }
HWY_INLINE Real value_of(std::uint16_t half) { return float_of(half); }
#if HWY_TARGET != HWY_SCALAR
using Halves = hn::Rebind<std::uint16_t, Floats>;
HWY_INLINE Vec widened(hn::Vec<Halves> halves) {
  return hn::PromoteTo(Floats(), hn::BitCast(hn::Rebind<hwy::float16_t, Floats>(), halves));
}
HWY_INLINE Vec values_from(const float* q, hn::Mask<Floats> readable) { return hn::MaskedLoad(readable, Floats(), q); }
HWY_INLINE Vec values_from(const std::uint16_t* q, hn::Mask<Floats>) { return widened(hn::LoadU(Halves(), q)); }
HWY_INLINE void gather_pairs(const float* t, IntVec i, Vec& left, Vec& right) {
  const hn::RepartitionToWide<Ints> pairs;
  const hn::Rebind<std::int32_t, decltype(pairs)> half;
  const auto* from = reinterpret_cast<const std::int64_t*>(t);
  const IntVec bytes = hn::ShiftLeft<2>(i);
  const auto low = hn::GatherOffset(pairs, from, hn::PromoteTo(pairs, hn::LowerHalf(half, bytes)));
  const auto high = hn::GatherOffset(pairs, from, hn::PromoteTo(pairs, hn::UpperHalf(half, bytes)));
  const Vec a = hn::BitCast(Floats(), low), b = hn::BitCast(Floats(), high);
  left = hn::ConcatEven(Floats(), b, a);
  right = hn::ConcatOdd(Floats(), b, a);
}
HWY_INLINE void gather_pairs(const std::uint16_t* t, IntVec i, Vec& left, Vec& right) {
  const Ints di;
  const IntVec both = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(t), hn::ShiftLeft<1>(i));
  left = widened(hn::DemoteTo(Halves(), hn::And(both, hn::Set(di, 0xffff))));
  right = widened(hn::DemoteTo(Halves(), hn::ShiftRight<16>(both)));
}
#endif
// The value between eight neighbouring elements of a box, as common/formulas/README.md tells.
template <class T>
HWY_INLINE real weighted_cell_of(const T* t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  const IntVec width = to_int(nx), layer_size = hn::Mul(width, to_int(ny));
  const IntVec index = hn::Add(to_int(x), hn::Add(hn::Mul(width, to_int(y)), hn::Mul(layer_size, to_int(z))));
  const auto between = [](Real a, Real b, Real weight) HWY_ATTR { return fma(weight, b - a, a); };
#if HWY_TARGET == HWY_SCALAR
  const auto row = [&](const T* q) { return between(value_of(q[0]), value_of(q[1]), u); };
  const auto layer = [&](const T* q) { return between(row(q), row(q + hn::GetLane(width)), v); };
  const T* p = t + hn::GetLane(index);
  return between(layer(p), layer(p + hn::GetLane(layer_size)), w);
#else
  const Ints di;
  // Neighbouring pixels mostly lie in a few rows of cells: a vector from each row serves all lanes that lie in it, until one
  // serves too few; the others are gathered.
  HWY_ALIGN std::int32_t where[lanes];
  hn::Store(index, di, where);
  const std::int32_t next_row = hn::GetLane(width), next_layer = hn::GetLane(layer_size);
  Real result = 0.0;
  auto waiting = hn::Eq(index, index);
  for (bool few = false; !few;) {
    // What lies between two lanes' cells is there to be read.
    const std::int32_t first = where[hn::FindFirstTrue(di, waiting)], last = where[lanes - 1];
    const std::int32_t begin = first <= last ? first : HWY_MAX(last, first - (lanes - 2));
    const std::int32_t read = HWY_MIN(HWY_MAX(first, last) - begin + 2, lanes);
    const IntVec offset = hn::Sub(index, hn::Set(di, begin));
    const auto here = hn::And(hn::Gt(offset, hn::Set(di, -1)), hn::Lt(offset, hn::Set(di, read - 1)));
    few = hn::CountTrue(di, hn::And(here, waiting)) * 5 < lanes;
    if (few) break;
    const IntVec inside = hn::And(offset, hn::Set(di, lanes - 1));
    const auto left = hn::IndicesFromVec(Floats(), inside);
    const auto right = hn::IndicesFromVec(Floats(), hn::And(hn::Add(inside, hn::Set(di, 1)), hn::Set(di, lanes - 1)));
    const auto readable = hn::FirstN(Floats(), static_cast<std::size_t>(read));
    const auto row = [&](const T* q) HWY_ATTR {
      const Vec cells = values_from(q, readable);
      return between(Real(hn::TableLookupLanes(cells, left)), Real(hn::TableLookupLanes(cells, right)), u);
    };
    const auto layer = [&](const T* q) HWY_ATTR { return between(row(q), row(q + next_row), v); };
    const T* p = t + begin;
    const Real value = between(layer(p), layer(p + next_layer), w);
    result = hn::IfThenElse(hn::RebindMask(Floats(), here), value.v, result.v);
    waiting = hn::AndNot(here, waiting);
    if (hn::AllFalse(di, waiting)) return result;
  }
  const auto row = [&](IntVec i) HWY_ATTR {
    Vec left, right;
    gather_pairs(t, i, left, right);
    return between(left, right, u);
  };
  const auto layer = [&](IntVec i) HWY_ATTR { return between(row(i), row(hn::Add(i, width)), v); };
  const Real gathered = between(layer(index), layer(hn::Add(index, layer_size)), w);
  return hn::IfThenElse(hn::RebindMask(Floats(), waiting), gathered.v, result.v);
#endif
}

HWY_INLINE real weighted_cell(table t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  return weighted_cell_of(t, x, y, z, nx, ny, u, v, w);
}
HWY_INLINE real weighted_half_cell(table t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  return weighted_cell_of(reinterpret_cast<const std::uint16_t*>(t), x, y, z, nx, ny, u, v, w);
}

#include "common/formulas/elementary.h"
#include "common/formulas/formulas.h"

#undef FORMULA
#undef OUT
#undef IN_LIST
#undef OUT_LIST
#undef IN_OUT_LIST
#undef EXACT
}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
