#pragma once

#include <cstdint>
#include <random>

namespace hedgehop::scenes {

using Random = std::mt19937_64;

/// Returns the seed of stream `index` of `seed`: SplitMix64's output function applied to
/// `seed + (index + 1) * 0x9e3779b97f4a7c15`. Streams of one seed never share a seed (the function is a bijection of
/// its argument and the multiplier is odd).
constexpr uint64_t derived_seed(uint64_t seed, uint64_t index) {
  uint64_t z = seed + (index + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Returns a number in [low, high), with 53 random bits: the same on every standard library.
inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Returns an integer in [0, count); `count` is small against 2^53.
inline int uniform_index(Random& random, int count) { return static_cast<int>(uniform(random, 0.0, count)); }

inline bool chance(Random& random, double probability) { return uniform(random, 0.0, 1.0) < probability; }

}  // namespace hedgehop::scenes
