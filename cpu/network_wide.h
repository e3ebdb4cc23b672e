// What four particles send or take, rgb and an unused float each, in as many vectors as that needs. Included after cpu/simd.h,
// anew for every target.
#if defined(AIRLIGHT_CPU_NETWORK_WIDE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_NETWORK_WIDE_H
#undef AIRLIGHT_CPU_NETWORK_WIDE_H
#else
#define AIRLIGHT_CPU_NETWORK_WIDE_H
#endif

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

constexpr int wide_vectors = 16 / lanes;

// Element 4 i + c is channel c of particle i.
struct Wide {
  Real v[wide_vectors];
};

HWY_INLINE Wide wide_load(const float* p) {
  Wide w;
  for (int q = 0; q < wide_vectors; ++q) w.v[q] = load(p + q * lanes);
  return w;
}
HWY_INLINE void wide_store(const Wide& w, float* p) {
  for (int q = 0; q < wide_vectors; ++q) store(w.v[q], p + q * lanes);
}
HWY_INLINE Wide wide_zero() {
  Wide w;
  for (int q = 0; q < wide_vectors; ++q) w.v[q] = 0.0;
  return w;
}
HWY_INLINE Wide wide_sum(const Wide& a, const Wide& b) {
  Wide w;
  for (int q = 0; q < wide_vectors; ++q) w.v[q] = a.v[q] + b.v[q];
  return w;
}
HWY_INLINE Wide wide_difference(const Wide& a, const Wide& b) {
  Wide w;
  for (int q = 0; q < wide_vectors; ++q) w.v[q] = a.v[q] - b.v[q];
  return w;
}

// Four times the same.
HWY_INLINE Wide wide_same(const float* rgb) {
  HWY_ALIGN float values[16];
  for (int e = 0; e < 16; ++e) values[e] = rgb[e % 4];
  return wide_load(values);
}

// Four rows of a table of particles.
HWY_INLINE Wide wide_at(const float* rows, const std::int32_t* which) {
  Wide w;
#if HWY_TARGET == HWY_SCALAR
  for (int e = 0; e < 16; ++e) w.v[e] = rows[4 * static_cast<std::ptrdiff_t>(which[e / 4]) + e % 4];
#else
  using Four = hn::FixedTag<float, 4>;
  const auto row = [&](int i) HWY_ATTR { return hn::LoadU(Four(), rows + 4 * static_cast<std::ptrdiff_t>(which[i])); };
#if HWY_MAX_BYTES == 16
  for (int q = 0; q < wide_vectors; ++q) w.v[q] = row(q);
#elif HWY_MAX_BYTES == 32
  for (int q = 0; q < wide_vectors; ++q) w.v[q] = hn::Combine(Floats(), row(2 * q + 1), row(2 * q));
#else
  using Eight = hn::FixedTag<float, 8>;
  w.v[0] = hn::Combine(Floats(), hn::Combine(Eight(), row(3), row(2)), hn::Combine(Eight(), row(1), row(0)));
#endif
#endif
  return w;
}

// Adds to four rows, one after the other: the rows may be the same.
HWY_INLINE void wide_add(const Wide& w, const Wide& weight, const std::int32_t* which, float* rows) {
  HWY_ALIGN float values[16];
  for (int q = 0; q < wide_vectors; ++q) store(weight.v[q] * w.v[q], values + q * lanes);
  for (int i = 0; i < 4; ++i) {
    float* row = rows + 4 * static_cast<std::ptrdiff_t>(which[i]);
#if HWY_TARGET == HWY_SCALAR
    for (int c = 0; c < 4; ++c) row[c] += values[4 * i + c];
#else
    using Four = hn::FixedTag<float, 4>;
    hn::StoreU(hn::Add(hn::LoadU(Four(), row), hn::Load(Four(), values + 4 * i)), Four(), row);
#endif
  }
}

// One number a list, for all of its channels.
HWY_INLINE Wide each_list(const float* one) {
  Wide w;
#if HWY_MAX_BYTES < 32
  for (int q = 0; q < wide_vectors; ++q) w.v[q] = one[q * lanes / 4];
#else
  HWY_ALIGN std::int32_t where[lanes];
  const auto four = hn::LoadDup128(Floats(), one);
  for (int q = 0; q < wide_vectors; ++q) {
    for (int i = 0; i < lanes; ++i) where[i] = (q * lanes + i) / 4;
    w.v[q] = hn::TableLookupLanes(four, hn::SetTableIndices(Floats(), where));
  }
#endif
  return w;
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
