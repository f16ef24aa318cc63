#include "vision/flow/feature_flow.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::flow {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kRoundOff = 1e-9;

Vector3d random_ray_vector(std::mt19937_64& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

Eigen::Matrix3d random_rotation(std::mt19937_64& random, double largest_rad) {
  return Eigen::AngleAxisd(uniform(random, 0.0, largest_rad), random_ray_vector(random, 1.0).normalized())
      .toRotationMatrix();
}

TEST(RayFlow, PureRotationLeavesNoFlow) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Vector3d p_C1 = random_ray_vector(random, 5.0);
    const Eigen::Matrix3d R_C1C2 = random_rotation(random, 0.5);
    const Vector3d before = p_C1.normalized(), after = (R_C1C2.transpose() * p_C1).normalized();
    EXPECT_LT(flow_angle_rad(before, derotate_ray(after, R_C1C2)), 1e-14);
  }
}

TEST(RayFlow, MixedMotionGivesTheDistanceOfEveryPoint) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const Vector3d p_C1P = random_ray_vector(random, 5.0), traveled = random_ray_vector(random, 0.3);
    const Eigen::Matrix3d R_C1C2 = random_rotation(random, 0.5);
    const Vector3d p_C2P_C1 = p_C1P - traveled;
    const Vector3d before = p_C1P.normalized(), after = (R_C1C2.transpose() * p_C2P_C1).normalized();
    const double measured_m = distance_m(before, derotate_ray(after, R_C1C2), traveled);
    EXPECT_NEAR(measured_m / p_C2P_C1.norm(), 1.0, 1e-7);
    EXPECT_LT(direction_error_rad(before, derotate_ray(after, R_C1C2), traveled), 1e-6);
  }
}

TEST(RayFlow, SlowMotionSatisfiesThePrintedEquation) {
  // OF = v / D sin(alpha): 0.7 m/s past a point 1.4 m away, 60 degrees off the nose, over 1 ms.
  const double v_mps = 0.7, D_m = 1.4, alpha_rad = pi / 3.0, dt_s = 1e-3;
  const Vector3d p = D_m * Vector3d(std::cos(alpha_rad), std::sin(alpha_rad), 0.0);
  const Vector3d before = p.normalized(), after = (p - Vector3d(v_mps * dt_s, 0, 0)).normalized();
  EXPECT_NEAR(flow_angle_rad(before, after) / dt_s, v_mps / D_m * std::sin(alpha_rad), 1e-3);
}

TEST(RayFlow, AngleOfTinyFlowIsAccurate) {
  const double tiny_rad = 1e-9;  // the arc cosine of the scalar product gives 0 here
  EXPECT_NEAR(flow_angle_rad(Vector3d::UnitX(), Vector3d(std::cos(tiny_rad), std::sin(tiny_rad), 0.0)) / tiny_rad, 1.0,
              1e-6);
}

TEST(RayFlow, WithoutFlowAPointIsInfinitelyFar) {
  EXPECT_EQ(distance_m(Vector3d::UnitY(), Vector3d::UnitY(), Vector3d::UnitX()),
            std::numeric_limits<double>::infinity());
}

TEST(RayFlow, FlowTowardTheDirectionOfTravelErrsByPi) {
  const Vector3d before = Vector3d::UnitY(), after = Vector3d(0.1, 1.0, 0.0).normalized();
  EXPECT_NEAR(direction_error_rad(before, after, Vector3d::UnitX()), pi, kRoundOff);
  EXPECT_NEAR(direction_error_rad(before, after, -Vector3d::UnitX()), 0.0, kRoundOff);
}

TEST(RayFlow, TangentIsMeasuredAroundTheCenterInBothDirections) {
  const Eigen::Vector2d center(100, 80), before = center + Eigen::Vector2d(30, 0);
  for (const double sign : {1.0, -1.0}) {
    for (const double degrees : {0.0, 20.0, 50.0, 90.0}) {
      const double off_rad = degrees * pi / 180.0;
      const Eigen::Vector2d after = before + sign * 2.0 * Eigen::Vector2d(std::sin(off_rad), std::cos(off_rad));
      EXPECT_NEAR(off_tangent_rad(before, after, center), off_rad, kRoundOff);
    }
  }
}

}  // namespace
}  // namespace hedgehop::vision::flow
