#include "dynamics/modes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hedgehop::dynamics {
namespace {

std::vector<std::string> names(const VehicleConfig& vehicle, double speed_mps) {
  std::vector<std::string> found;
  for (const Mode& mode : modes(*linear_system(vehicle, {speed_mps, 0.0, 0.0}), speed_mps)) found.push_back(mode.name);
  return found;
}

TEST(Modes, OfAHelicopterHaveTheirNames) {
  EXPECT_THAT(names(helicopter::HelicopterConfig{}, 0.0),
              testing::UnorderedElementsAre("heading", "hover cubic, longitudinal oscillation",
                                            "hover cubic, lateral oscillation", "heave subsidence", "yaw subsidence",
                                            "pitch and flapping", "roll and flapping"));
  EXPECT_THAT(names(helicopter::HelicopterConfig{}, 20.0),
              testing::UnorderedElementsAre("heading", "spiral", "phugoid", "heave subsidence", "Dutch roll",
                                            "pitch and flapping", "roll and flapping"));
}

TEST(Modes, OfAMulticopterWithSeparateAxesHaveTheirNames) {
  multicopter::MulticopterConfig config;
  config.mass.inertia_kgm2 = {0.007, 0.009, 0.012};
  config.rotor.inertia_kgm2 = 0.0;
  EXPECT_THAT(names(config, 0.0),
              testing::IsSupersetOf({"heading", "heave, neutral", "yaw subsidence", "motors, thrust", "motors, roll"}));
}

TEST(Modes, NeutralModesAreHeadingAndHeaveAtEverySpeed) {
  for (const double speed_mps : {0.0, 1.0, 2.0, 5.0, 10.0, 20.0}) {
    int neutral = 0;
    for (const Mode& mode : modes(*linear_system(multicopter::MulticopterConfig{}, {speed_mps, 0.0, 0.0}), speed_mps)) {
      if (mode.frequency_radps > 0.0) continue;
      EXPECT_THAT(mode.name, testing::AnyOf("heading", "heave, neutral", "heading and heave, neutral")) << speed_mps;
      ++neutral;
    }
    EXPECT_GE(neutral, 1) << speed_mps;
  }
}

/// A rigid body whose roll rate decays: the closed form of one mode.
TEST(Modes, NameTheRollSubsidence) {
  NamedLinearSystem linear{{"p", "phi", "u"}, {}, {"rad/s", "rad", "m/s"}, {}, {}};
  linear.system.A = Eigen::Matrix3d{{-4.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  const std::vector<Mode> found = modes(linear, 20.0);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[2].name, "roll subsidence");
  EXPECT_DOUBLE_EQ(found[2].frequency_radps, 4.0);
  EXPECT_DOUBLE_EQ(found[2].damping, 1.0);
  EXPECT_EQ(found[0].name, "spiral");
}

TEST(Modes, EigenvectorsSolveTheModel) {
  const NamedLinearSystem linear = *linear_system(helicopter::HelicopterConfig{}, {8.0, 0.0, 0.0});
  constexpr double kRounding = 1e-8;
  const std::vector<Mode> found = modes(linear, 8.0);
  ASSERT_FALSE(found.empty());
  for (const Mode& mode : found) {
    const Eigen::VectorXcd residual =
        linear.system.A.cast<std::complex<double>>() * mode.eigenvector - mode.eigenvalue * mode.eigenvector;
    EXPECT_LT(residual.norm(), kRounding * (1.0 + mode.frequency_radps) * mode.eigenvector.norm()) << mode.name;
  }
}

}  // namespace
}  // namespace hedgehop::dynamics
