#include "vision/flow/corner_window.h"

#include <algorithm>
#include <opencv2/core/hal/intrin.hpp>

#include "vision/flow/wide_integers.h"
#ifdef HEDGEHOP_HAS_AVX2
#include <immintrin.h>
#endif

namespace hedgehop::vision::flow {
namespace {

constexpr int kWeightBits = 14, kGreyBits = 5;  // fractional bits of interpolation weights and of grey levels
constexpr int kRowLanes = CornerRows::kLanes;
constexpr int16_t kWithin[2 * kRowLanes] = {-1, -1, -1, -1, -1, -1, -1, -1};  // ones in all bits, then zeros

cv::v_int16x8 repeat_pair(int16_t left, int16_t right) { return {left, right, left, right, left, right, left, right}; }

/// Weights of the top left and right pixels and of the bottom left and right pixels, in pairs.
struct Weights {
  explicit Weights(const CornerWeights& weights)
      : top(repeat_pair(weights.top_left, weights.top_right)),
        bottom(repeat_pair(weights.bottom_left, weights.bottom_right)) {}
  cv::v_int16x8 top, bottom;
};

/// Returns eight interpolated values. @param top_right, bottom_right  the values one pixel to the right.
template <int kShift>
cv::v_int16x8 interpolate(const cv::v_int16x8& top, const cv::v_int16x8& top_right, const cv::v_int16x8& bottom,
                          const cv::v_int16x8& bottom_right, const Weights& weights) {
  const auto half = cv::v_setall_s32(1 << (kShift - 1));
  cv::v_int16x8 top_low, top_high, bottom_low, bottom_high;
  cv::v_zip(top, top_right, top_low, top_high);
  cv::v_zip(bottom, bottom_right, bottom_low, bottom_high);
  const auto low = cv::v_dotprod(top_low, weights.top) + cv::v_dotprod(bottom_low, weights.bottom) + half;
  const auto high = cv::v_dotprod(top_high, weights.top) + cv::v_dotprod(bottom_high, weights.bottom) + half;
  return cv::v_pack(low >> kShift, high >> kShift);
}

cv::v_int16x8 interpolate_grey(const uint8_t* upper, const uint8_t* lower, const Weights& weights) {
  const auto eight = [](const uint8_t* from) { return cv::v_reinterpret_as_s16(cv::v_load_expand(from)); };
  return interpolate<kWeightBits - kGreyBits>(eight(upper), eight(upper + 1), eight(lower), eight(lower + 1), weights);
}

/// Sums of products of numbers with at most 13 bits and a sign.
class Sum {
 public:
  void add(const cv::v_int16x8& a, const cv::v_int16x8& b) {
    constexpr int kMaxParts = 32;  // whose sum fits 32 bits
    part_ = part_ + cv::v_dotprod(a, b);
    if (++parts_ == kMaxParts) flush();
  }
  int64_t total() {
    flush();
    int64_t two[2];
    cv::v_store(two, whole_);
    return two[0] + two[1];
  }

 private:
  void flush() {
    cv::v_int64x2 low, high;
    cv::v_expand(part_, low, high);
    whole_ = whole_ + low + high;
    part_ = cv::v_setzero_s32();
    parts_ = 0;
  }

  cv::v_int32x4 part_ = cv::v_setzero_s32();
  cv::v_int64x2 whole_ = cv::v_setzero_s64();
  int parts_ = 0;
};

// For AVX2 these do the work of load_rows() and mismatch_of_rows() with rows of 16 values, and return true.
HEDGEHOP_TARGET_DEFAULT bool load_of_16(const CornerRows&, const CornerWeights&, std::array<int64_t, 3>&) {
  return false;
}
HEDGEHOP_TARGET_DEFAULT bool mismatch_of_16(const CornerRows&, const CornerWeights&, std::array<int64_t, 2>&) {
  return false;
}

#ifdef HEDGEHOP_HAS_AVX2
constexpr int kWide = 16;
#define HEDGEHOP_AVX2 [[gnu::target("avx2"), gnu::always_inline]] inline

HEDGEHOP_AVX2 __m256i load_256(const int16_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}
HEDGEHOP_AVX2 void store_256(int16_t* to, __m256i numbers) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), numbers);
}

HEDGEHOP_AVX2 __m256i repeat(int16_t left, int16_t right) {
  return _mm256_set1_epi32((int32_t{right} << 16) | static_cast<uint16_t>(left));
}

/// Neighbors in a row, in pairs: those of two groups of eight values.
struct PairedRow {
  __m256i first, second;
};

HEDGEHOP_AVX2 PairedRow pair_pixels(const uint8_t* row) {
  const __m256i left = _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(row)));
  const __m256i right = _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(row + 1)));
  return {_mm256_unpacklo_epi16(left, right), _mm256_unpackhi_epi16(left, right)};
}

HEDGEHOP_AVX2 void pair_gradients(const int16_t* row, PairedRow& x, PairedRow& y) {
  constexpr int kUpperHalves = 0xAA;
  const __m256i left[2] = {load_256(row), load_256(row + 16)}, right[2] = {load_256(row + 2), load_256(row + 18)};
  x = {_mm256_blend_epi16(left[0], _mm256_slli_epi32(right[0], 16), kUpperHalves),
       _mm256_blend_epi16(left[1], _mm256_slli_epi32(right[1], 16), kUpperHalves)};
  y = {_mm256_blend_epi16(_mm256_srli_epi32(left[0], 16), right[0], kUpperHalves),
       _mm256_blend_epi16(_mm256_srli_epi32(left[1], 16), right[1], kUpperHalves)};
}

/// Returns 16 interpolated values in the order of _mm256_packs_epi32().
template <int kShift>
HEDGEHOP_AVX2 __m256i interpolate(const PairedRow& top, const PairedRow& bottom, __m256i of_top, __m256i of_bottom) {
  const __m256i half = _mm256_set1_epi32(1 << (kShift - 1));
  const auto one = [&](__m256i upper, __m256i lower) __attribute__((target("avx2"), always_inline)) {
    const __m256i sum = _mm256_add_epi32(_mm256_madd_epi16(upper, of_top), _mm256_madd_epi16(lower, of_bottom));
    return _mm256_srai_epi32(_mm256_add_epi32(sum, half), kShift);
  };
  return _mm256_packs_epi32(one(top.first, bottom.first), one(top.second, bottom.second));
}

HEDGEHOP_AVX2 int64_t total(__m256i sums) {
  const __m256i low = _mm256_cvtepi32_epi64(_mm256_castsi256_si128(sums));
  const __m256i both = _mm256_add_epi64(low, _mm256_cvtepi32_epi64(_mm256_extracti128_si256(sums, 1)));
  const __m128i two = _mm_add_epi64(_mm256_castsi256_si128(both), _mm256_extracti128_si256(both, 1));
  return _mm_cvtsi128_si64(two) + _mm_cvtsi128_si64(_mm_unpackhi_epi64(two, two));
}

[[gnu::target("avx2")]] bool load_of_16(const CornerRows& rows, const CornerWeights& weights,
                                        std::array<int64_t, 3>& sums) {
  const __m256i top = repeat(weights.top_left, weights.top_right);
  const __m256i bottom = repeat(weights.bottom_left, weights.bottom_right);
  const __m256i within = _mm256_cmpgt_epi16(_mm256_set1_epi16(static_cast<int16_t>(rows.window)),
                                            _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
  constexpr int kInOrder = 0xD8;
  __m256i xx{}, xy{}, yy{};
  PairedRow above = pair_pixels(rows.pixels), above_x, above_y;
  pair_gradients(rows.gradients, above_x, above_y);
  for (int row = 0; row < rows.window; ++row) {
    const ptrdiff_t to = static_cast<ptrdiff_t>(row) * kWide;
    const PairedRow below = pair_pixels(rows.pixels + (row + 1) * rows.pixel_step);
    store_256(rows.grey + to, interpolate<kWeightBits - kGreyBits>(above, below, top, bottom));
    above = below;
    PairedRow below_x, below_y;
    pair_gradients(rows.gradients + (row + 1) * rows.gradient_step, below_x, below_y);
    const __m256i packed_x = interpolate<kWeightBits>(above_x, below_x, top, bottom);
    const __m256i packed_y = interpolate<kWeightBits>(above_y, below_y, top, bottom);
    const __m256i x = _mm256_and_si256(_mm256_permute4x64_epi64(packed_x, kInOrder), within);
    const __m256i y = _mm256_and_si256(_mm256_permute4x64_epi64(packed_y, kInOrder), within);
    store_256(rows.gradient_x + to, x);
    store_256(rows.gradient_y + to, y);
    xx = _mm256_add_epi32(xx, _mm256_madd_epi16(x, x));
    xy = _mm256_add_epi32(xy, _mm256_madd_epi16(x, y));
    yy = _mm256_add_epi32(yy, _mm256_madd_epi16(y, y));
    above_x = below_x;
    above_y = below_y;
  }
  sums = {total(xx), total(xy), total(yy)};
  return true;
}

[[gnu::target("avx2")]] bool mismatch_of_16(const CornerRows& rows, const CornerWeights& weights,
                                            std::array<int64_t, 2>& sums) {
  const __m256i top = repeat(weights.top_left, weights.top_right);
  const __m256i bottom = repeat(weights.bottom_left, weights.bottom_right);
  __m256i sum_x{}, sum_y{};
  PairedRow above = pair_pixels(rows.pixels);
  for (int row = 0; row < rows.window; ++row) {
    const ptrdiff_t from = static_cast<ptrdiff_t>(row) * kWide;
    const PairedRow below = pair_pixels(rows.pixels + (row + 1) * rows.pixel_step);
    const __m256i grey = interpolate<kWeightBits - kGreyBits>(above, below, top, bottom);
    const __m256i difference = _mm256_sub_epi16(grey, load_256(rows.grey + from));
    sum_x = _mm256_add_epi32(sum_x, _mm256_madd_epi16(difference, load_256(rows.gradient_x + from)));
    sum_y = _mm256_add_epi32(sum_y, _mm256_madd_epi16(difference, load_256(rows.gradient_y + from)));
    above = below;
  }
  sums = {total(sum_x), total(sum_y)};
  return true;
}
#endif

}  // namespace

CornerWeights::CornerWeights(const cv::Point2f& part) {
  const auto share = [](float value) { return static_cast<int16_t>(cvRound(value * (1 << kWeightBits))); };
  top_left = share((1.0F - part.x) * (1.0F - part.y));
  top_right = share(part.x * (1.0F - part.y));
  bottom_left = share((1.0F - part.x) * part.y);
  bottom_right = static_cast<int16_t>((1 << kWeightBits) - top_left - top_right - bottom_left);
}

std::array<int64_t, 3> load_rows(const CornerRows& rows, const CornerWeights& corner_weights) {
  std::array<int64_t, 3> sums;
  if (rows.stride == 2 * kRowLanes && load_of_16(rows, corner_weights, sums)) return sums;
  const Weights weights(corner_weights);
  Sum xx, xy, yy;
  for (int y = 0; y < rows.window; ++y) {
    const ptrdiff_t to = static_cast<ptrdiff_t>(y) * rows.stride;
    for (int x = 0; x < rows.stride; x += kRowLanes) {
      const uint8_t* grey = rows.pixels + y * rows.pixel_step + x;
      cv::v_store(rows.grey + to + x, interpolate_grey(grey, grey + rows.pixel_step, weights));
      cv::v_int16x8 px[4], py[4];
      for (int i = 0; i < 4; ++i) {
        cv::v_load_deinterleave(rows.gradients + (y + i / 2) * rows.gradient_step + 2 * (x + i % 2), px[i], py[i]);
      }
      const auto within = cv::v_load(kWithin + kRowLanes - std::min(kRowLanes, rows.window - x));
      const auto slope_x = interpolate<kWeightBits>(px[0], px[1], px[2], px[3], weights) & within;
      const auto slope_y = interpolate<kWeightBits>(py[0], py[1], py[2], py[3], weights) & within;
      cv::v_store(rows.gradient_x + to + x, slope_x);
      cv::v_store(rows.gradient_y + to + x, slope_y);
      xx.add(slope_x, slope_x);
      xy.add(slope_x, slope_y);
      yy.add(slope_y, slope_y);
    }
  }
  return {xx.total(), xy.total(), yy.total()};
}

std::array<int64_t, 2> mismatch_of_rows(const CornerRows& rows, const CornerWeights& corner_weights) {
  std::array<int64_t, 2> sums;
  if (rows.stride == 2 * kRowLanes && mismatch_of_16(rows, corner_weights, sums)) return sums;
  const Weights weights(corner_weights);
  Sum sum_x, sum_y;
  for (int y = 0; y < rows.window; ++y) {
    const ptrdiff_t from = static_cast<ptrdiff_t>(y) * rows.stride;
    for (int x = 0; x < rows.stride; x += kRowLanes) {
      const uint8_t* grey = rows.pixels + y * rows.pixel_step + x;
      const auto difference =
          interpolate_grey(grey, grey + rows.pixel_step, weights) - cv::v_load(rows.grey + from + x);
      sum_x.add(difference, cv::v_load(rows.gradient_x + from + x));
      sum_y.add(difference, cv::v_load(rows.gradient_y + from + x));
    }
  }
  return {sum_x.total(), sum_y.total()};
}

}  // namespace hedgehop::vision::flow
