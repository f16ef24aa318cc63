#include "vision/landmarks/landmark_matching.h"

#include <gtest/gtest.h>

#include "sim/reproduce/corner_flight.h"
#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Points in front of a camera, and their bearings from a true pose that differs from the estimate.
struct Sight {
  CameraPose pose;
  CameraError error_true;
  std::vector<std::optional<PredictedBearing>> predicted;
  std::vector<Vector2d> bearings_meas;
};

constexpr double kCameraBearingSigma = 5e-4;

Sight random_sight(std::mt19937_64& random, size_t points, double clutter) {
  std::normal_distribution<double> normal;
  Sight sight;
  sight.pose = {sim::looking_at({-42, 0, -42}, {0, 0, -5}), 0.4, 1e-3};
  for (int i = 0; i < 6; ++i) {
    sight.error_true[i] = (i < 3 ? sight.pose.position_sigma_m : sight.pose.attitude_sigma_rad) * normal(random);
  }
  const CameraPose where = corrected(sight.pose, sight.error_true);
  for (size_t i = 0; i < points; ++i) {
    Landmark landmark;
    landmark.x = {uniform(random, -12, 12), uniform(random, -12, 12), uniform(random, -15, 0)};
    landmark.P = 1e-4 * Eigen::Matrix3d::Identity();
    sight.predicted.push_back(predict_bearing(landmark, sight.pose, kCameraBearingSigma));
    const bool hidden = uniform(random, 0, 1) < 0.2;
    if (hidden) continue;
    const Vector2d noise(normal(random), normal(random));
    sight.bearings_meas.push_back(predict_bearing(landmark, where, kCameraBearingSigma)->bearing +
                                  kCameraBearingSigma * noise);
  }
  for (double k = 0; k < clutter * static_cast<double>(points); ++k) {
    sight.bearings_meas.emplace_back(uniform(random, -0.25, 0.25), uniform(random, -0.25, 0.25));
  }
  return sight;
}

// The corrected positions of landmarks are compared, because translation and rotation are almost indistinguishable.
double worst_residual(const Sight& sight, const CameraError& error) {
  double worst = 0.0;
  for (const auto& seen : sight.predicted) {
    worst = std::max(worst, (seen->d_bearing_pose * (error - sight.error_true)).norm());
  }
  return worst;
}

TEST(CameraError, IsFoundDespiteHiddenPointsAndClutter) {
  std::mt19937_64 random(31);
  int found = 0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Sight sight = random_sight(random, 30, 0.5);
    const CameraError error =
        common_error(sight.predicted, sight.bearings_meas, error_covariance(sight.pose), kCameraBearingSigma);
    found += worst_residual(sight, error) < 5.0 * kCameraBearingSigma;
  }
  EXPECT_GE(found, kTrials * 97 / 100);  // clutter close to a hidden point occasionally causes an error
}

TEST(CameraError, CorrectedPoseEqualsTheTruePose) {
  std::mt19937_64 random(32);
  for (int trial = 0; trial < 50; ++trial) {
    CameraError error;
    for (int i = 0; i < 6; ++i) error[i] = uniform(random, -0.1, 0.1);
    const CameraPose pose{sim::looking_at({-42, 0, -42}, {0, 0, -5}), 0.4, 1e-3};
    const Eigen::Isometry3d X_CC = pose.X_WC_est.inverse() * corrected(pose, error).X_WC_est;
    EXPECT_LT((X_CC.translation() - error.head<3>()).norm(), 1e-12);
    const Eigen::AngleAxisd turn(X_CC.linear());
    EXPECT_LT((turn.angle() * turn.axis() - error.tail<3>()).norm(), 1e-12);
  }
}

TEST(CameraError, IsZeroWithoutLandmarksOrMeasurements) {
  std::mt19937_64 random(33);
  const Sight sight = random_sight(random, 10, 0.0);
  const auto prior = error_covariance(sight.pose);
  EXPECT_TRUE(common_error({}, sight.bearings_meas, prior, kCameraBearingSigma).isZero());
  EXPECT_TRUE(common_error(sight.predicted, {}, prior, kCameraBearingSigma).isZero());
}

TEST(CameraError, KnownPoseKeepsOnlyLandmarkAndMeasurementCovariance) {
  std::mt19937_64 random(34);
  const Sight sight = random_sight(random, 10, 0.0);
  for (const auto& seen : sight.predicted) {
    const Eigen::Matrix2d expected = 1e-4 * seen->d_bearing_x * seen->d_bearing_x.transpose() +
                                     kCameraBearingSigma * kCameraBearingSigma * Eigen::Matrix2d::Identity();
    EXPECT_LT((with_known_pose(*seen, kCameraBearingSigma).covariance - expected).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
