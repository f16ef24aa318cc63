#pragma once

#include "sim/verdict/assessment.h"

namespace hedgehop::sim {

/// A straight flight north at 2 m/s and 10 m altitude, 0 to 20 s, that ends 1 m from its goal.
struct StraightFlight {
  Scenario scenario;
  Flight flight;
  scenes::Scene scene;

  StraightFlight() {
    scenario.duration_s = 100.0;
    scenario.goal = GoalConfig{.north_m = 41.0, .radius_m = 2.0};
    for (int i = 0; i <= 200; ++i) {
      TrajectoryRow row;
      row.t_s = 0.1 * i;
      row.p_WB_true = {0.2 * i, 0.0, -10.0};
      row.rpy_true = {0.0, -0.1, 0.0};
      row.v_WB_W_true = {2.0, 0.0, 0.0};
      row.w_WB_B_true.setZero();
      flight.trajectory.push_back(row);
    }
    flight.result.outcome = Outcome::reached;
    flight.result.flight_time_s = 20.0;
    flight.result.goal_distance_m = 1.0;
    flight.result.closest_obstacle.distance_m = 1.5;
    flight.result.closest_ground.distance_m = 9.0;
    flight.result.metrics = {{"reversals", 3.0, ""}};
    scene.bounds_NE_m = {Eigen::Vector2d(0.0, -5.0), Eigen::Vector2d(40.0, 5.0)};
  }

  CheckResult evaluate(const CheckConfig& check) {
    scenario.checks = {check};
    return evaluate_checks(scenario, flight, scene, 0.8).front();
  }
};

}  // namespace hedgehop::sim
