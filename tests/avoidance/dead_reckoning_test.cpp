#include "avoidance/dead_reckoning.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hedgehop::avoidance {
namespace {

// A circle with the nose ahead, while the estimated position wanders by a meter. The result equals the closed form.
TEST(DeadReckoning, FollowsTheVelocityWhileThePositionWanders) {
  constexpr double kRadiusM = 10.0, kTurnRadps = 0.4, kStepS = 0.08;
  DeadReckoning reckoning;
  Eigen::Vector2d begin_W = Eigen::Vector2d::Zero();
  for (int i = 0; i <= 400; ++i) {
    const double t_s = i * kStepS, turned = kTurnRadps * t_s;
    const Eigen::Vector2d p_W = kRadiusM * Eigen::Vector2d(std::sin(turned), 1.0 - std::cos(turned));
    NavigationState navigation;
    navigation.q_WB_est = Eigen::AngleAxisd(turned, Eigen::Vector3d::UnitZ());
    navigation.v_WB_B_est = {kRadiusM * kTurnRadps, 0.0, 0.0};
    navigation.p_WB_est << p_W + Eigen::Vector2d(std::sin(0.7 * t_s), std::cos(0.9 * t_s)), -6.0 + 0.1 * i;
    if (i == 0) begin_W = navigation.p_WB_est.head<2>() - p_W;
    const NavigationState reckoned = reckoning.update(navigation, t_s);
    ASSERT_LT((reckoned.p_WB_est.head<2>() - begin_W - p_W).norm(), 0.01) << t_s;
    ASSERT_EQ(reckoned.p_WB_est.z(), navigation.p_WB_est.z());  // altitude is measured
  }
}

// The estimated position jumps by a meter in hover. The first-order closed form is exp(-t / T) of the jump.
TEST(DeadReckoning, ConvergesToTheEstimateWithItsTimeConstant) {
  constexpr double kConvergeS = 20.0, kStepS = 0.1;
  DeadReckoning reckoning(kConvergeS);
  NavigationState navigation;
  reckoning.update(navigation, 0.0);
  navigation.p_WB_est.y() = 1.0;
  for (int i = 1; i <= 600; ++i) {
    const double t_s = i * kStepS;
    const double east_m = reckoning.update(navigation, t_s).p_WB_est.y();
    ASSERT_NEAR(east_m, 1.0 - std::exp(-t_s / kConvergeS), 1e-12) << t_s;
  }
}

}  // namespace
}  // namespace hedgehop::avoidance
