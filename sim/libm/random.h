#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string_view>

/// Random numbers with equal bits on every platform and standard library.
namespace hedgehop {

/// Generator of every random stream: the Mersenne Twister of 64 bits, with the numbers of std::mt19937_64. It makes 312
/// numbers at a time in loops that compilers vectorize.
class Random {
 public:
  using result_type = uint64_t;

  explicit Random(uint64_t seed);

  static constexpr uint64_t min() { return 0; }
  static constexpr uint64_t max() { return ~uint64_t{0}; }

  uint64_t operator()() {
    if (next_ == kNumbers) renew();
    return numbers_[next_++];
  }

  /// Returns the next numbers, as many calls would: at most `count` and, unless count is 0, at least one. They are
  /// valid until the next call.
  std::span<const uint64_t> take(size_t count);

 private:
  static constexpr size_t kNumbers = 312;
  void renew();

  std::array<uint64_t, kNumbers> state_, numbers_;
  size_t next_ = kNumbers;
};

/// Name of the stream that the scene of a flight is generated from.
inline constexpr std::string_view kSceneStream = "scene";

/// Returns the output function of SplitMix64 for the state `z`, a bijection.
constexpr uint64_t splitmix64(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Increment of SplitMix64's state. It is odd.
inline constexpr uint64_t kSplitMixIncrement = 0x9e3779b97f4a7c15u;

/// Returns the seed of stream `index` of `seed`. Streams of one seed have different seeds.
constexpr uint64_t derived_seed(uint64_t seed, uint64_t index) {
  return splitmix64(seed + (index + 1) * kSplitMixIncrement);
}

/// 64-bit FNV-1a hash.
class Fnv1a {
 public:
  constexpr void add(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3u; }
  /// Adds the bytes of IEEE doubles, in the order of memory.
  void add(std::span<const double> values);
  constexpr uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = 0xcbf29ce484222325u;
};

/// Returns the seed of a named random stream of a flight: the FNV-1a hash of the name, mixed with the run's seed by
/// SplitMix64. Equal names and run seeds give equal seeds, so that adding a stream changes no other.
uint64_t stream_seed(uint64_t run_seed, std::string_view stream_name);

/// Returns the number in [0, 1) that the upper 53 bits of `bits` stand for.
constexpr double unit_interval(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// Random, or std::mt19937_64 in tests.
template <class T>
concept Generator64 = std::same_as<T, Random> || std::same_as<T, std::mt19937_64>;

/// Returns a uniform number in [0, 1), of 53 random bits.
double uniform(Generator64 auto& random) { return unit_interval(random()); }

/// Returns a uniform number in [low, high), of 53 random bits.
double uniform(Generator64 auto& random, double low, double high) { return low + (high - low) * uniform(random); }

/// Returns a uniform integer in [0, count). @param count  small compared with 2^53.
int uniform_index(Generator64 auto& random, int count) { return static_cast<int>(uniform(random, 0.0, count)); }

/// Returns true with probability `probability`, 0..1.
bool chance(Generator64 auto& random, double probability) { return uniform(random) < probability; }

/// Draws standard normal numbers by the polar method of Marsaglia, two per pair of uniform numbers. It gives the bits
/// of libstdc++'s std::normal_distribution<double> for the same generator.
class NormalDistribution {
 public:
  double operator()(Random& random);

 private:
  bool has_saved_ = false;
  double saved_ = 0.0;  ///< second number of the last pair
};

/// Random numbers from a generator of their own. Equal seeds give equal sequences.
class RandomStream {
 public:
  explicit RandomStream(uint64_t seed) : random_(seed) {}

  /// Returns a standard normal number.
  double normal() { return normal_(random_); }
  /// Returns a uniform number in [0, 1), of 53 random bits.
  double uniform() { return hedgehop::uniform(random_); }
  /// Returns true with probability `probability`, 0..1.
  bool chance(double probability) { return hedgehop::chance(random_, probability); }

 private:
  Random random_;
  NormalDistribution normal_;
};

/// Returns the quantile of the standard normal distribution: the z below which lies the share `probability`, to 16
/// digits. @param probability  in (0, 1). Source: [Wichura1988] p. 483, PPND16.
double normal_quantile(double probability);

}  // namespace hedgehop
