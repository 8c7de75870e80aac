// Vectors of 4 or 8 floats on which operators work lane by lane (GCC's vector extension). For
// kernels only (see instruction_set.h), whose files throng_kernels() in cmake/Rooms.cmake names.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace throng {

using Float4 [[gnu::vector_size(16)]] = float;
using Float8 [[gnu::vector_size(32)]] = float;
/// What comparisons give: -1 where true, 0 elsewhere.
using Int4 [[gnu::vector_size(16)]] = std::int32_t;
using Int8 [[gnu::vector_size(32)]] = std::int32_t;

inline Float4 low_half(Float8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
inline Float4 high_half(Float8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }
inline Int4 low_half(Int8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
inline Int4 high_half(Int8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }

/// Bit i tells whether lane i of a mask is true.
inline unsigned bits(Int4 mask) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return (mask[0] & 1U) | (mask[1] & 2U) | (mask[2] & 4U) | (mask[3] & 8U);
#endif
}
inline unsigned bits(Int8 mask) { return bits(low_half(mask)) | (bits(high_half(mask)) << 4U); }

/// Lane by lane; b where one of them is no number.
template <typename Vector>
Vector smaller(Vector a, Vector b) {
  return a < b ? a : b;
}
template <typename Vector>
Vector greater(Vector a, Vector b) {
  return a > b ? a : b;
}

/// The smallest and the greatest of the lanes.
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

/// The same in every lane.
template <int kWidth>
typename Vectors<kWidth>::Float every(float value) {
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

template <int kWidth>
typename Vectors<kWidth>::Float square_root(typename Vectors<kWidth>::Float v) {
  for (int i = 0; i < kWidth; ++i) v[i] = std::sqrt(v[i]);
  return v;
}

/// `count` rounded up to whole vectors.
template <int kWidth>
constexpr std::size_t whole(std::size_t count) {
  return (count + kWidth - 1) / kWidth * kWidth;
}

}  // namespace throng
