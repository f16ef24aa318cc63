#include "vision/landmarks/landmark_bundle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/vision/landmarks/looking_at.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr BundleNoise kImageNoise{
    .bearing = 3e-4, .position_m = 0.3, .attitude_rad = 1e-3, .step_m_rt_s = 0.1, .turn_rad_rt_s = 3.5e-4};

/// A camera on an arc of 42 m radius, 10 images per second, exact sensors, whose body is the camera.
class Arc {
 public:
  /// Adds images. @param seen  the ids and positions of the points of an image, in order of id.
  using Points = std::vector<std::pair<int64_t, Vector3d>>;
  void fly(double duration_s, const std::function<Points(const Vector3d& p_WC)>& seen) {
    for (const double end_s = t_s_ + duration_s; t_s_ < end_s; t_s_ += kImageS) {
      NavigationSample sample{pose(t_s_), (pose(t_s_ + 1e-3).translation() - pose(t_s_ - 1e-3).translation()) / 2e-3,
                              pose(t_s_).linear()};
      std::vector<Vector2d> bearings;
      std::vector<int64_t> ids;
      for (const auto& [id, p_W] : seen(sample.X_WB.translation())) {
        const Vector3d p_C = sample.X_WB.inverse() * p_W;
        bearings.emplace_back(p_C.head<2>() / p_C.z());
        ids.push_back(id);
      }
      bundle_.add(sample, t_s_ > 0.0 ? kImageS : 0.0, bearings, ids);
    }
  }
  std::vector<AdjustedLandmark> adjust(const Points& started) {
    std::vector<MappedLandmark> landmarks;
    for (const auto& [id, p_W] : started) {
      landmarks.push_back({id, {}, 1, 0});
      landmarks.back().landmark.x = p_W;
    }
    return bundle_.adjust(landmarks);
  }
  bool is_due() const { return bundle_.is_due(); }

 private:
  static constexpr double kImageS = 0.1, kRadiusM = 42.0;
  static Isometry3d pose(double t_s) {
    const double angle = std::numbers::pi + 6.28e-3 * t_s;
    return looking_at({kRadiusM * std::cos(angle), kRadiusM * std::sin(angle), -42.0}, {0, 0, -7});
  }

  LandmarkBundle bundle_{Isometry3d::Identity(), kImageNoise, 1.0};
  double t_s_ = 0.0;
};

const Arc::Points kCorners = {
    {0, {5, 5, -10}}, {1, {5, -5, -10}}, {2, {-5, -5, -10}}, {3, {-5, 5, -10}}, {4, {0, 0, 0}}};

/// Returns the point of the edge `from` + s * `along` that a vertical edge at (north, east) hides, seen from above.
Vector3d hidden_end(const Vector3d& p_WC, const Vector2d& vertical_NE, const Vector3d& from, const Vector3d& along) {
  const Vector2d ray = vertical_NE - p_WC.head<2>(), to = from.head<2>() - p_WC.head<2>(), d = along.head<2>();
  const double s = (ray.x() * to.y() - ray.y() * to.x()) / (ray.y() * d.x() - ray.x() * d.y());
  return from + s * along;
}

TEST(LandmarkBundle, CorrectsStartsOfItsLandmarks) {
  constexpr double kConvergedM = 1e-2;  // five steps from starts that are 2.3 m off
  Arc arc;
  EXPECT_FALSE(arc.is_due());
  arc.fly(10.0, [](const Vector3d&) { return kCorners; });
  EXPECT_TRUE(arc.is_due());
  Arc::Points started = kCorners;
  for (auto& [id, p_W] : started) p_W += Vector3d(1.0, -2.0, 0.5);
  const auto adjusted = arc.adjust(started);
  ASSERT_EQ(adjusted.size(), kCorners.size());
  for (size_t i = 0; i < adjusted.size(); ++i) {
    EXPECT_LT((adjusted[i].p_W - kCorners[i].second).norm(), kConvergedM) << i;
    EXPECT_TRUE(adjusted[i].is_point && !adjusted[i].is_duplicate) << i;
  }
}

TEST(LandmarkBundle, RejectsTheApparentCornerOfAnEdgeThatHidesAnother) {
  Arc arc;
  const Vector3d from(15, -10, -10), along(1, 1, 0);
  arc.fly(40.0, [&](const Vector3d& p_WC) {
    Arc::Points seen = kCorners;
    seen.emplace_back(5, hidden_end(p_WC, {-5, 2}, from, along));
    return seen;
  });
  Arc::Points started = kCorners;
  started.emplace_back(5, Vector3d(10, 3, -10));
  const auto adjusted = arc.adjust(started);
  ASSERT_EQ(adjusted.size(), started.size());
  for (const AdjustedLandmark& one : adjusted) EXPECT_EQ(one.is_point, one.id != 5) << one.id;
}

TEST(LandmarkBundle, JoinsACornerThatWasLostAndFoundAgain) {
  Arc arc;
  const auto seen_as = [](int64_t id) {
    return [id](const Vector3d&) {
      Arc::Points seen(kCorners.begin(), kCorners.end() - 1);
      seen.emplace_back(id, kCorners.back().second);
      return seen;
    };
  };
  arc.fly(10.0, seen_as(4));
  arc.fly(10.0, seen_as(9));
  Arc::Points started = kCorners;
  started.emplace_back(9, kCorners.back().second + Vector3d(0.2, 0.2, 0.0));
  const auto adjusted = arc.adjust(started);
  ASSERT_EQ(adjusted.size(), 6U);
  for (const AdjustedLandmark& one : adjusted) EXPECT_EQ(one.is_duplicate, one.id == 9) << one.id;
  EXPECT_EQ(arc.adjust(kCorners).size(), kCorners.size());
}

// 200 s have 400 keyframes, of which every second one is dropped once.
TEST(LandmarkBundle, KeepsLandmarksOfALongFlight) {
  constexpr double kSamplingM = 2e-3;  // the velocity is integrated over 0.1 s
  Arc arc;
  arc.fly(200.0, [](const Vector3d&) { return kCorners; });
  const auto adjusted = arc.adjust(kCorners);
  ASSERT_EQ(adjusted.size(), kCorners.size());
  for (size_t i = 0; i < adjusted.size(); ++i) EXPECT_LT((adjusted[i].p_W - kCorners[i].second).norm(), kSamplingM);
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
