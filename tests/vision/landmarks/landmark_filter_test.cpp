#include "vision/landmarks/landmark_filter.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>

#include "sim/reproduce/corner_flight.h"
#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d;
using sim::looking_at;

constexpr double kImageS = 0.1;

/// A map built from a fixed camera.
class StandingCamera : public testing::Test {
 protected:
  std::vector<int64_t> see(const std::vector<Vector2d>& corners_px) { return map_.update(corners_px, pose_, kImageS); }

  LandmarkMapConfig config_{.misses = 5, .confirm = 3, .unconfirmed_misses = 2};
  camera::PinholeCamera camera_ = camera::PinholeCamera::from_fov(640, 480, std::numbers::pi / 6.0);
  CameraPose pose_{looking_at({-40, 0, -40}, {0, 0, 0}), 0.1, 1e-4};
  LandmarkMap map_{config_, camera_};
};
using LandmarkMapOfAFixedCamera = StandingCamera;

TEST_F(LandmarkMapOfAFixedCamera, RecognizesACornerSeenAgain) {
  const auto first = see({{100, 100}, {500, 300}});
  const auto again = see({{500, 300}, {100, 100}});
  EXPECT_EQ(again, (std::vector<int64_t>{first[1], first[0]}));
  EXPECT_EQ(map_.landmarks().size(), 2U);
}

TEST_F(LandmarkMapOfAFixedCamera, StartsALandmarkForAnUnknownCorner) {
  see({{100, 100}});
  const auto ids = see({{100, 100}, {400, 200}});
  EXPECT_NE(ids[0], ids[1]);
  EXPECT_EQ(map_.landmarks().size(), 2U);
}

TEST_F(LandmarkMapOfAFixedCamera, DeletesAConfirmedLandmarkAfterItsMaximumOfMisses) {
  for (int i = 0; i < config_.confirm; ++i) see({{320, 240}});
  for (int i = 1; i < config_.misses; ++i) {
    see({});
    EXPECT_EQ(map_.landmarks().size(), 1U) << i;
  }
  see({});
  EXPECT_TRUE(map_.landmarks().empty());
}

TEST_F(LandmarkMapOfAFixedCamera, TakesEstimatesFromAnAdjustment) {
  std::vector<int64_t> ids;
  for (int i = 0; i < config_.confirm; ++i) ids = see({{100, 100}, {500, 300}, {320, 240}});
  const Eigen::Vector3d p_W(1.0, 2.0, -3.0);
  const Eigen::Matrix3d P_W = 0.04 * Eigen::Matrix3d::Identity();
  map_.refine(std::vector<AdjustedLandmark>{{.id = ids[0], .p_W = p_W, .covariance_W = P_W},
                                            {.id = ids[1], .is_point = false},
                                            {.id = ids[2], .is_duplicate = true},
                                            {.id = 99, .p_W = p_W}});
  ASSERT_EQ(map_.landmarks().size(), 2U);
  EXPECT_EQ(position_W(map_.landmarks()[0].landmark), p_W);
  EXPECT_EQ(covariance_W(map_.landmarks()[0].landmark), P_W);
  EXPECT_TRUE(map_.confirmed(map_.landmarks()[0]));
  EXPECT_FALSE(map_.confirmed(map_.landmarks()[1]));
}

TEST_F(LandmarkMapOfAFixedCamera, DeletesAnUnconfirmedLandmarkSooner) {
  see({{320, 240}});
  for (int i = 0; i < config_.unconfirmed_misses; ++i) see({});
  EXPECT_TRUE(map_.landmarks().empty());
}

TEST_F(LandmarkMapOfAFixedCamera, KeepsALandmarkThatIsOutOfView) {
  for (int i = 0; i < config_.confirm; ++i) see({{320, 240}});
  pose_.X_WC_est = looking_at({-40, 0, -40}, {-80, 0, 0});
  for (int i = 0; i < 3 * config_.misses; ++i) see({});
  EXPECT_EQ(map_.landmarks().size(), 1U);
}

/// Returns the landmark, if it is kept, after a passing camera observed it in `seen` of its first images and then
/// missed it while it was in view.
size_t landmarks_after_hiding(const std::function<bool(int)>& seen) {
  const camera::PinholeCamera camera = camera::PinholeCamera::from_fov(640, 480, std::numbers::pi / 6.0);
  const Eigen::Vector3d p_W(0, 0, 0);
  constexpr int kSeen = 100, kHidden = 100;
  LandmarkMap map({.misses = 30, .confirm = 10, .unconfirmed_misses = 6}, camera);
  for (int i = 0; i < kSeen + kHidden; ++i) {
    const CameraPose pose{looking_at({-40, 0.2 * i, -40}, p_W), 0.05, 1e-4};
    const std::vector<Vector2d> corners = {*camera.project(pose.X_WC_est.inverse() * p_W)};
    map.update(i < kSeen && seen(i) ? corners : std::vector<Vector2d>{}, pose, kImageS);
  }
  return map.landmarks().size();
}

TEST(LandmarkMap, KeepsAWellKnownOccludedLandmark) {
  EXPECT_EQ(landmarks_after_hiding([](int) { return true; }), 1U);
  EXPECT_EQ(landmarks_after_hiding([](int i) { return i % 3 != 2; }), 1U);
}

TEST(LandmarkMap, DeletesALandmarkMissedInMostImages) {
  EXPECT_EQ(landmarks_after_hiding([](int i) { return i % 3 == 0; }), 0U);
}

// Uncertainty lowers the Z values of a landmark, so that a new landmark often has the minimum.
TEST(LandmarkMap, UnconfirmedLandmarkDoesNotTakeTheCornerOfAConfirmedOne) {
  std::mt19937_64 random(8);
  const camera::PinholeCamera camera = camera::PinholeCamera::from_fov(640, 480, std::numbers::pi / 6.0);
  const Eigen::Vector3d p_W(0, 0, 0);
  constexpr int kKnowing = 100, kBegun = 40;
  LandmarkMap map({.misses = kKnowing, .confirm = 20, .unconfirmed_misses = kKnowing}, camera);
  int64_t known = -1;
  for (int i = 0; i < kKnowing; ++i) {
    const CameraPose pose{looking_at({-40, 0.3 * i, -40}, p_W), 1e-3, 1e-6};
    const Vector2d corner =
        *camera.project(pose.X_WC_est.inverse() * p_W) + Vector2d(uniform(random, -1, 1), uniform(random, -1, 1));
    std::vector<Vector2d> corners = {corner};
    if (i == kBegun) corners.emplace_back(corner + Vector2d(8, 0));
    const auto ids = map.update(corners, pose, kImageS);
    if (i == 0) known = ids[0];
    EXPECT_EQ(ids[0], known) << i;
  }
  EXPECT_EQ(map.landmarks().size(), 2U);
}

// With errors correlated over 1 s, twenty images at 0.1 s have the weight of one image with white errors. Across the
// line of sight only, because a fixed camera does not measure depth.
TEST(LandmarkMap, ImagesWithCorrelatedErrorsCountAsOne) {
  const camera::PinholeCamera camera = camera::PinholeCamera::from_fov(640, 480, std::numbers::pi / 6.0);
  const CameraPose pose{looking_at({-40, 0, -40}, {0, 0, 0}), 0.3, 0.0};
  const auto east_variance_after = [&](int images, double correlation_s) {
    LandmarkMapConfig config{.pixel_sigma_px = 1e-3, .correlation_s = correlation_s};
    config.start = {.coordinates = LandmarkCoordinates::cartesian, .ground_sigma = 1e-3};
    LandmarkMap map(config, camera);
    const std::vector<Vector2d> corner = {{320, 240}};
    map.update(corner, pose, 0.0);
    for (int i = 0; i < images; ++i) map.update(corner, pose, kImageS);
    return covariance_W(map.landmarks().at(0).landmark)(1, 1);
  };
  const double white = east_variance_after(10, 0.0);
  constexpr double kStart = 0.01;  // the first image is worth a whole one either way
  EXPECT_NEAR(east_variance_after(200, 1.0) / white, 1.0, kStart);
  EXPECT_LT(east_variance_after(200, 0.0), 0.1 * white);
}

TEST(LandmarkMap, RejectsAnInvalidConfig) {
  const camera::PinholeCamera camera = camera::PinholeCamera::from_fov(64, 64, 1.0);
  const auto refuse = [&](auto change) {
    LandmarkMapConfig config;
    change(config);
    EXPECT_THROW(LandmarkMap(config, camera), std::invalid_argument);
  };
  refuse([](LandmarkMapConfig& c) { c.start.ground_sigma = 0; });
  refuse([](LandmarkMapConfig& c) { c.start.nearest_m = -1; });
  refuse([](LandmarkMapConfig& c) { c.start.beyond_horizon_m = NAN; });
  refuse([](LandmarkMapConfig& c) { c.pixel_sigma_px = 0; });
  refuse([](LandmarkMapConfig& c) { c.position_sigma_m = -1; });
  refuse([](LandmarkMapConfig& c) { c.attitude_sigma_rad = NAN; });
  refuse([](LandmarkMapConfig& c) { c.drift_m_rt_s = -1; });
  refuse([](LandmarkMapConfig& c) { c.correlation_s = -1; });
  refuse([](LandmarkMapConfig& c) { c.gate = 0; });
  refuse([](LandmarkMapConfig& c) { c.misses = 0; });
  refuse([](LandmarkMapConfig& c) { c.unconfirmed_misses = 0; });
  refuse([](LandmarkMapConfig& c) { c.confirm = 0; });
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
