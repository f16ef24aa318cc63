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
  }
}

TEST(NormalStream, DrawsTheNumbersOfTheStandardLibrary) {
  NormalStream stream(7);
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(stream.draw(), normal(generator));
    if (i % 3 != 0) continue;
    EXPECT_EQ(stream.even(), std::ldexp(static_cast<double>(generator() >> 11), -53));
  }
}

}  // namespace
}  // namespace hedgehop::dynamics
