#include "sim/verdict/flight_cause.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "sim/config/whole_file.h"
#include "sim/flight/build.h"
#include "sim/flight/words.h"
#include "sim/scenario/reference_path.h"
#include "sim/verdict/assessment.h"
#include "sim/verdict/path_check.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A flight of 30 s toward a goal 60 m north that stops after 2 m, next to a tree.
struct StuckFlight {
  Scenario scenario;
  Flight flight;

  StuckFlight() {
    scenario.duration_s = 30.0;
    scenario.goal = GoalConfig{.north_m = 60.0, .radius_m = 5.0};
    for (int i = 0; i <= 300; ++i) {
      TrajectoryRow row;
      row.t_s = 0.1 * i;
      row.p_WB_true = row.p_WB_est = {std::min(2.0, 0.05 * i), 0.0, -10.0};
      flight.trajectory.push_back(row);
    }
    for (int i = 0; i < 60; ++i) decide(0.5 * i, i < 10 ? "go" : "look", i < 10 ? 0.5 : 0.0);
    flight.result.outcome = Outcome::timeout;
    flight.result.flight_time_s = 30.0;
    flight.result.goal_distance_m = 58.0;
    flight.last_obstacle = {.distance_m = 3.1, .t_s = 30.0, .what = "tree 8"};
  }

  void decide(double t_s, const char* status, double speed_mps) {
    flight.decisions.push_back({t_s, status, Eigen::Vector2d(speed_mps, 0.0), {}, {}, {}});
  }
  std::string cause() {
    explain(scenario, flight);
    return flight.result.cause;
  }
};

TEST(FlightCause, OfATimeoutNamesStatusCommandWayAndObstacle) {
  StuckFlight f;
  EXPECT_EQ(f.cause(),
            "in its last 25 s the module reported `look` and commanded 0 m/s; the flight covered 2.0 of 60 m; nearest "
            "obstacle at the end: tree 8, 3.1 m");
}

TEST(FlightCause, OfATimeoutHasSharesIfTheStatusAlternates) {
  StuckFlight f;
  f.flight.decisions.clear();
  for (int i = 0; i < 60; ++i) f.decide(0.5 * i, i % 4 == 0 ? "turn" : "look", i % 4 == 0 ? 0.4 : 1.2);
  EXPECT_THAT(f.cause(), StartsWith("in its last 10 s the module reported `look` (75 %), `turn` (25 %) and commanded "
                                    "0.4 to 1.2 m/s; "));
}

TEST(FlightCause, OfATimeoutOverTheGoalNamesTheHeight) {
  StuckFlight f;
  f.scenario.goal = GoalConfig{.north_m = 2.0, .altitude_m = 4.0, .radius_m = 5.0};
  f.flight.result.goal_distance_m = 0.0;
  f.flight.last_obstacle.distance_m = std::numeric_limits<double>::infinity();
  EXPECT_THAT(f.cause(), HasSubstr("covered 2.0 of 2.0 m, 6.0 m too high; no obstacle within 50 m"));
}

TEST(FlightCause, OfATimeoutFarFromTheGoalNamesBothDistances) {
  StuckFlight f;
  f.scenario.goal = GoalConfig{.north_m = -20.0, .radius_m = 5.0};
  EXPECT_THAT(f.cause(), HasSubstr("; the flight ended 22 m from the goal, 20 m at the start; "));
}

/// The way leads over waypoints: 10 m east of the start, then to the goal.
TEST(FlightCause, CoveredWayFollowsTheRoute) {
  StuckFlight f;
  f.scenario.route = {GoalConfig{.north_m = 0.0, .east_m = 10.0, .radius_m = 1.0}};
  f.scenario.goal = GoalConfig{.north_m = 30.0, .east_m = 10.0};
  for (TrajectoryRow& row : f.flight.trajectory) row.p_WB_true = row.p_WB_est = {0.0, row.t_s, -10.0};
  const CoveredWay short_of_it = [&] {
    StuckFlight g = f;
    g.flight.trajectory.resize(81);  // 8 m east
    return covered_way(g.scenario, g.flight);
  }();
  EXPECT_NEAR(short_of_it.whole_m, 40.0, 1e-9);
  EXPECT_NEAR(short_of_it.covered_m, 8.0, 1e-9);
  const CoveredWay past_it = covered_way(f.scenario, f.flight);  // 30 m east: 20 m past the waypoint
  EXPECT_NEAR(past_it.covered_m, 40.0 - std::hypot(30.0, 20.0), 1e-9);
}

TEST(FlightCause, OfAFlightToItsGoalIsTheFirstFailedCheck) {
  StuckFlight f;
  f.flight.result.outcome = Outcome::reached;
  EXPECT_EQ(f.cause(), "");
  f.flight.result.checks = {{.name = "max_speed", .passed = true, .unit = "m/s"},
                            {.name = "min_clearance",
                             .passed = false,
                             .value = 0.62,
                             .limit = 1.0,
                             .unit = "m",
                             .must = ">=",
                             .t_s = 6.4,
                             .cause = "to tree 8"}};
  EXPECT_EQ(f.cause(), "min_clearance 0.62 m at 6.40 s, must be >= 1 m: to tree 8");
}

TEST(FlightCause, KeepsThatOfTheLoop) {
  StuckFlight f;
  f.flight.result.outcome = Outcome::collided;
  f.flight.result.cause = "hit wall at 3.000 s";
  EXPECT_EQ(f.cause(), "hit wall at 3.000 s");
  EXPECT_FALSE(f.flight.result.goal_missed_unchecked);
}

TEST(GoalMissedUnchecked, IsATimeoutBeforeAGoalThatNoCheckRequires) {
  StuckFlight f;
  f.cause();
  EXPECT_TRUE(f.flight.result.goal_missed_unchecked);
  f.scenario.checks = {ReachedGoalCheck{}};
  f.cause();
  EXPECT_FALSE(f.flight.result.goal_missed_unchecked);
  f.scenario.checks.clear();
  f.scenario.goal.reset();
  f.cause();
  EXPECT_FALSE(f.flight.result.goal_missed_unchecked);
}

TEST(CheckCause, OfClearanceNamesTheObstacle) {
  StuckFlight f;
  f.flight.result.closest_obstacle = {.distance_m = 0.6, .t_s = 6.4, .what = "tree 8"};
  f.flight.result.closest_ground = {.distance_m = 9.0, .t_s = 0.0, .what = "ground"};
  f.scenario.checks = {MinClearanceCheck{.at_least_m = 1.0}, ReachedGoalCheck{}};
  const auto checks = evaluate_checks(f.scenario, f.flight, {}, 0.5);
  EXPECT_EQ(check_words(checks[0]), "0.6 m at 6.40 s, must be >= 1 m: to tree 8");
  EXPECT_EQ(check_words(checks[1]), "58 m, must be <= 5 m: distance at the end; minimum 58.0 m at 4.0 s");
}

TEST(CheckWords, DistinguishAValueFromItsLimit) {
  const auto words = [](double value, const char* must) {
    return check_words(
        {.name = "max_speed", .passed = false, .value = value, .limit = 2.038, .unit = "m/s", .must = must});
  };
  EXPECT_EQ(words(2.03804, "<="), "2.03804 m/s, must be <= 2.038 m/s");
  EXPECT_EQ(words(2.0379, ">="), "2.0379 m/s, must be >= 2.038 m/s");
  EXPECT_EQ(words(2.51234, "<="), "2.512 m/s, must be <= 2.038 m/s");
  EXPECT_EQ(words(2.038, "<="), "2.038 m/s, must be <= 2.038 m/s");
  EXPECT_EQ(distinct_decimals(0.04993, 0.05), "0.0499");
  EXPECT_EQ(distinct_decimals(-0.0001, -0.1), "0.000");
}

TEST(CheckCause, OfAPathIsThePlaceAndTimeAtWhichTheFlightLeftIt) {
  const TemporaryFolder folder;
  StuckFlight f;
  ReferencePath reference{.version = std::string(version()),
                          .seed = 3,
                          .points = {{0.0, {0.0, 0.0, -10.0}}, {30.0, {15.0, 0.0, -10.0}}}};  // 0.5 m/s
  write_file_whole(folder.path() / "path.csv", reference_text(reference));
  f.flight.result.outcome = Outcome::reached;
  const PathToleranceCheck check{.reference = folder.path() / "path.csv", .at_most_m = 1.0};
  // At 0.5 m/s like the reference up to 4 s and 2 m; 1 m behind it from 6 s on.
  const CheckResult result = evaluate_path(check, f.flight, 3);
  EXPECT_EQ(check_words(result),
            "13 m at 30.00 s, must be <= 1 m: left the reference at 6.10 s, north 2.0 m, east 0.0 m, altitude 10.0 m");
  EXPECT_THAT(check_words(evaluate_path(check, f.flight, 4)),
              EndsWith(fmt::format("altitude 10.0 m (reference: seed 3, version {})", version())));
  reference.version = "0.1.0";
  write_file_whole(folder.path() / "path.csv", reference_text(reference));
  EXPECT_THAT(check_words(evaluate_path(check, f.flight, 3)),
              EndsWith(fmt::format("(reference: seed 3, version 0.1.0; this is {})", version())));
  f.flight.trajectory.resize(101);
  f.flight.result.outcome = Outcome::timeout;
  EXPECT_THAT(check_words(evaluate_path(check, f.flight, 3)),
              StartsWith("10 s, must be >= 30 s: end of the flight; left"));
}

}  // namespace
}  // namespace hedgehop::sim
