#include "sim/scenario/random_stream.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <set>
#include <string>

namespace hedgehop::sim {
namespace {

TEST(RandomStream, NamesAndSeedsNeverCollideInTenThousand) {
  std::set<uint64_t> seeds;
  for (uint64_t run_seed = 0; run_seed < 1000; ++run_seed) {
    for (const char* name :
         {"wind", "imu", "gps", "magnetometer", "height_sensor", "module", "scene", "start", "", "imu2"}) {
      seeds.insert(stream_seed(run_seed, name));
    }
  }
  EXPECT_EQ(seeds.size(), 10'000u);
}

TEST(RandomStream, NeighboringRunSeedsDifferInAboutHalfTheBits) {
  double bits = 0.0;
  constexpr int kPairs = 2000;
  for (uint64_t run_seed = 0; run_seed < kPairs; ++run_seed) {
    bits += std::popcount(stream_seed(run_seed, "wind") ^ stream_seed(run_seed + 1, "wind"));
  }
  EXPECT_NEAR(bits / kPairs, 32.0, 0.5);  // standard error 4 / sqrt(2000) = 0.09
}

TEST(RandomStream, StreamsOfOneRunAreUncorrelated) {
  std::mt19937_64 wind(stream_seed(7, "wind")), imu(stream_seed(7, "imu"));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double sum = 0.0;
  constexpr int kSamples = 100'000;
  for (int i = 0; i < kSamples; ++i) sum += uniform(wind) * uniform(imu);
  EXPECT_NEAR(sum / kSamples, 0.0, 5.0 / 3.0 / std::sqrt(static_cast<double>(kSamples)));  // 5 standard errors
}

}  // namespace
}  // namespace hedgehop::sim
