#include "avoidance/stereo_corridor/climb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::stereo_corridor {
namespace {

constexpr ClimbLimits kClimbLimits{.rate_mps = 1.0, .acceleration_mps2 = 2.0};
constexpr double kClimbReactionS = 0.5;

double slope_at(double elevation_deg) { return std::tan(elevation_deg * M_PI / 180.0); }

TEST(Climb, SlopeIsTheTangentOfTheElevation) {
  for (const double azimuth : {-2.0, 0.0, 0.7}) {
    const Eigen::Vector3d up(7.0 * std::cos(azimuth), 7.0 * std::sin(azimuth), -3.0);
    EXPECT_NEAR(slope_of(up), 3.0 / 7.0, 1e-12);
    EXPECT_NEAR(slope_of(-up), -3.0 / 7.0, 1e-12);
  }
}

TEST(Climb, AtTheClimbingSpeedTheClimbAngleIsThatOfTheRay) {
  for (const double elevation_deg : {-25.0, -10.0, 5.0, 15.0, 25.0}) {
    const double speed_mps = climbing_speed_mps(slope_at(elevation_deg), kClimbLimits);
    EXPECT_NEAR(std::atan2(kClimbLimits.rate_mps, speed_mps) * 180.0 / M_PI, std::abs(elevation_deg), 1e-9);
  }
  EXPECT_TRUE(std::isinf(climbing_speed_mps(0.0, kClimbLimits)));
}

/// Integrates the flight along a ray that starts at the vehicle. @return its largest height above the vehicle.
double flown_lag_m(double slope, double speed_mps) {
  constexpr double kStepS = 1e-4;
  double along_m = 0.0, altitude_m = 0.0, lag_m = 0.0, v_mps = speed_mps;
  for (double t_s = 0.0; t_s < 5.0; t_s += kStepS) {
    if (t_s >= kClimbReactionS) {
      altitude_m += kStepS * std::min(kClimbLimits.rate_mps, slope * v_mps);
      if (v_mps * slope > kClimbLimits.rate_mps) v_mps -= kStepS * kClimbLimits.acceleration_mps2;
    }
    along_m += kStepS * v_mps;
    lag_m = std::max(lag_m, slope * along_m - altitude_m);
  }
  return lag_m;
}

TEST(Climb, LagIsThatOfAFlightThatDeceleratesToTheClimbingSpeed) {
  constexpr double kTruncation = 2e-3;
  for (const double elevation_deg : {3.0, 10.0, 15.0, 25.0}) {
    for (const double speed_mps : {0.5, 2.0, 5.0}) {
      const double slope = slope_at(elevation_deg);
      EXPECT_NEAR(lag_behind_ray_m(slope, speed_mps, kClimbLimits), flown_lag_m(slope, speed_mps), kTruncation)
          << elevation_deg << " deg at " << speed_mps << " m/s";
      EXPECT_EQ(lag_behind_ray_m(-slope, speed_mps, kClimbLimits), lag_behind_ray_m(slope, speed_mps, kClimbLimits));
    }
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo_corridor
