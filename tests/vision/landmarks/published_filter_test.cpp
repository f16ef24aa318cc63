#include "vision/landmarks/published_filter.h"

#include <gtest/gtest.h>

#include <random>

#include "sim/reproduce/corner_flight.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using sim::looking_at;

constexpr double kSigma = 1e-3, kImageS = 0.1;
constexpr PublishedFilter kFilter{.bearing_sigma = kSigma, .drift_m_rt_s = 0.0, .gate = 4.0, .misses = 5};

Vector2d bearing_of(const Vector3d& p_W, const Eigen::Isometry3d& X_WC) {
  const Vector3d p_C = X_WC.inverse() * p_W;
  return p_C.head<2>() / p_C.z();
}

/// A database with one point, observed by a camera that moves east.
struct Database {
  std::vector<MappedLandmark> points;
  int64_t next_id = 0;
  std::vector<int64_t> see(const std::vector<Vector2d>& bearings, const CameraPose& pose) {
    return update_as_published(kFilter, bearings, pose, kImageS, points, next_id);
  }
};

CameraPose pose_at(double east_m) { return {looking_at({-40, east_m, -40}, {0, 0, 0}), 0.0, 0.0}; }

TEST(PublishedFilter, StartsAPointOnTheGround) {
  Database database;
  database.see({{0.05, -0.02}}, pose_at(0));
  ASSERT_EQ(database.points.size(), 1U);
  EXPECT_NEAR(database.points[0].landmark.x.z(), 0.0, 1e-9);
}

// The general filter of one landmark, in Joseph form, must give equal results.
TEST(PublishedFilter, CorrectsLikeTheGeneralFilterOfOneLandmark) {
  const Vector3d p_W(3, -2, -1);
  Database database;
  database.see({bearing_of(p_W, pose_at(0).X_WC_est)}, pose_at(0));
  const Landmark before = database.points[0].landmark;
  const Vector2d again = bearing_of(p_W, pose_at(1).X_WC_est);
  const Landmark expected = updated(before, *predict_bearing(before, pose_at(1), kSigma), again);
  database.see({again}, pose_at(1));
  constexpr double kRounding = 1e-9;
  EXPECT_LT((database.points[0].landmark.x - expected.x).norm(), kRounding);
  EXPECT_LT((database.points[0].landmark.P - expected.P).norm(), kRounding * before.P.norm());
  EXPECT_EQ(database.points[0].matches, 2);
}

TEST(PublishedFilter, FindsAPointAboveTheGroundFromExactPoses) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.5 * kSigma);
  const Vector3d p_W(2, 1, -8);
  Database database;
  for (int i = 0; i < 300; ++i) {
    const CameraPose pose = pose_at(0.1 * i);
    const double right = noise(random);
    database.see({bearing_of(p_W, pose.X_WC_est) + Vector2d(right, noise(random))}, pose);
  }
  ASSERT_EQ(database.points.size(), 1U);
  EXPECT_LT((database.points[0].landmark.x - p_W).norm(), 0.3);
}

TEST(PublishedFilter, RecognizesACornerSeenAgain) {
  Database database;
  const auto first = database.see({{-0.1, 0.0}, {0.1, 0.05}}, pose_at(0));
  const auto again = database.see({{0.1, 0.05}, {-0.1, 0.0}}, pose_at(0));
  EXPECT_EQ(again, (std::vector<int64_t>{first[1], first[0]}));
}

// The thesis counts images without a correspondence, even if the point is out of view.
TEST(PublishedFilter, DeletesAPointAfterItsMissesEvenOutOfView) {
  Database database;
  database.see({{0.0, 0.0}}, pose_at(0));
  const CameraPose away{looking_at({-40, 0, -40}, {-80, 0, 0}), 0.0, 0.0};
  for (int i = 1; i < kFilter.misses; ++i) {
    database.see({}, away);
    EXPECT_EQ(database.points.size(), 1U) << i;
  }
  database.see({}, away);
  EXPECT_TRUE(database.points.empty());
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
