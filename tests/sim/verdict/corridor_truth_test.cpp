#include "sim/verdict/corridor_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hedgehop::sim {
namespace {

scenes::worlds::CorridorConfig straight_corridor() {
  scenes::worlds::CorridorConfig corridor;
  corridor.width_m = 4.0;
  corridor.sections = {{30.0}};
  return corridor;
}

double metric(const std::vector<MetricValue>& metrics, const std::string& name) {
  for (const MetricValue& value : metrics) {
    if (value.name == name) return value.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(CorridorPlace, MeasuresToBothWallsOfAStraightCorridor) {
  const CorridorPlace place = corridor_place(scenes::worlds::plan_corridor(straight_corridor(), 1), {7.0, -1.5});
  EXPECT_NEAR(place.left_m, 0.5, 1e-12);
  EXPECT_NEAR(place.right_m, 3.5, 1e-12);
  EXPECT_NEAR(place.along_m, 7.0, 1e-12);
}

TEST(CorridorPlace, FollowsABendAndATaper) {
  scenes::worlds::CorridorConfig corridor = straight_corridor();
  const double bend_rad = std::numbers::pi / 6.0;
  corridor.sections = {{10.0}, {.length_m = 10.0, .bend_rad = bend_rad}, {.length_m = 10.0, .width_m = 2.0}};
  const scenes::worlds::CorridorPlan plan = scenes::worlds::plan_corridor(corridor, 1);
  const Eigen::Vector2d along(std::cos(bend_rad), std::sin(bend_rad)), right(-along.y(), along.x());
  const CorridorPlace bent = corridor_place(plan, Eigen::Vector2d(10, 0) + 6.0 * along + 0.7 * right);
  EXPECT_NEAR(bent.left_m, 2.7, 1e-12);
  EXPECT_NEAR(bent.right_m, 1.3, 1e-12);
  EXPECT_NEAR(bent.along_m, 16.0, 1e-12);
  // The middle of a taper from 4 m to 2 m is 3 m wide.
  const CorridorPlace tapered = corridor_place(plan, Eigen::Vector2d(10, 0) + 15.0 * along - 0.2 * right);
  EXPECT_NEAR(tapered.left_m + tapered.right_m, 3.0, 1e-12);
  EXPECT_NEAR(tapered.left_m, 1.3, 1e-12);
}

// North at 1 m/s at 0.4 m east. The module's signal has a known error.
struct OffsetFlight {
  Scenario scenario;
  Flight flight;

  OffsetFlight() {
    scenario.scene = straight_corridor();
    flight.signals = {{"other", ""}, {"centering_error", ""}};
    for (int i = 0; i <= 200; ++i) {
      TrajectoryRow row;
      row.t_s = 0.1 * i;
      row.p_WB_true = {2.0 + 0.1 * i, i < 100 ? 1.4 : 0.4, -1.5};
      flight.trajectory.push_back(row);
    }
    const double claimed[] = {-0.7 + 0.02, -0.7 - 0.06, std::numeric_limits<double>::quiet_NaN(), -0.2 + 0.3};
    const double at_s[] = {1.0, 2.0, 3.0, 15.0};
    for (int i = 0; i < 4; ++i) {
      DecisionRow row;
      row.t_s = at_s[i];
      row.signals = {5.0, claimed[i]};
      flight.decisions.push_back(row);
    }
  }
};

TEST(CorridorMetrics, DeviationsAreSharesOfTheCorridorsWidth) {
  const OffsetFlight f;
  const auto metrics = corridor_metrics(f.scenario, f.flight);
  EXPECT_NEAR(metric(metrics, "centering_error_mean"), (0.01 + 0.03 + 0.15) / 3.0, 1e-12);
  EXPECT_NEAR(metric(metrics, "centering_error_median"), 0.03, 1e-12);
  EXPECT_NEAR(metric(metrics, "centering_error_max"), 0.15, 1e-12);
  EXPECT_DOUBLE_EQ(metric(metrics, "centering_known_share"), 0.75);
}

TEST(CorridorMetrics, DistanceFromTheCenterLineIsThatOfTheVehicle) {
  const OffsetFlight f;
  const auto metrics = corridor_metrics(f.scenario, f.flight);
  EXPECT_NEAR(metric(metrics, "off_middle_max_m"), 1.4, 1e-12);
  EXPECT_NEAR(metric(metrics, "off_middle_after_15m_m"), 0.4, 1e-12);
}

TEST(CorridorMetrics, OtherScenesHaveNone) {
  OffsetFlight f;
  f.scenario.scene = scenes::worlds::RoomConfig{};
  EXPECT_TRUE(corridor_metrics(f.scenario, f.flight).empty());
  f.scenario.scene = straight_corridor();
  f.flight.signals[1].name = "another";
  EXPECT_TRUE(std::isnan(metric(corridor_metrics(f.scenario, f.flight), "centering_error_mean")));
}

}  // namespace
}  // namespace hedgehop::sim
