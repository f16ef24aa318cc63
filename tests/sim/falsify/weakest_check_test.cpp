#include "sim/falsify/weakest_check.h"

#include <gtest/gtest.h>

#include <limits>

namespace hedgehop::sim {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

CheckResult check(const char* name, bool passed, double value, double limit, const char* unit, const char* must) {
  return {name, passed, value, limit, unit, must, 3.5};
}

FlightRecord flown(const std::vector<CheckResult>& checks) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  FlightResult& result = record.result.emplace().flight;
  result.outcome = Outcome::timeout;
  result.flight_time_s = 9.0;
  result.checks = checks;
  return record;
}

TEST(WeakestCheck, ScalesMarginsToMakeChecksComparable) {
  EXPECT_DOUBLE_EQ(check_robustness(check("min_clearance", true, 2.5, 1.0, "m", ">=")), 1.5);
  EXPECT_DOUBLE_EQ(check_robustness(check("max_speed", false, 7.0, 5.0, "m/s", "<=")), -2.0);
  EXPECT_DOUBLE_EQ(check_robustness(check("reached_goal", false, 45.0, 40.0, "s", "<=")), -0.5);
  EXPECT_NEAR(check_robustness(check("max_tilt", true, 20.0, 31.4591559, "deg", "<=")), 2.0, 1e-6);
}

/// The verdict alone decides the sign: for a value at its limit, for a missing value, and if another key failed.
TEST(WeakestCheck, IsNegativeIfAndOnlyIfTheCheckFails) {
  EXPECT_LT(check_robustness(check("no_collision", false, 0.0, 0.0, "m", ">")), 0.0);
  EXPECT_LT(check_robustness(check("reached_goal", false, 1.0, 2.0, "m", "<=")), 0.0);
  EXPECT_LT(check_robustness(check("metric", false, kUnknown, 2.0, "", "<=")), 0.0);
  EXPECT_GE(check_robustness(check("no_collision", true, kUnknown, 0.0, "m", ">")), 10.0);
}

TEST(WeakestCheck, HasTheMinimumRobustnessOfTheSelectedChecks) {
  const FlightRecord record = flown({check("a", true, 3.0, 1.0, "m", ">="), check("b", true, 1.5, 1.0, "m", ">="),
                                     check("c", false, 0.0, 1.0, "m", ">=")});
  EXPECT_EQ(weakest_check(record, {})->name, "c");
  EXPECT_EQ(weakest_check(record, {"a", "b"})->name, "b");
  EXPECT_DOUBLE_EQ(weakest_check(record, {"a", "b"})->robustness, 0.5);
  EXPECT_EQ(decided_s(record, "b"), 3.5);
}

TEST(WeakestCheck, AFlightThatWasNotFlownNeitherPassesNorFails) {
  FlightRecord record{.status = FlightRecord::Status::failed, .cause = "killed by SIGSEGV (Segmentation fault)"};
  EXPECT_FALSE(weakest_check(record, {}));
  record.cause = "exit status 2: 'start': the vehicle collides at the start";
  EXPECT_FALSE(weakest_check(record, {}));
}

TEST(WeakestCheck, AFaultOfTheModuleFails) {
  FlightRecord record = flown({check("a", true, 3.0, 1.0, "m", ">=")});
  record.result->flight.outcome = Outcome::fault;
  EXPECT_EQ(weakest_check(record, {})->name, "flight");
  EXPECT_LT(weakest_check(record, {})->robustness, 0.0);
}

}  // namespace
}  // namespace hedgehop::sim
