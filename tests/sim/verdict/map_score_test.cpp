#include "sim/verdict/map_score.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;

std::map<std::string, double> values(const MapScore& score) {
  std::map<std::string, double> found;
  for (const MetricValue& metric : score.metrics()) found[metric.name] = metric.value;
  return found;
}

// Two corners 100 m away, long in sight; the map is 3 m off in one of three coordinates at the first: 1 %, and lacks
// the second.
TEST(MapScore, MeansOverCoordinatesAndCorners) {
  MapScore score({{100, 0, 0}, {0, 100, 0}}, Vector3d::Zero());
  score.add(20.0, std::vector<Vector3d>{{103, 0, 0}}, {true, true});
  const auto found = values(score);
  const double missing = 100.0 * (103.0 + 100.0) / 3.0 / 100.0;
  EXPECT_NEAR(found.at("map_error_percent"), 0.5 * (1.0 + missing), 1e-9);
  EXPECT_EQ(found.at("corners_found"), 0.5);
  EXPECT_EQ(found.at("false_landmarks"), 0.0);
  EXPECT_TRUE(std::isnan(found.at("converged_s")));
}

TEST(MapScore, ConvergedSinceTheLastTimeItCameWithinThreePercent) {
  MapScore score({{100, 0, 0}}, Vector3d::Zero());
  const auto at = [&](double t_s, double off_m) { score.add(t_s, std::vector<Vector3d>{{100 + off_m, 0, 0}}, {true}); };
  at(11, 20);
  at(12, 1);
  at(13, 30);
  at(14, 2);
  at(15, 1);
  EXPECT_EQ(values(score).at("converged_s"), 14.0);
}

TEST(MapScore, ACornerCountsOnceItWasInSightForTenSeconds) {
  MapScore score({{100, 0, 0}, {0, 100, 0}}, Vector3d::Zero());
  const auto at = [&](double t_s, bool second) { score.add(t_s, std::vector<Vector3d>{{100, 0, 0}}, {true, second}); };
  at(8, true);
  at(16, false);
  EXPECT_EQ(values(score).at("corners_seen"), 1.0);
  EXPECT_EQ(values(score).at("corners_found"), 1.0);
  at(19, true);
  EXPECT_EQ(values(score).at("corners_seen"), 2.0);
  EXPECT_EQ(values(score).at("corners_found"), 0.5);
}

TEST(MapScore, PointsNearNoCornerAreFalse) {
  MapScore score({{100, 0, -50}}, Vector3d::Zero());
  score.add(1.0, std::vector<Vector3d>{{101, 0, -50}, {50, 0, 1}, {100, 20, -30}, {100, 0, -49}}, {false});
  EXPECT_EQ(values(score).at("false_landmarks"), 2.0);
  EXPECT_EQ(values(score).at("false_on_ground"), 1.0);
  EXPECT_EQ(values(score).at("false_share"), 0.5);
}

TEST(MapScore, MarksWhichPointsAndCornersBelongTogether) {
  MapScore score({{100, 0, 0}, {0, 100, 0}, {-100, 0, 0}}, Vector3d::Zero());
  const std::vector<Vector3d> points_W{{50, 50, 0}, {-101, 0, 0}, {101, 0, 0}};
  MapRecord map;
  for (const Vector3d& p_W : points_W) map.points.push_back({p_W, Eigen::Matrix3d::Identity(), {}});
  score.add(20.0, points_W, {true, true, false});
  score.complete(map);
  EXPECT_EQ(map.points[0].is_true, std::optional(false));
  EXPECT_EQ(map.points[1].is_true, std::optional(true));
  EXPECT_EQ(map.points[2].is_true, std::optional(true));
  const std::vector<RecordedCorner>& corners = map.corners;
  ASSERT_EQ(corners.size(), 3U);
  const bool counts[] = {true, true, false}, found[] = {true, false, true};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(corners[i].counts, counts[i]) << i;
    EXPECT_EQ(corners[i].found, found[i]) << i;
  }
}

TEST(MapScore, SaysNothingOfAModuleWithoutAMap) {
  MapScore score({{100, 0, 0}}, Vector3d::Zero());
  score.add(1.0, {}, {true});
  EXPECT_TRUE(score.metrics().empty());
}

TEST(MapScore, LeavesTheRecordOfAModuleWithoutAMapEmpty) {
  MapScore score({{100, 0, 0}}, Vector3d::Zero());
  score.add(20.0, {}, {true});
  MapRecord map;
  score.complete(map);
  EXPECT_TRUE(map.corners.empty());
}

}  // namespace
}  // namespace hedgehop::sim
