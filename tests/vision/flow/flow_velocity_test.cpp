#include "vision/flow/flow_velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/vision/flow/projected_flow.h"

namespace hedgehop::vision::flow {
namespace {

const camera::PinholeCamera kVelocityCamera = camera::PinholeCamera::from_fov(400, 400, std::numbers::pi / 2);
constexpr double kVelocityPeriodS = 0.02;

// A camera under the fuselage that looks down: C's x is B's y, C's y is -B's x.
Eigen::Isometry3d down_camera() {
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.linear().col(0) = Eigen::Vector3d::UnitY();
  X_BC.linear().col(1) = -Eigen::Vector3d::UnitX();
  X_BC.linear().col(2) = Eigen::Vector3d::UnitZ();
  X_BC.translation() = Eigen::Vector3d(0.3, -0.1, 0.2);
  return X_BC;
}

struct Flight {
  FlowField field;
  FlowMotion motion;
  Eigen::Vector3d v_WB_B;
};

// Flow of level ground from a random state, with constant w and v.
Flight random_flight(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Flight flight;
  FlowMotion& motion = flight.motion;
  motion.q_WB = Eigen::AngleAxisd(std::numbers::pi * uniform(random), Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(0.25 * uniform(random), Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(0.25 * uniform(random), Eigen::Vector3d::UnitX());
  motion.w_WB_B = 0.4 * Eigen::Vector3d{uniform(random), uniform(random), uniform(random)};
  motion.height_above_ground_m = 6.0 + 4.0 * uniform(random);
  motion.dt_s = kVelocityPeriodS;
  flight.v_WB_B = 2.0 * Eigen::Vector3d{uniform(random), uniform(random), 0.3 * uniform(random)};

  const Eigen::Isometry3d X_BC = down_camera();
  const Eigen::Matrix3d R_CB = X_BC.linear().transpose();
  const Eigen::Vector3d down_C = R_CB * (motion.q_WB.conjugate() * Eigen::Vector3d::UnitZ());
  const double height_m = motion.height_above_ground_m - (motion.q_WB * X_BC.translation()).z();
  const Eigen::Vector3d v_WC_B = flight.v_WB_B + motion.w_WB_B.cross(X_BC.translation());
  flight.field = plane_flow(kVelocityCamera, grid_field(8, 8, 60, 400), height_m * down_C, down_C, R_CB * v_WC_B,
                            R_CB * motion.w_WB_B, kVelocityPeriodS);
  return flight;
}

TEST(FlowVelocity, EqualsTheTrueVelocityOverLevelGround) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Flight flight = random_flight(random);
    const auto found = flow_velocity(flight.field, kVelocityCamera, down_camera(), flight.motion);
    ASSERT_TRUE(found);
    // Motion within one period is modeled to first order, with an error of 1 % of the speed.
    EXPECT_LT((found->v_WB_B_xy_meas - flight.v_WB_B.head<2>()).norm(), 0.03);
    EXPECT_GE(found->agreeing, 30);
  }
}

TEST(FlowVelocity, IsRobustToThirtyPercentOfWrongVectors) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.05);
  for (int trial = 0; trial < 200; ++trial) {
    Flight flight = random_flight(random);
    for (FlowVector& vector : flight.field.vectors) {
      vector.flow_px += Eigen::Vector2d{noise(random), noise(random)};
      if (uniform(random) < -0.4) vector.flow_px += 8.0 * Eigen::Vector2d{uniform(random), uniform(random)};
    }
    const auto found = flow_velocity(flight.field, kVelocityCamera, down_camera(), flight.motion);
    ASSERT_TRUE(found);
    EXPECT_LT((found->v_WB_B_xy_meas - flight.v_WB_B.head<2>()).norm(), 0.15);
  }
}

TEST(FlowVelocity, IsRobustToARoofInThirtyPercentOfTheView) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    Flight flight = random_flight(random);
    // The right columns image a roof at 60 % of the range, which increases their translational flow.
    for (int row = 0; row < 8; ++row) {
      for (int col = 6; col < 8; ++col) flight.field.at(row, col).flow_px *= 1.0 / 0.6;
    }
    const auto found = flow_velocity(flight.field, kVelocityCamera, down_camera(), flight.motion);
    ASSERT_TRUE(found);
    EXPECT_LT((found->v_WB_B_xy_meas - flight.v_WB_B.head<2>()).norm(), 0.2);
  }
}

TEST(FlowVelocity, StatesItsOwnError) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0.0, 0.3);
  FlowVelocityConfig config;
  config.sigma_floor_mps = 0.0;
  double squares = 0.0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    Flight flight = random_flight(random);
    for (FlowVector& vector : flight.field.vectors) vector.flow_px += Eigen::Vector2d{noise(random), noise(random)};
    const auto found = flow_velocity(flight.field, kVelocityCamera, down_camera(), flight.motion, config);
    ASSERT_TRUE(found);
    squares += (found->v_WB_B_xy_meas - flight.v_WB_B.head<2>()).squaredNorm() / (found->sigma_mps * found->sigma_mps);
  }
  const double ratio = squares / (2 * kTrials);  // 1 when errors match the reported sigma
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 1.6);
}

TEST(FlowVelocity, IsUnknownWithTooFewVectors) {
  std::mt19937_64 random(5);
  const Flight flight = random_flight(random);
  const auto found = [&](auto change) {
    Flight changed = flight;
    change(changed);
    return flow_velocity(changed.field, kVelocityCamera, down_camera(), changed.motion).has_value();
  };
  EXPECT_TRUE(found([](Flight&) {}));
  EXPECT_FALSE(found([](Flight& f) {
    for (FlowVector& v : f.field.vectors) v.valid = false;
  }));
  EXPECT_FALSE(found([](Flight& f) {
    for (size_t i = 7; i < f.field.vectors.size(); ++i) f.field.vectors[i].valid = false;
  }));
  EXPECT_FALSE(found([](Flight& f) { f.motion.height_above_ground_m = 0.05; }));
  EXPECT_FALSE(found([](Flight& f) { f.motion.height_above_ground_m = std::nan(""); }));
  EXPECT_FALSE(found([](Flight& f) { f.motion.dt_s = 0.0; }));
  // Upside down there is no ground.
  EXPECT_FALSE(found([](Flight& f) {
    f.motion.q_WB = f.motion.q_WB * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX());
  }));
}

}  // namespace
}  // namespace hedgehop::vision::flow
