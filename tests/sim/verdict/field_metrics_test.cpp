#include "sim/verdict/field_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hedgehop::sim {
namespace {

std::optional<double> value(const std::vector<MetricValue>& metrics, std::string_view name) {
  for (const MetricValue& metric : metrics) {
    if (metric.name == name) return metric.value;
  }
  return {};
}

/// Flight north by a given law of motion for 10 s towards a goal of 2 m radius at 52 m, in an empty scene.
template <class Law>
Flight flight_north(Law north_m, Outcome outcome) {
  Flight flight;
  constexpr double kStepS = 0.01, kDifferenceS = 1e-4;
  for (int i = 0; i <= 1000; ++i) {
    TrajectoryRow row;
    row.t_s = kStepS * i;
    row.p_WB_true = {north_m(row.t_s), 0.0, -10.0};
    row.v_WB_W_true = {(north_m(row.t_s + kDifferenceS) - north_m(row.t_s - kDifferenceS)) / (2.0 * kDifferenceS), 0.0,
                       0.0};
    flight.trajectory.push_back(row);
  }
  flight.result.outcome = outcome;
  flight.result.flight_time_s = 10.0;
  flight.result.goal_distance_m = std::abs(52.0 - north_m(10.0));
  flight.result.path_length_m = north_m(10.0);
  return flight;
}

Scenario with_goal() {
  Scenario scenario;
  scenario.goal = GoalConfig{.north_m = 52.0, .east_m = 0.0, .altitude_m = 10.0, .radius_m = 2.0};
  return scenario;
}

scenes::Scene empty_scene() {
  scenes::Scene scene;
  scene.bounds_NE_m = {Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(60.0, 10.0)};
  return scene;
}

TEST(FieldMetrics, AreValidNamesForChecks) {
  const Flight flight = flight_north([](double t_s) { return 5.0 * t_s; }, Outcome::reached);
  const auto metrics = field_metrics(with_goal(), flight, empty_scene(), 0.8);
  EXPECT_EQ(metrics.size(), 9u);
  for (const MetricValue& metric : metrics) {
    EXPECT_NE(std::ranges::find(kJudgesMetrics, metric.name), kJudgesMetrics.end()) << metric.name;
  }
}

TEST(FieldMetrics, HalfTheDistanceIsHalfTheMission) {
  const Flight flight = flight_north([](double t_s) { return 2.5 * t_s; }, Outcome::timeout);
  const auto metrics = field_metrics(with_goal(), flight, empty_scene(), 0.8);
  EXPECT_EQ(value(metrics, "success"), 0.0);
  EXPECT_NEAR(*value(metrics, "mission_progress"), 0.5, 1e-12);
  EXPECT_NEAR(*value(metrics, "goal_velocity"), 2.5, 1e-12);
  EXPECT_FALSE(value(metrics, "path_excess"));
}

TEST(FieldMetrics, CenterAndHullAreCountedApartIfTheCenterCollides) {
  Scenario scenario = with_goal();
  const auto counts = [&scenario](Outcome outcome, double clearance_m) {
    Flight flight = flight_north([](double t_s) { return 5.0 * t_s; }, outcome);
    flight.result.closest_obstacle.distance_m = clearance_m;
    flight.result.closest_ground.distance_m = 9.0;
    const auto metrics = field_metrics(scenario, flight, empty_scene(), 0.8);
    return std::pair(value(metrics, "center_collision"), value(metrics, "hull_collision"));
  };
  EXPECT_EQ(counts(Outcome::reached, 1.0), std::pair(std::optional<double>(), std::optional<double>()));
  scenario.collision_of = CollisionOf::center;
  EXPECT_EQ(counts(Outcome::reached, 1.0), std::pair(std::optional(0.0), std::optional(0.0)));
  EXPECT_EQ(counts(Outcome::reached, -0.2), std::pair(std::optional(0.0), std::optional(1.0)));
  EXPECT_EQ(counts(Outcome::collided, -0.8), std::pair(std::optional(1.0), std::optional(1.0)));
}

TEST(FieldMetrics, StraightFlightToTheGoalHasNoExcess) {
  const Flight flight = flight_north([](double t_s) { return 5.0 * t_s; }, Outcome::reached);
  const auto metrics = field_metrics(with_goal(), flight, empty_scene(), 0.8);
  EXPECT_EQ(value(metrics, "success"), 1.0);
  EXPECT_NEAR(*value(metrics, "shortest_path"), 50.0, 0.25);  // one cell of the grid
  EXPECT_NEAR(*value(metrics, "path_excess"), 0.0, 0.01);
}

TEST(FieldMetrics, OffCourseIsTheDistanceOfTheEndFromThePlannedCourse) {
  const auto off_course_m = [](const Scenario& scenario, double east_m) {
    Flight flight = flight_north([](double t_s) { return 2.5 * t_s; }, Outcome::timeout);
    flight.trajectory.back().p_WB_true.y() = east_m;
    flight.trajectory.back().p_WB_est = Eigen::Vector3d::Zero();  // the estimate is not used
    return *value(field_metrics(scenario, flight, empty_scene(), 0.8), "off_course_at_end_m");
  };
  EXPECT_NEAR(off_course_m(with_goal(), 0.0), 0.0, 1e-12);
  EXPECT_NEAR(off_course_m(with_goal(), -7.0), 7.0, 1e-12);
  Scenario askew = with_goal();
  askew.goal->east_m = 52.0;  // the end is at 25 m north: 25 sin(45 deg) off course
  EXPECT_NEAR(off_course_m(askew, 0.0), 25.0 / std::sqrt(2.0), 1e-9);
  askew.route = {GoalConfig{.north_m = 52.0}};  // north first, then east
  EXPECT_NEAR(off_course_m(askew, 0.0), 0.0, 1e-12);
  Scenario passed = with_goal();
  passed.goal->north_m = 21.0;  // 4 m beyond the goal and 3 m to the side
  EXPECT_NEAR(off_course_m(passed, 3.0), 5.0, 1e-12);
}

/// x = A sin(wt): the jerk is A w^3 cos(wt), its root mean square over whole periods A w^3 / sqrt(2).
TEST(FieldMetrics, JerkOfASwingFollowsItsThirdDerivative) {
  const double amplitude_m = 3.0, w = 2.0 * std::acos(-1.0) / 2.5;
  const Flight flight = flight_north([&](double t_s) { return amplitude_m * std::sin(w * t_s); }, Outcome::timeout);
  const auto metrics = field_metrics(with_goal(), flight, empty_scene(), 0.8);
  EXPECT_NEAR(*value(metrics, "jerk_rms") / (amplitude_m * w * w * w / std::sqrt(2.0)), 1.0, 0.005);
}

}  // namespace
}  // namespace hedgehop::sim
