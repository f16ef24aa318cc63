#include "vision/landmarks/landmark.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBearingSigma = 1e-3;

Vector3d uniform3(std::mt19937_64& random, double half) {
  return {uniform(random, -half, half), uniform(random, -half, half), uniform(random, -half, half)};
}

Eigen::Isometry3d random_pose(std::mt19937_64& random) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() = Eigen::AngleAxisd(uniform(random, -3, 3), uniform3(random, 1.0).normalized()).toRotationMatrix();
  X_WC.translation() = uniform3(random, 50.0);
  return X_WC;
}

Eigen::Matrix3d random_covariance(std::mt19937_64& random, const Vector3d& sigma) {
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i) = uniform(random, -1, 1);
  return sigma.asDiagonal() * (root * root.transpose() + 0.1 * Eigen::Matrix3d::Identity()) * sigma.asDiagonal();
}

/// A landmark in front of a camera, in either kind of coordinates, first observed by a nearby camera.
Landmark random_landmark(std::mt19937_64& random, const Eigen::Isometry3d& X_WC, LandmarkCoordinates coordinates) {
  const double z_m = uniform(random, 5, 100);
  const Vector3d p_C(z_m * uniform(random, -0.4, 0.4), z_m * uniform(random, -0.4, 0.4), z_m);
  Landmark landmark;
  landmark.coordinates = coordinates;
  if (coordinates == LandmarkCoordinates::cartesian) {
    landmark.x = X_WC * p_C;
    landmark.P = random_covariance(random, Vector3d::Constant(2.0));
    return landmark;
  }
  landmark.X_WA = X_WC;
  landmark.X_WA.translation() += X_WC.linear() * Vector3d(uniform(random, -2, 2), uniform(random, -2, 2), -1.0);
  const Vector3d p_A = landmark.X_WA.inverse() * (X_WC * p_C);
  landmark.x = {p_A.x() / p_A.z(), p_A.y() / p_A.z(), 1.0 / p_A.z()};
  landmark.P = random_covariance(random, Vector3d(1e-3, 1e-3, 0.2 / z_m));
  return landmark;
}

class EachCoordinates : public testing::TestWithParam<LandmarkCoordinates> {};
INSTANTIATE_TEST_SUITE_P(Landmark, EachCoordinates,
                         testing::Values(LandmarkCoordinates::cartesian, LandmarkCoordinates::inverse_depth),
                         [](const auto& instance) {
                           return instance.param == LandmarkCoordinates::cartesian ? "cartesian" : "inverse_depth";
                         });

// Reference: projection with the camera's axes as columns of R_WC.
TEST_P(EachCoordinates, BearingIsTheProjectionOfThePoint) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Isometry3d X_WC = random_pose(random);
    const Landmark landmark = random_landmark(random, X_WC, GetParam());
    const Vector3d from_eye_W = position_W(landmark) - X_WC.translation();
    const double z_m = from_eye_W.dot(X_WC.linear().col(2));
    const auto seen = predict_bearing(landmark, {X_WC, 0, 0}, kBearingSigma);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->bearing.x(), from_eye_W.dot(X_WC.linear().col(0)) / z_m, 1e-12);
    EXPECT_NEAR(seen->bearing.y(), from_eye_W.dot(X_WC.linear().col(1)) / z_m, 1e-12);
  }
}

TEST_P(EachCoordinates, JacobianEqualsTheFiniteDifference) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Isometry3d X_WC = random_pose(random);
    const Landmark landmark = random_landmark(random, X_WC, GetParam());
    const auto seen = predict_bearing(landmark, {X_WC, 0, 0}, kBearingSigma);
    ASSERT_TRUE(seen);
    for (int axis = 0; axis < 3; ++axis) {
      const double step = 1e-5 * std::max(1e-2, std::abs(landmark.x[axis]));
      Landmark ahead = landmark, behind = landmark;
      ahead.x[axis] += step;
      behind.x[axis] -= step;
      const Vector2d difference = (predict_bearing(ahead, {X_WC, 0, 0}, kBearingSigma)->bearing -
                                   predict_bearing(behind, {X_WC, 0, 0}, kBearingSigma)->bearing) /
                                  (2.0 * step);
      const double scale = seen->d_bearing_x.col(axis).norm() + 1e-3;
      EXPECT_LT((seen->d_bearing_x.col(axis) - difference).norm() / scale, 1e-6) << axis;
    }
  }
}

TEST_P(EachCoordinates, JacobianOfTheCameraErrorEqualsTheFiniteDifference) {
  std::mt19937_64 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Isometry3d X_WC = random_pose(random);
    const Landmark landmark = random_landmark(random, X_WC, GetParam());
    const auto seen = predict_bearing(landmark, {X_WC, 0, 0}, kBearingSigma);
    ASSERT_TRUE(seen);
    for (int axis = 0; axis < 6; ++axis) {
      constexpr double kStep = 1e-5;
      const auto from = [&](double step) {
        Eigen::Isometry3d X_CC = Eigen::Isometry3d::Identity();
        if (axis < 3) {
          X_CC.translation() = step * Vector3d::Unit(axis);
        } else {
          X_CC.linear() = Eigen::AngleAxisd(step, Vector3d::Unit(axis - 3)).toRotationMatrix();
        }
        return predict_bearing(landmark, {X_WC * X_CC, 0, 0}, kBearingSigma)->bearing;
      };
      const Vector2d difference = (from(kStep) - from(-kStep)) / (2.0 * kStep);
      EXPECT_LT((seen->d_bearing_pose.col(axis) - difference).norm(), 1e-7) << axis;
    }
  }
}

// The navigation noise equals the spread of bearings from random poses.
TEST_P(EachCoordinates, NavigationNoiseEqualsTheSpreadOverRandomPoses) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto normal3 = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  constexpr int kDraws = 20000;
  for (int trial = 0; trial < 4; ++trial) {
    const Eigen::Isometry3d X_WC = random_pose(random);
    const Landmark landmark = random_landmark(random, X_WC, GetParam());
    const CameraPose pose{X_WC, 0.03, 2e-3};
    const auto seen = predict_bearing(landmark, pose, 1e-9);
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (int draw = 0; draw < kDraws; ++draw) {
      Eigen::Isometry3d moved = X_WC;
      moved.translation() += pose.position_sigma_m * normal3();
      const Vector3d turn_C = pose.attitude_sigma_rad * normal3();
      moved.linear() = X_WC.linear() * Eigen::AngleAxisd(turn_C.norm(), turn_C.normalized()).toRotationMatrix();
      const Vector2d off = predict_bearing(landmark, {moved, 0, 0}, 1e-9)->bearing - seen->bearing;
      spread += off * off.transpose() / kDraws;
    }
    EXPECT_LT((spread - seen->noise).norm() / seen->noise.norm(),
              0.05);  // 1 % from the number of draws, plus curvature
  }
}

TEST_P(EachCoordinates, UpdateMovesTheProjectionTowardItsMeasurement) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Isometry3d X_WC = random_pose(random);
    const CameraPose pose{X_WC, 0.1, 1e-3};
    const Landmark landmark = random_landmark(random, X_WC, GetParam());
    const auto seen = predict_bearing(landmark, pose, kBearingSigma);
    ASSERT_TRUE(seen);
    const Vector2d measured = seen->bearing + Vector2d(uniform(random, -5e-3, 5e-3), uniform(random, -5e-3, 5e-3));
    const Landmark better = updated(landmark, *seen, measured);
    const auto after = predict_bearing(better, pose, kBearingSigma);
    ASSERT_TRUE(after);
    const Eigen::Matrix2d weight = seen->covariance.inverse();
    const auto distance = [&](const Vector2d& d) { return d.dot(weight * d); };
    EXPECT_LT(distance(measured - after->bearing), distance(measured - seen->bearing));
  }
}

// For a fixed linear model the filter is Bayes' rule in information form.
TEST_P(EachCoordinates, UpdatedCovarianceEqualsTheInformationForm) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Isometry3d X_WC = random_pose(random);
    const Landmark landmark = random_landmark(random, X_WC, GetParam());
    const auto seen = predict_bearing(landmark, {X_WC, 0.1, 1e-3}, kBearingSigma);
    ASSERT_TRUE(seen);
    const Eigen::Matrix3d information =
        landmark.P.inverse() + seen->d_bearing_x.transpose() * seen->noise.inverse() * seen->d_bearing_x;
    const Landmark better = updated(landmark, *seen, seen->bearing);
    EXPECT_LT((better.P * information - Eigen::Matrix3d::Identity()).norm(), 1e-5);
    EXPECT_EQ(better.x, landmark.x);
  }
}

TEST_P(EachCoordinates, DriftIncreasesTheCovarianceEquallyInAllDirections) {
  std::mt19937_64 random(6);
  const Landmark landmark = random_landmark(random, random_pose(random), GetParam());
  const Landmark later = predicted(landmark, 0.2, 9.0);
  const Eigen::Matrix3d growth = covariance_W(later) - covariance_W(landmark);
  EXPECT_LT((growth - 0.36 * Eigen::Matrix3d::Identity()).norm(), 1e-6);
  EXPECT_EQ(later.x, landmark.x);
}

TEST(Landmark, StartsOnTheGroundAlongItsRay) {
  std::mt19937_64 random(7);
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() << 0, -M_SQRT1_2, M_SQRT1_2, 1, 0, 0, 0, M_SQRT1_2, M_SQRT1_2;  // looks north, 45 degrees down
  X_WC.translation() = Vector3d(-40, 3, -42);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector2d bearing(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3));
    const Landmark landmark =
        first_seen(bearing, {X_WC, 0.4, 1e-3}, kBearingSigma, {.coordinates = LandmarkCoordinates::cartesian});
    EXPECT_NEAR(landmark.x.z(), 0.0, 1e-9);
    EXPECT_LT((predict_bearing(landmark, {X_WC, 0, 0}, kBearingSigma)->bearing - bearing).norm(), 1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(landmark.P).eigenvalues().minCoeff(), 0.0);
  }
}

TEST(Landmark, StartsAtTheMaximumDepthIfTheRayMissesTheGround) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // level
  X_WC.translation() = Vector3d(0, 0, -42);
  const LandmarkStart start{.coordinates = LandmarkCoordinates::cartesian, .beyond_horizon_m = 120.0};
  for (const double down : {-0.3, 0.0, 0.1}) {
    EXPECT_NEAR(first_seen(Vector2d(0.1, down), {X_WC, 0, 0}, kBearingSigma, start).x.x(), 120.0, 1e-9) << down;
  }
}

TEST(Landmark, InverseDepthReachesFromTheNearestToInfinityWithinTwoSigma) {
  const LandmarkStart start{.coordinates = LandmarkCoordinates::inverse_depth, .nearest_m = 10.0};
  const Landmark landmark = first_seen(Vector2d(0.1, -0.2), {}, kBearingSigma, start);
  const double sigma = std::sqrt(landmark.P(2, 2));
  EXPECT_NEAR(landmark.x.z() + 2.0 * sigma, 1.0 / 10.0, 1e-12);
  EXPECT_NEAR(landmark.x.z() - 2.0 * sigma, 0.0, 1e-12);
}

TEST(Landmark, BehindTheCameraIsInvisible) {
  Landmark landmark;
  landmark.x = {0, 0, -5};
  EXPECT_FALSE(predict_bearing(landmark, {}, kBearingSigma));
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
