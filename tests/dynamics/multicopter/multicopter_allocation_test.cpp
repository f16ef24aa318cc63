#include <gtest/gtest.h>

#include <random>

#include "tests/dynamics/multicopter/published_multicopters.h"

namespace hedgehop::dynamics::multicopter {
namespace {

TEST(Multicopter, AllocationReproducesFeasibleCommands) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> share(-0.3, 0.3);
  for (const MulticopterConfig& config : {hummingbird_a(), hummingbird_b(), firefly(), s900()}) {
    const MulticopterModel model = make_model(config);
    const Controls most = authority(model);
    for (int i = 0; i < 200; ++i) {
      Controls wanted{config.mass.mass_kg * kGravityMps2, share(random) * most[kRoll], share(random) * most[kPitch],
                      share(random) * most[kYaw]};
      EXPECT_LT((wrench(model, allocate(model, wanted)) - wanted).norm(), 1e-9 * wanted.norm());
    }
  }
}

TEST(Multicopter, InfeasibleCommandsLoseYawFirstAndKeepRollAndPitch) {
  const MulticopterModel model = make_model(firefly());
  const Controls most = authority(model);
  const double hover_n = 1.53 * kGravityMps2;
  const Controls given = wrench(model, allocate(model, {hover_n, 0.9 * most[kRoll], 0.0, 50.0 * most[kYaw]}));
  EXPECT_NEAR(given[kRoll], 0.9 * most[kRoll], 1e-9);
  EXPECT_NEAR(given[kHeave], hover_n, 1e-9);
  EXPECT_GT(given[kYaw], 0.0);
  EXPECT_LT(given[kYaw], most[kYaw]);
  // Roll and pitch torque have priority over thrust, at both limits.
  for (const double asked_n : {0.0, 10.0 * hover_n}) {
    const Controls at_end = wrench(model, allocate(model, {asked_n, 0.8 * most[kRoll], 0.0, 0.0}));
    EXPECT_NEAR(at_end[kRoll], 0.8 * most[kRoll], 1e-9);
  }
}

TEST(Multicopter, AllocationStaysWithinTheRotorLimitsForAnyCommand) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> wild(0.0, 30.0);
  const MulticopterModel model = make_model(s900());
  for (int i = 0; i < 2000; ++i) {
    const PerRotor speeds = allocate(model, {wild(random), wild(random), wild(random), wild(random)});
    ASSERT_TRUE(speeds.allFinite());
    EXPECT_GE(speeds.minCoeff(), 0.0);
    EXPECT_LE(speeds.maxCoeff(), 612.0 * (1.0 + 1e-12));
  }
}

}  // namespace
}  // namespace hedgehop::dynamics::multicopter
