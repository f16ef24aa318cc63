#include "sim/loop/normal_image.h"

#include <array>
#include <bit>
#include <cmath>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

constexpr int kBits = 16;
constexpr uint32_t kSign = 1u << (kBits - 1);

/// The bits of the positive half of the numbers, from the least to the greatest.
using Half = std::array<uint32_t, kSign>;

Half positive_half() {
  std::array<double, kSign> numbers{};
  double squares = 0.0;
  for (size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = normal_quantile(0.5 + (static_cast<double>(i) + 0.5) / (2.0 * kSign));
    squares += numbers[i] * numbers[i];
  }
  const double scale = 1.0 / std::sqrt(squares / kSign);
  Half half{};
  for (size_t i = 0; i < half.size(); ++i) half[i] = std::bit_cast<uint32_t>(static_cast<float>(scale * numbers[i]));
  return half;
}

}  // namespace

void fill_normal(uint64_t seed, cv::Mat& image) {
  static const Half half = positive_half();
  const size_t count = static_cast<size_t>(image.cols) * static_cast<size_t>(image.channels());
  uint64_t place = 0;
  for (int row = 0; row < image.rows; ++row) {
    float* const numbers = image.ptr<float>(row);
    for (size_t i = 0; i < count;) {
      uint64_t bits = derived_seed(seed, place++);
      for (const size_t end = std::min(i + 64 / kBits, count); i < end; ++i, bits >>= kBits) {
        const uint32_t own = static_cast<uint32_t>(bits);
        numbers[i] = std::bit_cast<float>(half[own & (kSign - 1)] | (own & kSign) << (32 - kBits));
      }
    }
  }
}

}  // namespace hedgehop::sim
