#include "sim/libm/random.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <string>

namespace hedgehop {
namespace {

TEST(StreamSeed, NamesAndSeedsNeverCollideInTenThousand) {
  std::set<uint64_t> seeds;
  for (uint64_t run_seed = 0; run_seed < 1000; ++run_seed) {
    for (const char* name :
         {"wind", "imu", "gps", "magnetometer", "height_sensor", "module", "scene", "start", "", "imu2"}) {
      seeds.insert(stream_seed(run_seed, name));
    }
  }
  EXPECT_EQ(seeds.size(), 10'000u);
}

TEST(StreamSeed, NeighboringRunSeedsDifferInAboutHalfTheBits) {
  double bits = 0.0;
  constexpr int kPairs = 2000;
  for (uint64_t run_seed = 0; run_seed < kPairs; ++run_seed) {
    bits += std::popcount(stream_seed(run_seed, "wind") ^ stream_seed(run_seed + 1, "wind"));
  }
  EXPECT_NEAR(bits / kPairs, 32.0, 0.5);  // standard error 4 / sqrt(2000) = 0.09
}

TEST(StreamSeed, StreamsOfOneRunAreUncorrelated) {
  std::mt19937_64 wind(stream_seed(7, "wind")), imu(stream_seed(7, "imu"));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double sum = 0.0;
  constexpr int kSamples = 100'000;
  for (int i = 0; i < kSamples; ++i) sum += uniform(wind) * uniform(imu);
  EXPECT_NEAR(sum / kSamples, 0.0, 5.0 / 3.0 / std::sqrt(static_cast<double>(kSamples)));  // 5 standard errors
}

// Flights depend on these values.
TEST(StreamSeed, KeepsItsValues) {
  EXPECT_EQ(stream_seed(0, ""), 577409809830185139u);
  EXPECT_EQ(stream_seed(7, "wind"), 8409034199669478811u);
}

/// The first outputs of SplitMix64 for the seed 1234567, as its reference implementation prints them.
TEST(SplitMix64, MatchesItsReferenceImplementation) {
  const uint64_t expected[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u};
  for (uint64_t i = 0; i < 3; ++i) EXPECT_EQ(derived_seed(1234567, i), expected[i]);
}

/// Published test vectors of the 64-bit FNV-1a hash.
TEST(Fnv1aHash, MatchesPublishedVectors) {
  const auto hash = [](std::string_view text) {
    Fnv1a fnv;
    for (const char letter : text) fnv.add(static_cast<unsigned char>(letter));
    return fnv.value();
  };
  EXPECT_EQ(hash(""), 0xcbf29ce484222325u);
  EXPECT_EQ(hash("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hash("foobar"), 0x85944171f73967e8u);
}

TEST(Fnv1aHash, HashesTheBytesOfDoublesInTheOrderOfMemory) {
  const double values[] = {1.5, -0.0};
  Fnv1a of_values, of_bytes;
  of_values.add(values);
  const auto* bytes = reinterpret_cast<const unsigned char*>(values);
  for (size_t i = 0; i < sizeof values; ++i) of_bytes.add(bytes[i]);
  EXPECT_EQ(of_values.value(), of_bytes.value());
}

TEST(Random, HasTheNumbersOfTheStandardLibrary) {
  for (const uint64_t seed : {uint64_t{0}, uint64_t{5489}, std::numeric_limits<uint64_t>::max()}) {
    Random random(seed);
    std::mt19937_64 generator(seed);
    for (int i = 0; i < 10'000; ++i) ASSERT_EQ(random(), generator()) << i;
  }
}

TEST(Random, TakesTheNumbersOfSingleCalls) {
  Random random(6);
  std::mt19937_64 generator(6);
  for (size_t count = 1; count < 1000; ++count) {
    size_t taken = 0;
    while (taken < count) {
      const std::span<const uint64_t> numbers = random.take(count - taken);
      ASSERT_GT(numbers.size(), 0u);
      for (const uint64_t number : numbers) ASSERT_EQ(number, generator());
      taken += numbers.size();
    }
    ASSERT_EQ(taken, count);
    ASSERT_EQ(random(), generator());
  }
}

TEST(Uniform, TakesTheUpper53Bits) {
  Random random(3);
  std::mt19937_64 generator(3);
  for (int i = 0; i < 10'000; ++i) {
    const auto whole = static_cast<double>(generator() >> 11);
    switch (i % 3) {
      case 0:
        EXPECT_EQ(uniform(random), std::ldexp(whole, -53));
        break;
      case 1:
        EXPECT_EQ(uniform(random, -1.0, 1.0), std::ldexp(whole, -52) - 1.0);
        break;
      default:
        EXPECT_EQ(uniform(random, 0.3, 7.1), 0.3 + (7.1 - 0.3) * whole * 0x1p-53);
    }
  }
}

TEST(Uniform, CoversItsRangeWithoutTheUpperEnd) {
  EXPECT_EQ(unit_interval(0), 0.0);
  EXPECT_EQ(unit_interval(std::numeric_limits<uint64_t>::max()), 1.0 - 0x1p-53);
}

TEST(Chance, IsTrueForTheGivenShareOfDraws) {
  Random random(4);
  int count = 0;
  constexpr int kDraws = 100'000;
  for (int i = 0; i < kDraws; ++i) count += chance(random, 0.3) ? 1 : 0;
  EXPECT_NEAR(count, 0.3 * kDraws, 5.0 * std::sqrt(0.21 * kDraws));  // 5 standard errors
  EXPECT_FALSE(chance(random, 0.0));
  EXPECT_TRUE(chance(random, 1.0));
}

TEST(NormalDistribution, HasTheBitsOfTheStandardLibrary) {
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    Random random(seed * 0x9e3779b97f4a7c15u);
    std::mt19937_64 generator(seed * 0x9e3779b97f4a7c15u);
    NormalDistribution normal;
    std::normal_distribution<double> expected;
    const size_t length = 1 + seed % 200;
    for (size_t i = 0; i < length; ++i) {
      ASSERT_EQ(std::bit_cast<uint64_t>(normal(random)), std::bit_cast<uint64_t>(expected(generator))) << seed;
    }
    EXPECT_EQ(random(), generator()) << "as many numbers are drawn";
  }
}

TEST(NormalDistribution, HasTheBitsOfTheStandardLibraryInALongSequence) {
  Random random(5);
  std::mt19937_64 generator(5);
  NormalDistribution normal;
  std::normal_distribution<double> expected;
  for (int i = 0; i < 2'000'000; ++i) {
    ASSERT_EQ(std::bit_cast<uint64_t>(normal(random)), std::bit_cast<uint64_t>(expected(generator))) << i;
  }
}

TEST(RandomStream, SharesOneGeneratorBetweenItsDistributions) {
  RandomStream stream(7);
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(stream.normal(), normal(generator));
    if (i % 3 != 0) continue;
    EXPECT_EQ(stream.uniform(), std::ldexp(static_cast<double>(generator() >> 11), -53));
    EXPECT_EQ(stream.chance(0.5), (generator() >> 63) == 0);
  }
}

TEST(NormalQuantile, InvertsTheErrorFunction) {
  for (const double p : {1e-15, 1e-9, 1e-4, 0.07, 0.3, 0.5, 0.925, 0.99, 1.0 - 1e-9}) {
    const double z = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::numbers::sqrt2) / p, 1.0, 1e-13) << p;
  }
}

}  // namespace
}  // namespace hedgehop
