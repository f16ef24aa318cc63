#include "sim/libm/random.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace hedgehop {
namespace {

/// A number in [0, 1) from all 64 random bits, as std::generate_canonical<double, 53> of libstdc++ returns it. Numbers
/// that round to 1 become the largest double below 1.
double canonical(Random& random) {
  constexpr double kBelowOne = 1.0 - 0x1p-53;
  const double u = static_cast<double>(random()) * 0x1p-64;
  return u < 1.0 ? u : kBelowOne;
}

using Coefficients = std::array<double, 8>;

/// Returns the ratio of two polynomials, with coefficients from the lowest power on.
double ratio(const Coefficients& above, const Coefficients& below, double x) {
  double numerator = 0.0, denominator = 0.0;
  for (size_t i = above.size(); i-- > 0;) {
    numerator = numerator * x + above[i];
    denominator = denominator * x + below[i];
  }
  return numerator / denominator;
}

}  // namespace

Random::Random(uint64_t seed) {
  state_[0] = seed;
  for (size_t i = 1; i < kNumbers; ++i) {
    state_[i] = 6364136223846793005u * (state_[i - 1] ^ (state_[i - 1] >> 62)) + i;
  }
}

void Random::renew() {
  constexpr size_t kDistance = 156;
  constexpr uint64_t kLower = (uint64_t{1} << 31) - 1, kUpper = ~kLower;
  const auto twisted = [](uint64_t upper, uint64_t lower) {
    const uint64_t joined = (upper & kUpper) | (lower & kLower);
    return (joined >> 1) ^ (-(joined & 1) & 0xb5026f5aa96619e9u);
  };
  uint64_t* const x = state_.data();
  for (size_t i = 0; i < kNumbers - kDistance; ++i) x[i] = x[i + kDistance] ^ twisted(x[i], x[i + 1]);
  for (size_t i = kNumbers - kDistance; i + 1 < kNumbers; ++i) {
    x[i] = x[i + kDistance - kNumbers] ^ twisted(x[i], x[i + 1]);
  }
  x[kNumbers - 1] = x[kDistance - 1] ^ twisted(x[kNumbers - 1], x[0]);
  for (size_t i = 0; i < kNumbers; ++i) {
    uint64_t y = x[i];
    y ^= (y >> 29) & 0x5555555555555555u;
    y ^= (y << 17) & 0x71d67fffeda60000u;
    y ^= (y << 37) & 0xfff7eee000000000u;
    numbers_[i] = y ^ (y >> 43);
  }
  next_ = 0;
}

std::span<const uint64_t> Random::take(size_t count) {
  if (next_ == kNumbers) renew();
  const size_t first = next_;
  next_ = std::min(kNumbers, first + count);
  return std::span(numbers_).subspan(first, next_ - first);
}

void Fnv1a::add(std::span<const double> values) {
  for (const double value : values) {
    for (const unsigned char byte : std::bit_cast<std::array<unsigned char, sizeof(double)>>(value)) add(byte);
  }
}

uint64_t stream_seed(uint64_t run_seed, std::string_view stream_name) {
  Fnv1a hash;
  for (const char letter : stream_name) hash.add(static_cast<unsigned char>(letter));
  return splitmix64(run_seed + kSplitMixIncrement * (hash.value() | 1u));
}

double NormalDistribution::operator()(Random& random) {
  if (has_saved_) {
    has_saved_ = false;
    return saved_;
  }
  // A point drawn uniformly from the unit disc without its center.
  double x, y, r2;
  do {
    x = 2.0 * canonical(random) - 1.0;
    y = 2.0 * canonical(random) - 1.0;
    r2 = x * x + y * y;
  } while (r2 > 1.0 || r2 == 0.0);
  const double scale = std::sqrt(-2.0 * std::log(r2) / r2);
  saved_ = x * scale;
  has_saved_ = true;
  return y * scale;
}

double normal_quantile(double probability) {
  constexpr Coefficients kA{3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                            1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                            3.3430575583588128105e4, 2.5090809287301226727e3};
  constexpr Coefficients kB{1.0,
                            4.2313330701600911252e1,
                            6.8718700749205790830e2,
                            5.3941960214247511077e3,
                            2.1213794301586595867e4,
                            3.9307895800092710610e4,
                            2.8729085735721942674e4,
                            5.2264952788528545610e3};
  constexpr Coefficients kC{1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                            3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                            2.27238449892691845833e-2, 7.74545014278341407640e-4};
  constexpr Coefficients kD{1.0,
                            2.05319162663775882187e0,
                            1.67638483018380384940e0,
                            6.89767334985100004550e-1,
                            1.48103976427480074590e-1,
                            1.51986665636164571966e-2,
                            5.47593808499534494600e-4,
                            1.05075007164441684324e-9};
  constexpr Coefficients kE{6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                            2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                            2.71155556874348757815e-5, 2.01033439929228813265e-7};
  constexpr Coefficients kF{1.0,
                            5.99832206555887937690e-1,
                            1.36929880922735805310e-1,
                            1.48753612908506148525e-2,
                            7.86869131145613259100e-4,
                            1.84631831751005468180e-5,
                            1.42151175831644588870e-7,
                            2.04426310338993978564e-15};
  const double q = probability - 0.5;
  if (std::abs(q) <= 0.425) return q * ratio(kA, kB, 0.180625 - q * q);
  const double r = std::sqrt(-std::log(q < 0.0 ? probability : 1.0 - probability));
  const double z = r <= 5.0 ? ratio(kC, kD, r - 1.6) : ratio(kE, kF, r - 5.0);
  return q < 0.0 ? -z : z;
}

}  // namespace hedgehop
