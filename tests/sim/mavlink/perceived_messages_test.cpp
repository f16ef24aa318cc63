#include "sim/mavlink/perceived_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hedgehop::sim::mavlink {
namespace {

constexpr double kTiltRad = std::numbers::pi / 6.0;
constexpr int64_t kNowNs = 2'500'000'000;

Eigen::Quaterniond rolled(double roll_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()));
}

TEST(PerceivedMessages, SectorsAreInCentimetersWithFreeAndUnknownOnes) {
  ObstacleSectors sectors;
  sectors.add_obstacle(5.0, 0.0, 5.0);
  sectors.add_obstacle(0.01, 0.0, 0.01);  // nearer than the minimum
  sectors.add_obstacle(0.0, 7.504, 7.504);
  sectors.add_free(-1.0, 0.0);
  const ObstacleDistance message = obstacle_distance(kNowNs, sectors, {1.0, 1.0, 0.2, 20.0});
  EXPECT_EQ(message.time_usec, 2'500'000u);
  EXPECT_EQ(message.distances[0], 20);
  EXPECT_EQ(message.distances[18], 750) << "90 deg to the right";
  EXPECT_EQ(message.distances[36], 2001);
  EXPECT_EQ(message.distances[1], 65535);
  EXPECT_EQ(message.increment, 5);
  EXPECT_EQ(message.frame, 12);
}

/// ArduPilot multiplies the range by the cosine of the tilt to get the height.
TEST(PerceivedMessages, RangeOfATiltedVehicleTimesTheCosineIsTheHeight) {
  const DistanceSensor message = height_reading(kNowNs, 10.0, rolled(kTiltRad));
  EXPECT_NEAR(message.current_distance * std::cos(kTiltRad), 1000.0, 1.0);
  EXPECT_EQ(message.orientation, 25);
  EXPECT_EQ(message.time_boot_ms, 2500u);
}

TEST(PerceivedMessages, PosesAreThoseOfTheEstimate) {
  avoidance::NavigationState navigation;
  navigation.p_WB_est = Eigen::Vector3d(3.0, 4.0, -5.0);
  navigation.q_WB_est = Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) *
                        Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitX());
  navigation.v_WB_B_est = Eigen::Vector3d(1.0, 2.0, 3.0);
  navigation.w_WB_B_est = Eigen::Vector3d(0.1, 0.2, 0.3);
  const Eigen::Vector3d p_origin_W(1.0, 1.0, -1.0);
  const VisionPositionEstimate pose = vision_position(kNowNs, navigation, p_origin_W);
  EXPECT_FLOAT_EQ(pose.x, 2.0f);
  EXPECT_FLOAT_EQ(pose.y, 3.0f);
  EXPECT_FLOAT_EQ(pose.z, -4.0f);
  EXPECT_FLOAT_EQ(pose.roll, -0.3f);
  EXPECT_FLOAT_EQ(pose.pitch, 0.2f);
  EXPECT_FLOAT_EQ(pose.yaw, 2.0f);
  const Odometry odometry_message = odometry(kNowNs, navigation, p_origin_W);
  const Eigen::Quaternionf q(odometry_message.q[0], odometry_message.q[1], odometry_message.q[2],
                             odometry_message.q[3]);
  EXPECT_NEAR(q.cast<double>().angularDistance(navigation.q_WB_est), 0.0, 1e-6);
  EXPECT_EQ(odometry_message.vz, 3.0f);
  EXPECT_FLOAT_EQ(odometry_message.yawspeed, 0.3f);
}

vision::flow::GroundVelocityReading moving(const Eigen::Vector2d& v_WB_B_xy, const Eigen::Vector3d& w_WB_B,
                                           double height_m, double dt_s) {
  return {{.v_WB_B_xy_meas = v_WB_B_xy, .agreeing = 32},
          {.w_WB_B = w_WB_B, .height_above_ground_m = height_m, .dt_s = dt_s}};
}

/// The signs of the definition of OPTICAL_FLOW_RAD.
TEST(PerceivedMessages, FlowHasTheSignsOfItsDefinition) {
  const auto integrated = [](const Eigen::Vector2d& v, const Eigen::Vector3d& w) {
    return optical_flow_rad(kNowNs, perceived_flow(moving(v, w, 4.0, 0.05)));
  };
  const OpticalFlowRad right = integrated({0.0, 2.0}, Eigen::Vector3d::Zero());
  EXPECT_FLOAT_EQ(right.integrated_x, -0.025f) << "2 m/s at 4 m in 0.05 s";
  EXPECT_FLOAT_EQ(right.integrated_y, 0.0f);
  const OpticalFlowRad ahead = integrated({2.0, 0.0}, Eigen::Vector3d::Zero());
  EXPECT_FLOAT_EQ(ahead.integrated_x, 0.0f);
  EXPECT_FLOAT_EQ(ahead.integrated_y, 0.025f);
  const OpticalFlowRad rolling = integrated({0.0, 0.0}, {0.4, -0.2, 0.1});
  EXPECT_FLOAT_EQ(rolling.integrated_x, 0.02f);
  EXPECT_FLOAT_EQ(rolling.integrated_xgyro, 0.02f) << "a rotation alone: flow less gyro is 0";
  EXPECT_FLOAT_EQ(rolling.integrated_y, rolling.integrated_ygyro);
  EXPECT_FLOAT_EQ(rolling.integrated_zgyro, 0.005f);
  EXPECT_EQ(rolling.integration_time_us, 50'000u);
  EXPECT_EQ(rolling.quality, 128);
}

TEST(PerceivedMessages, FlowRateWithoutRotationIsSpeedOverDistance) {
  const OpticalFlow message =
      optical_flow(kNowNs, perceived_flow(moving({3.0, -1.0}, {0.2, 0.1, 0.0}, 5.0, 0.02)), 200.0);
  EXPECT_FLOAT_EQ(message.flow_rate_x, 0.2f + 0.2f);
  EXPECT_FLOAT_EQ(message.flow_rate_y, 0.1f + 0.6f);
  EXPECT_EQ(message.flow_comp_m_x, 3.0f);
  EXPECT_EQ(message.flow_comp_m_y, -1.0f);
  EXPECT_EQ(message.ground_distance, 5.0f);
  EXPECT_EQ(message.flow_x, 16) << "0.4 rad/s, 200 px, 0.02 s: 1.6 px";
}

}  // namespace
}  // namespace hedgehop::sim::mavlink
