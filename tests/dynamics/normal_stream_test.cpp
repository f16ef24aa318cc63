#include "dynamics/normal_stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hedgehop::dynamics {
namespace {

TEST(NormalQuantile, InvertsTheErrorFunction) {
  for (const double p : {1e-15, 1e-9, 1e-4, 0.07, 0.3, 0.5, 0.925, 0.99, 1.0 - 1e-9}) {
    const double z = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::numbers::sqrt2) / p, 1.0, 1e-13) << p;
    EXPECT_NEAR(normal_distribution(z), p, 1e-15) << p;
  }
}

/// A blend of one seed draws what the seed's generator draws, bit for bit.
TEST(NormalStream, OfOneSeedIsThatSeedsGenerator) {
  NormalStream stream(7);
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(stream.draw(), normal(generator));
    if (i % 3 != 0) continue;
    EXPECT_EQ(stream.even(), std::ldexp(static_cast<double>(generator() >> 11), -53));
  }
}

/// Numbers of 17 seeds in step equal the weighted sum of their sequences, with even numbers drawn in between.
TEST(NormalStream, BlendIsTheWeightedSum) {
  std::vector<BlendedSeed> terms;
  std::vector<NormalStream> alone;
  double weight = 1.0;
  for (uint64_t seed = 1; seed <= 17; ++seed) {
    const double share = seed == 17 ? 1.0 : 0.4;
    terms.push_back({seed, weight * share});
    weight *= std::sqrt(1.0 - share * share);
    alone.emplace_back(seed);
  }
  NormalStream blend{SeedBlend(terms)};
  for (int i = 0; i < 5000; ++i) {
    double sum = 0.0;
    for (size_t j = 0; j < terms.size(); ++j) sum += terms[j].weight * alone[j].draw();
    EXPECT_NEAR(blend.draw(), sum, 1e-14);
    if (i % 10 != 0) continue;
    blend.even();
    for (NormalStream& stream : alone) stream.even();
  }
}

/// Even numbers of a blend are even: mean, variance and the share below a tenth.
TEST(NormalStream, EvenNumbersOfABlendAreEven) {
  NormalStream stream{SeedBlend({{1, 0.6}, {2, 0.8}})};
  constexpr int kDraws = 20'000;
  double mean = 0.0, square = 0.0, below = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = stream.even();
    mean += u / kDraws;
    square += u * u / kDraws;
    below += u < 0.1 ? 1.0 / kDraws : 0.0;
  }
  EXPECT_NEAR(mean, 0.5, 0.01);
  EXPECT_NEAR(square - mean * mean, 1.0 / 12.0, 0.003);
  EXPECT_NEAR(below, 0.1, 0.01);
}

}  // namespace
}  // namespace hedgehop::dynamics
