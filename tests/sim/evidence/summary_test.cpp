#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "sim/evidence/batch_record.h"

namespace hedgehop::sim {
namespace {

using testing::HasSubstr;

TEST(Summary, StatesGroupsWithoutFlightsOrObstaclesInWords) {
  FlightRecord failed{.order = {.id = "a/seed1", .group = "a"}, .status = FlightRecord::Status::failed, .cause = "x"};
  FlightRecord alone{.order = {.id = "b/seed1", .group = "b"}, .status = FlightRecord::Status::flown};
  alone.result.emplace();
  alone.result->flight.closest_obstacle.distance_m = std::numeric_limits<double>::infinity();
  alone.result->flight.flight_time_s = 2.4;
  const std::string text = summary_text({.records = {failed, alone}});
  EXPECT_THAT(text, HasSubstr("| 0 | - | - | - |\n"));
  EXPECT_THAT(text, HasSubstr("| 0 | no obstacle | no obstacle | 2 |\n"));
}

TEST(FailureWords, KeepTheCauseOfACheckApartFromTheNextCheck) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  FlightResult& flight = record.result.emplace().flight;
  flight.outcome = Outcome::timeout;
  flight.goal_distance_m = 9.0;
  flight.checks = {{.name = "reached_goal", .passed = false, .value = 9.0, .limit = 3.0, .unit = "m", .must = "<="},
                   {.name = "min_clearance", .passed = false, .value = 0.4, .limit = 0.5, .unit = "m", .must = ">="}};
  flight.checks[0].cause = "distance at the end; minimum 8.0 m at 14.0 s";
  EXPECT_EQ(failure_words(record),
            "timeout; reached_goal 9 m, must be <= 3 m (distance at the end; minimum 8.0 m at 14.0 s); "
            "min_clearance 0.4 m, must be >= 0.5 m");
}

TEST(Summary, TimeoutWithoutAGoalIsCompleted) {
  FlightRecord free{.order = {.id = "a/seed1", .group = "a"}, .status = FlightRecord::Status::flown};
  free.result.emplace().flight.outcome = Outcome::timeout;
  free.result->flight.checks = {{.name = "no_collision", .passed = false}};
  FlightRecord late = free;
  late.order = {.id = "a/seed2", .group = "a"};
  late.result->flight.goal_distance_m = 3.0;
  EXPECT_THAT(
      summary_text({.records = {free, late}}),
      testing::AllOf(HasSubstr("| reached | completed | collided | timeout |"), HasSubstr(" | 0 | 1 | 0 | 1 | 0 | "),
                     HasSubstr("a/seed1: completed"), HasSubstr("a/seed2: timeout")));
}

}  // namespace
}  // namespace hedgehop::sim
