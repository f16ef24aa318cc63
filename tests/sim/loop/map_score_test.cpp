#include "sim/loop/map_score.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;

std::map<std::string, double> values(const MapScore& score) {
  std::map<std::string, double> found;
  for (const MetricValue& metric : score.metrics()) found[metric.name] = metric.value;
  return found;
}

// Two corners 100 m away; the map is 3 m off in one of three coordinates at the first: 1 %, and lacks the second.
TEST(MapScore, MeansOverCoordinatesAndCorners) {
  MapScore score({{100, 0, 0}, {0, 100, 0}}, Vector3d::Zero());
  score.add(1.0, std::vector<Vector3d>{{103, 0, 0}});
  const auto found = values(score);
  const double missing = 100.0 * (103.0 + 100.0) / 3.0 / 100.0;
  EXPECT_NEAR(found.at("map_error_percent"), 0.5 * (1.0 + missing), 1e-9);
  EXPECT_EQ(found.at("corners_found"), 0.5);
  EXPECT_EQ(found.at("false_landmarks"), 0.0);
  EXPECT_TRUE(std::isnan(found.at("converged_s")));
}

TEST(MapScore, ConvergedSinceTheLastTimeItCameWithinThreePercent) {
  MapScore score({{100, 0, 0}}, Vector3d::Zero());
  const auto at = [&](double t_s, double off_m) { score.add(t_s, std::vector<Vector3d>{{100 + off_m, 0, 0}}); };
  at(1, 20);
  at(2, 1);
  at(3, 30);
  at(4, 2);
  at(5, 1);
  EXPECT_EQ(values(score).at("converged_s"), 4.0);
}

TEST(MapScore, PointsNearNoCornerAreFalse) {
  MapScore score({{100, 0, 0}}, Vector3d::Zero());
  score.add(1.0, std::vector<Vector3d>{{101, 0, 0}, {50, 0, 0}, {100, 20, 0}, {100, 0, 1}});
  EXPECT_EQ(values(score).at("false_landmarks"), 2.0);
  EXPECT_EQ(values(score).at("false_share"), 0.5);
}

TEST(MapScore, SaysNothingOfAModuleWithoutAMap) {
  MapScore score({{100, 0, 0}}, Vector3d::Zero());
  score.add(1.0, {});
  EXPECT_TRUE(score.metrics().empty());
}

}  // namespace
}  // namespace hedgehop::sim
