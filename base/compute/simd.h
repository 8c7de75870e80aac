// Vectors of 4 or 8 floats whose operators work per lane (GCC's vector extension). For kernels only
// (see instruction_set.h), whose files throng_kernels() of cmake/Modules.cmake lists.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// Vectors are used in inlined functions only, so the ABI of vector arguments does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace throng {

using Float4 [[gnu::vector_size(16)]] = float;
using Float8 [[gnu::vector_size(32)]] = float;
/// Masks, the results of comparisons: -1 for true, 0 for false.
using Int4 [[gnu::vector_size(16)]] = std::int32_t;
using Int8 [[gnu::vector_size(32)]] = std::int32_t;

inline Float4 low_half(Float8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
inline Float4 high_half(Float8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }
inline Int4 low_half(Int8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
inline Int4 high_half(Int8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }

/// Returns the mask as bits: bit i is set if lane i is true.
inline unsigned movemask(Int4 mask) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return (mask[0] & 1U) | (mask[1] & 2U) | (mask[2] & 4U) | (mask[3] & 8U);
#endif
}
inline unsigned movemask(Int8 mask) {
  return movemask(low_half(mask)) | (movemask(high_half(mask)) << 4U);
}

/// Whether a lane of the mask is true.
inline bool any(Int4 mask) { return movemask(mask) != 0; }
inline bool any(Int8 mask) { return any(low_half(mask) | high_half(mask)); }

/// Minimum and maximum per lane; b if a or b is NaN.
template <typename Vector>
Vector smaller(Vector a, Vector b) {
  return a < b ? a : b;
}
template <typename Vector>
Vector greater(Vector a, Vector b) {
  return a > b ? a : b;
}

/// Minimum and maximum of all lanes.
inline float lowest(Float4 v) {
  v = smaller(v, __builtin_shufflevector(v, v, 2, 3, 2, 3));
  return smaller(v, __builtin_shufflevector(v, v, 1, 1, 1, 1))[0];
}
inline float highest(Float4 v) {
  v = greater(v, __builtin_shufflevector(v, v, 2, 3, 2, 3));
  return greater(v, __builtin_shufflevector(v, v, 1, 1, 1, 1))[0];
}
inline float lowest(Float8 v) { return lowest(smaller(low_half(v), high_half(v))); }
inline float highest(Float8 v) { return highest(greater(low_half(v), high_half(v))); }

/// The vector types with kWidth lanes.
template <int kWidth>
struct Vectors;

template <>
struct Vectors<4> {
  using Float = Float4;
  using Int = Int4;
  static constexpr Int kIndex = {0, 1, 2, 3};
};

template <>
struct Vectors<8> {
  using Float = Float8;
  using Int = Int8;
  static constexpr Int kIndex = {0, 1, 2, 3, 4, 5, 6, 7};
};

/// Returns a vector with the same value in all lanes.
template <int kWidth>
typename Vectors<kWidth>::Float broadcast(float value) {
  return value - typename Vectors<kWidth>::Float{};
}

template <int kWidth>
typename Vectors<kWidth>::Float load(const float* from) {
  typename Vectors<kWidth>::Float v;
  std::memcpy(&v, from, sizeof(v));
  return v;
}

template <int kWidth>
typename Vectors<kWidth>::Int load(const std::int32_t* from) {
  typename Vectors<kWidth>::Int v;
  std::memcpy(&v, from, sizeof(v));
  return v;
}

template <typename Vector, typename Value>
void store(Vector v, Value* to) {
  static_assert(sizeof(v[0]) == sizeof(Value));
  std::memcpy(to, &v, sizeof(v));
}

/// Source lanes of a compress-store, for each mask: [bits][lane].
inline constexpr auto kPackedLanes = [] {
  std::array<std::array<std::int32_t, 8>, 256> lanes{};
  for (std::size_t mask = 0; mask < lanes.size(); ++mask) {
    std::size_t count = 0;
    for (int lane = 0; lane < 8; ++lane) {
      if ((mask >> lane & 1U) != 0) lanes[mask][count++] = lane;
    }
  }
  return lanes;
}();

/// Stores the lanes of two vectors for which the mask is true, consecutively. Returns their number;
/// memory behind them, up to a whole vector, may be overwritten.
template <int kWidth>
std::size_t compress_store(typename Vectors<kWidth>::Float a, typename Vectors<kWidth>::Int b,
                           typename Vectors<kWidth>::Int mask, float* to_a, std::int32_t* to_b) {
#if !defined(__clang__)  // clang has no shuffle with variable indices
  if constexpr (kWidth == 8) {
    const unsigned which = movemask(mask);
    const Int8 from = load<8>(kPackedLanes[which].data());
    store(__builtin_shuffle(a, from), to_a);
    store(__builtin_shuffle(b, from), to_b);
    return static_cast<std::size_t>(__builtin_popcount(which));
  }
#endif
  std::size_t count = 0;
  for (int lane = 0; lane < kWidth; ++lane) {
    to_a[count] = a[lane];
    to_b[count] = b[lane];
    count += mask[lane] != 0 ? 1 : 0;
  }
  return count;
}

template <int kWidth>
typename Vectors<kWidth>::Float square_root(typename Vectors<kWidth>::Float v) {
  for (int i = 0; i < kWidth; ++i) v[i] = std::sqrt(v[i]);
  return v;
}

/// Returns e^x with a relative error of at most 3e-7, equal for all numbers of lanes. x is limited
/// to -87 to 88.
template <typename Float>
Float exponential(Float x) {
  // e^x = 2^k e^r. Adding kRound rounds x / ln 2 to the integer k in the lowest bits.
  using Int = decltype(x < x);
  constexpr float kRound = 12582912;  // 1.5 * 2^23
  constexpr float kLn2High = 0.693359375F;
  constexpr float kLn2Low = -2.12194440e-4F;
  x = smaller(greater(x, Float{} - 87), Float{} + 88);
  const Float shifted = x * 1.44269504F + kRound;
  const Float k = shifted - kRound;
  const Float r = x - k * kLn2High - k * kLn2Low;
  // Polynomial that interpolates e^r at Chebyshev points.
  Float p = 0.0013941213255748153F * r + 0.008375209756195545F;
  p = p * r + 0.04166635125875473F;
  p = p * r + 0.16666413843631744F;
  p = p * r + 0.5F;
  p = p * r + 1;
  p = p * r + 1;
  constexpr std::int32_t kShiftedZero = 0x4B400000;  // the bits of kRound
  const Int exponent = reinterpret_cast<Int>(shifted) - kShiftedZero;
  const Int power = (exponent + 127) << 23;
  return p * reinterpret_cast<Float>(power);
}
inline float exponential(float x) { return exponential(Float4{} + x)[0]; }

/// Transposes records of four numbers to four vectors.
inline void transpose(const std::array<Float4, 4>& r, Float4& a, Float4& b, Float4& c, Float4& d) {
  const Float4 ab_low = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5);
  const Float4 cd_low = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7);
  const Float4 ab_high = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5);
  const Float4 cd_high = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
  a = __builtin_shufflevector(ab_low, ab_high, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_low, ab_high, 2, 3, 6, 7);
  c = __builtin_shufflevector(cd_low, cd_high, 0, 1, 4, 5);
  d = __builtin_shufflevector(cd_low, cd_high, 2, 3, 6, 7);
}

/// Splits pairs of numbers into two vectors.
inline void deinterleave(Float4 first, Float4 second, Float4& a, Float4& b) {
  a = __builtin_shufflevector(first, second, 0, 2, 4, 6);
  b = __builtin_shufflevector(first, second, 1, 3, 5, 7);
}
inline void deinterleave(Float8 first, Float8 second, Float8& a, Float8& b) {
  a = __builtin_shufflevector(first, second, 0, 2, 4, 6, 8, 10, 12, 14);
  b = __builtin_shufflevector(first, second, 1, 3, 5, 7, 9, 11, 13, 15);
}

/// Combines two vectors to pairs: the inverse of deinterleave().
inline void interleave(Float4 a, Float4 b, Float4& first, Float4& second) {
  first = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  second = __builtin_shufflevector(a, b, 2, 6, 3, 7);
}
inline void interleave(Float8 a, Float8 b, Float8& first, Float8& second) {
  first = __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
  second = __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
}

inline Float8 join(Float4 low, Float4 high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

inline void transpose(const std::array<Float4, 8>& r, Float8& a, Float8& b, Float8& c, Float8& d) {
  const Float8 r0 = join(r[0], r[4]);
  const Float8 r1 = join(r[1], r[5]);
  const Float8 r2 = join(r[2], r[6]);
  const Float8 r3 = join(r[3], r[7]);
  const Float8 ab_low = __builtin_shufflevector(r0, r1, 0, 8, 1, 9, 4, 12, 5, 13);
  const Float8 cd_low = __builtin_shufflevector(r0, r1, 2, 10, 3, 11, 6, 14, 7, 15);
  const Float8 ab_high = __builtin_shufflevector(r2, r3, 0, 8, 1, 9, 4, 12, 5, 13);
  const Float8 cd_high = __builtin_shufflevector(r2, r3, 2, 10, 3, 11, 6, 14, 7, 15);
  a = __builtin_shufflevector(ab_low, ab_high, 0, 1, 8, 9, 4, 5, 12, 13);
  b = __builtin_shufflevector(ab_low, ab_high, 2, 3, 10, 11, 6, 7, 14, 15);
  c = __builtin_shufflevector(cd_low, cd_high, 0, 1, 8, 9, 4, 5, 12, 13);
  d = __builtin_shufflevector(cd_low, cd_high, 2, 3, 10, 11, 6, 7, 14, 15);
}

}  // namespace throng
