#include "sim/loop/pixel_levels.h"

#include <emmintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

constexpr int kBits = 16;  ///< per normal number
constexpr uint32_t kSign = 1u << (kBits - 1);
constexpr size_t kLanes = 64 / kBits;  ///< normal numbers per random number

/// The positive half of the normal numbers, in increasing order.
using Half = std::array<float, kSign>;

Half positive_half() {
  std::array<double, kSign> numbers{};
  double squares = 0.0;
  for (size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = normal_quantile(0.5 + (static_cast<double>(i) + 0.5) / (2.0 * kSign));
    squares += numbers[i] * numbers[i];
  }
  const double scale = 1.0 / std::sqrt(squares / kSign);
  Half half{};
  for (size_t i = 0; i < half.size(); ++i) half[i] = static_cast<float>(scale * numbers[i]);
  return half;
}

/// The normal numbers of fill_normal(), four at a time.
class NormalNumbers {
 public:
  explicit NormalNumbers(uint64_t seed) : half_(table().data()), seed_(seed) {}

  __m128 next() {
    const uint64_t bits = derived_seed(seed_, place_++);
    const auto number = [&](int lane) { return half_[bits >> (kBits * lane) & (kSign - 1)]; };
    const __m128 positive = _mm_setr_ps(number(0), number(1), number(2), number(3));
    // The highest bit of each 16 becomes the sign.
    const __m128i words = _mm_unpacklo_epi16(_mm_setzero_si128(), _mm_cvtsi64_si128(static_cast<int64_t>(bits)));
    const __m128 signs = _mm_castsi128_ps(_mm_and_si128(words, _mm_set1_epi32(static_cast<int>(0x80000000u))));
    return _mm_or_ps(positive, signs);
  }

 private:
  static const Half& table() {
    static const Half half = positive_half();
    return half;
  }

  const float* half_;
  uint64_t seed_, place_ = 0;
};

size_t values_per_row(const cv::Mat& image) {
  return static_cast<size_t>(image.cols) * static_cast<size_t>(image.channels());
}

__m128 load_levels(const uint8_t* from) {
  int32_t four = 0;
  std::memcpy(&four, from, sizeof(four));
  const __m128i zero = _mm_setzero_si128();
  return _mm_cvtepi32_ps(_mm_unpacklo_epi16(_mm_unpacklo_epi8(_mm_cvtsi32_si128(four), zero), zero));
}

/// Rounds to the nearest level, ties to even.
void store_levels(__m128 levels, uint8_t* to) {
  const __m128i words = _mm_packs_epi32(_mm_cvtps_epi32(levels), _mm_setzero_si128());
  const int32_t four = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
  std::memcpy(to, &four, sizeof(four));
}

/// Applies `read(levels, factors)` to the levels of a row, four at a time. @param factors  one per level.
template <class Read>
void change_row(uint8_t* row, const float* factors, size_t count, const Read& read) {
  size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) store_levels(read(load_levels(row + i), _mm_loadu_ps(factors + i)), row + i);
  if (i == count) return;
  uint8_t rest[kLanes] = {};
  float rest_factors[kLanes] = {};
  std::copy(row + i, row + count, rest);
  std::copy(factors + i, factors + count, rest_factors);
  store_levels(read(load_levels(rest), _mm_loadu_ps(rest_factors)), rest);
  std::copy_n(rest, count - i, row + i);
}

}  // namespace

void fill_normal(uint64_t seed, cv::Mat& image) {
  NormalNumbers numbers(seed);
  const size_t count = values_per_row(image);
  for (int row = 0; row < image.rows; ++row) {
    float* const out = image.ptr<float>(row);
    for (size_t i = 0; i < count; i += kLanes) {
      float four[kLanes];
      _mm_storeu_ps(four, numbers.next());
      std::copy_n(four, std::min(kLanes, count - i), out + i);
    }
  }
}

void read_out(const cv::Mat& response, double gain, const std::optional<LevelNoise>& noise, cv::Mat& image) {
  const LevelNoise of_image = noise.value_or(LevelNoise{});
  NormalNumbers numbers(of_image.seed);
  const __m128 gains = _mm_set1_ps(static_cast<float>(gain)), white = _mm_set1_ps(255.0f);
  const __m128 per_level = _mm_set1_ps(static_cast<float>(of_image.variance_per_level));
  const __m128 read = _mm_set1_ps(static_cast<float>(of_image.read_variance));
  const size_t count = values_per_row(image);
  const std::vector<float> ones(response.empty() ? count : 0, 1.0f);
  for (int row = 0; row < image.rows; ++row) {
    const float* const responses = response.empty() ? ones.data() : response.ptr<float>(row);
    const auto lit = [&](__m128 levels, __m128 of_pixels) { return _mm_mul_ps(_mm_mul_ps(levels, of_pixels), gains); };
    const auto noisy = [&](__m128 levels, __m128 of_pixels) {
      const __m128 light = _mm_min_ps(lit(levels, of_pixels), white);
      const __m128 sigma = _mm_sqrt_ps(_mm_add_ps(_mm_mul_ps(light, per_level), read));
      return _mm_add_ps(light, _mm_mul_ps(numbers.next(), sigma));
    };
    if (noise) {
      change_row(image.ptr<uint8_t>(row), responses, count, noisy);
    } else {
      change_row(image.ptr<uint8_t>(row), responses, count, lit);
    }
  }
}

void add_levels(const cv::Mat& image, cv::Mat& sums) {
  const size_t count = values_per_row(image);
  for (int row = 0; row < image.rows; ++row) {
    const uint8_t* const levels = image.ptr<uint8_t>(row);
    uint16_t* const sum = sums.ptr<uint16_t>(row);
    for (size_t i = 0; i < count; ++i) sum[i] = static_cast<uint16_t>(sum[i] + levels[i]);
  }
}

void mean_levels(const cv::Mat& sums, const cv::Mat& last, int count, cv::Mat& out) {
  const __m128 share = _mm_set1_ps(static_cast<float>(1.0 / count));
  const size_t values = values_per_row(last);
  std::vector<float> row_sums(values);
  for (int row = 0; row < last.rows; ++row) {
    const uint16_t* const sum = sums.ptr<uint16_t>(row);
    const uint8_t* const levels = last.ptr<uint8_t>(row);
    for (size_t i = 0; i < values; ++i) row_sums[i] = static_cast<float>(sum[i] + levels[i]);
    change_row(out.ptr<uint8_t>(row), row_sums.data(), values,
               [share](__m128, __m128 sums_of_pixels) { return _mm_mul_ps(sums_of_pixels, share); });
  }
}

}  // namespace hedgehop::sim
