#pragma once

#include "sim/render/tiles/simd.h"

// Vectors of the pixels of rows of a tile, row by row: two rows with AVX-512, else one.
namespace hedgehop::sim::tiles {
namespace {

#ifdef __AVX512VL__

inline constexpr int kRows = 2;
using FloatRows = float __attribute__((vector_size(64)));
using IntRows = int32_t __attribute__((vector_size(64)));

inline FloatRows rows_of(F8 upper, F8 lower) {
  return __builtin_shufflevector(upper, lower, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
inline IntRows rows_of(I8 upper, I8 lower) {
  return __builtin_shufflevector(upper, lower, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
/// Returns equal rows.
inline FloatRows rows_of(F8 row) { return rows_of(row, row); }
inline IntRows rows_of(I8 row) { return rows_of(row, row); }
/// Returns a row.
inline F8 row_of(FloatRows rows, int row) {
  return row == 0 ? _mm512_castps512_ps256(rows) : _mm512_extractf32x8_ps(rows, 1);
}
inline I8 row_of(IntRows rows, int row) {
  const auto a = reinterpret_cast<__m512i>(rows);
  return reinterpret_cast<I8>(row == 0 ? _mm512_castsi512_si256(a) : _mm512_extracti64x4_epi64(a, 1));
}
/// Returns the vertical positions of the pixels of the first rows.
inline FloatRows row_numbers() { return rows_of(F8{}, all(1.0f)); }

inline FloatRows minimum(FloatRows a, FloatRows b) { return _mm512_min_ps(a, b); }
inline FloatRows maximum(FloatRows a, FloatRows b) { return _mm512_max_ps(a, b); }
inline FloatRows floats(IntRows a) { return __builtin_convertvector(a, FloatRows); }
inline IntRows integers(FloatRows a) { return reinterpret_cast<IntRows>(_mm512_cvtps_epi32(a)); }
/// Returns which lanes are positive, and the signs of the lanes; lane 0 in the lowest bit.
inline uint32_t positive(FloatRows a) { return _mm512_cmp_ps_mask(a, _mm512_setzero_ps(), _CMP_GT_OQ); }
inline uint32_t signs(IntRows a) { return _mm512_movepi32_mask(reinterpret_cast<__m512i>(a)); }
inline IntRows minimum(IntRows a, IntRows b) {
  return reinterpret_cast<IntRows>(_mm512_min_epi32(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b)));
}
inline void gather(const float* from, IntRows places, FloatRows& here, FloatRows& right) {
  F8 row_here[2], row_right[2];
  for (int i = 0; i < 2; ++i) gather(from, row_of(places, i), row_here[i], row_right[i]);
  here = rows_of(row_here[0], row_here[1]);
  right = rows_of(row_right[0], row_right[1]);
}
inline IntRows gather_rows(const uint16_t* from, const int32_t* places) {
  return rows_of(gather(from, places), gather(from, places + 8));
}
inline IntRows mix(IntRows texels, IntRows u, IntRows v) {
  const __m512i row_weights =
      _mm512_shuffle_epi8(reinterpret_cast<__m512i>(v), _mm512_broadcast_i32x4(bytes_for_rows())) ^
      _mm512_set1_epi32(0x00ff00ff);
  const __m512i column_weights =
      _mm512_shuffle_epi8(reinterpret_cast<__m512i>(u), _mm512_broadcast_i32x4(bytes_for_columns())) ^
      _mm512_set1_epi32(0x000000ff);
  const __m512i columns = _mm512_maddubs_epi16(row_weights, reinterpret_cast<__m512i>(texels));
  return reinterpret_cast<IntRows>(_mm512_madd_epi16(columns, column_weights));
}
/// Writes the levels, clamped to 0..255, of the shown pixels into rows of a tile.
inline void put_levels(IntRows levels, uint32_t shown, uint64_t* rows) {
  const __m512i positive = _mm512_max_epi32(reinterpret_cast<__m512i>(levels), _mm512_setzero_si512());
  _mm_mask_storeu_epi8(rows, static_cast<__mmask16>(shown), _mm512_cvtusepi32_epi8(positive));
}

#else

inline constexpr int kRows = 1;
using FloatRows = F8;
using IntRows = I8;

inline F8 rows_of(F8 row) { return row; }
inline I8 rows_of(I8 row) { return row; }
inline F8 row_of(F8 row, int) { return row; }
inline F8 row_numbers() { return F8{}; }
inline uint32_t positive(F8 a) { return signs(reinterpret_cast<I8>(a > 0.0f)); }
inline I8 gather_rows(const uint16_t* from, const int32_t* places) { return gather(from, places); }
inline void put_levels(I8 levels, uint32_t shown, uint64_t* rows) {
  const uint64_t here = kByteMasks.bytes[shown];
  rows[0] = (rows[0] & ~here) | (bytes(levels) & here);
}

#endif

}  // namespace
}  // namespace hedgehop::sim::tiles
