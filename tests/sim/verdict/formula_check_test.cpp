#include "sim/verdict/formula_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/verdict/assessment.h"

namespace hedgehop::sim {
namespace {

/// Ten seconds north at 2 m/s, one row per 0.1 s; the minimum distance of an obstacle is 1 m at 4.03 s, between two
/// rows.
struct PassingFlight {
  Scenario scenario;
  Flight flight;

  PassingFlight() {
    scenario.control_rate_hz = 10;
    scenario.goal = GoalConfig{.north_m = 25.0};
    for (int i = 0; i <= 100; ++i) {
      TrajectoryRow row;
      row.t_s = 0.1 * i;
      row.p_WB_true = {0.2 * i, 0.0, -10.0};
      row.p_WB_est = row.p_WB_true + Eigen::Vector3d(0.0, 0.3, 0.4);
      row.rpy_true = {0.0, -0.1, 0.0};
      row.v_WB_W_true = {2.0, 0.0, 0.0};
      row.v_WB_W_cmd = Eigen::Vector2d(2.0, 0.5);
      row.obstacle_clearance_m =
          std::abs(row.t_s - 4.03) < 2.0 ? 1.0 + std::abs(row.t_s - 4.03) : std::numeric_limits<double>::infinity();
      row.ground_clearance_m = 9.5;
      flight.trajectory.push_back(row);
    }
    for (const auto& [t_s, status] : {std::pair{0.05, "cruise"}, {3.0, "avoid"}, {6.0, "cruise"}}) {
      DecisionRow decision;
      decision.t_s = t_s;
      decision.status = status;
      flight.decisions.push_back(decision);
    }
    flight.result.closest_obstacle = {.distance_m = 1.0, .t_s = 4.03, .what = "tree"};
    flight.result.closest_ground = {.distance_m = 9.5, .t_s = 0.0, .what = "ground"};
  }
  CheckResult check(const std::string& formula) const {
    return evaluate_formula({.name = "f", .formula = formula}, scenario, flight);
  }
};

TEST(FormulaCheck, AgreesWithMinClearanceIfTheClosestApproachIsBetweenRows) {
  PassingFlight f;
  f.scenario.checks = {MinClearanceCheck{.at_least_m = 1.25}};
  const CheckResult known = evaluate_checks(f.scenario, f.flight, {}, 0.5).front();
  const CheckResult result = f.check("always (obstacle_clearance >= 1.25)");
  EXPECT_FALSE(result.passed);
  EXPECT_DOUBLE_EQ(result.value, known.value - known.limit);
  EXPECT_DOUBLE_EQ(result.limit, 0.0);
  EXPECT_NEAR(*result.t_s, 4.0, 1e-9);
  EXPECT_NEAR(*known.t_s, 4.03, 1e-9);
}

TEST(FormulaCheck, SignalsAreThoseOfTheFlight) {
  const PassingFlight f;
  constexpr double kRound = 1e-9;
  EXPECT_NEAR(f.check("always (goal_distance >= 4)").value, 1.0, kRound);  // 5 m remain
  EXPECT_NEAR(f.check("always (tilt <= 10)").value, 10.0 - 0.1 * 180.0 / 3.14159265358979, 1e-6);
  EXPECT_NEAR(f.check("always (tracking_error <= 1)").value, 0.5, kRound);
  EXPECT_NEAR(f.check("always (estimation_error <= 1)").value, 0.5, kRound);
  EXPECT_NEAR(f.check("always (clearance <= 10)").value, 0.5, kRound);  // the ground is never farther away
  EXPECT_NEAR(f.check("eventually (obstacle_clearance >= 50)").value, 0.0, kRound);
  EXPECT_NEAR(f.check("always[3,5.9] (status == avoid -> speed <= 3)").value, 1.0, kRound);
  EXPECT_FALSE(f.check("always[3,6] (status == avoid)").passed);
  EXPECT_TRUE(f.check("always[3,5.9] (status == avoid)").passed);
}

TEST(FormulaCheck, ProvidesEverySignalOfFormulas) {
  const PassingFlight f;
  const SampledSignals signals = flight_signals(f.scenario, f.flight);
  for (const FormulaSignal& signal : formula_signals()) {
    ASSERT_TRUE(signals.numbers.contains(signal.name)) << signal.name;
    EXPECT_EQ(signals.numbers.find(signal.name)->second.size(), signals.samples) << signal.name;
  }
  EXPECT_EQ(signals.numbers.size(), formula_signals().size());
  EXPECT_EQ(signals.status.size(), signals.samples);
}

TEST(FormulaCheck, TrackingErrorWithoutACommandedVelocityFailsEveryFormula) {
  PassingFlight f;
  for (TrajectoryRow& row : f.flight.trajectory) row.v_WB_W_cmd.reset();
  for (const char* formula :
       {"always (tracking_error < 1)", "eventually (tracking_error < 1)", "not eventually (tracking_error > 1)",
        "not (tracking_error < 1)", "not (tracking_error > 1)", "tracking_error > 1 -> tracking_error < 9",
        "(speed < 9) until (tracking_error < 1)", "(tracking_error < 1) until[1,2] (speed < 9)",
        "min(speed, tracking_error) < 9", "max(tracking_error, speed) > 0", "abs(tracking_error) >= 0"}) {
    const CheckResult result = f.check(formula);
    EXPECT_FALSE(result.passed) << formula;
    EXPECT_EQ(result.cause, "no velocity was commanded") << formula;
  }
  EXPECT_TRUE(f.check("always (speed < 9 or tracking_error < 1)").passed);
  EXPECT_EQ(f.check("always (status == nosuch) and always (tracking_error < 1 or speed < 90)").cause, "")
      << "no velocity could make it hold";
}

TEST(FormulaCheck, FlightWithoutARowFails) {
  PassingFlight f;
  f.flight.trajectory.clear();
  EXPECT_FALSE(f.check("always (speed < 1)").passed);
}

}  // namespace
}  // namespace hedgehop::sim
