#include "avoidance/go_to_goal.h"

#include <algorithm>
#include <limits>

#include "sim/fields/bounds.h"

namespace hedgehop::avoidance {
namespace {

class GoToGoal final : public Module {
 public:
  explicit GoToGoal(const GoToGoalConfig& config) : config_(config) { fields::require_bounds(config); }

 private:
  Needs do_needs() const override { return {.cameras = {}, .commands = {CommandType::velocity}}; }
  std::vector<Signal> do_signals() const override { return {{"goal_distance_m", "m"}}; }
  void do_reset(const Setup&) override { least_distance_m_ = std::numeric_limits<double>::infinity(); }

  Decision do_update(const Observation& observation) override {
    const Eigen::Vector2d p_BG_W = (observation.goal.p_WG - observation.navigation.p_WB_est).head<2>();
    least_distance_m_ = std::min(least_distance_m_, p_BG_W.norm());
    VelocityCommand command;
    command.v_WB_W = velocity_to_goal(p_BG_W, config_.speed_mps, config_.slow_radius_m);
    command.altitude_m = -observation.goal.p_WG.z();
    command.heading_rad = observation.goal.heading_rad;
    return {command, "cruise", {p_BG_W.norm()}};
  }

  std::vector<Metric> do_metrics() const override { return {{"least_goal_distance", least_distance_m_, "m"}}; }

  GoToGoalConfig config_;
  double least_distance_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Eigen::Vector2d velocity_to_goal(const Eigen::Vector2d& p_BG_W_xy, double speed_mps, double slow_radius_m) {
  const double distance_m = p_BG_W_xy.norm();
  if (distance_m <= 0.0) return Eigen::Vector2d::Zero();
  const double share = distance_m < slow_radius_m ? distance_m / slow_radius_m : 1.0;
  return p_BG_W_xy * (speed_mps * share / distance_m);
}

std::unique_ptr<Module> make_go_to_goal(const GoToGoalConfig& config) { return std::make_unique<GoToGoal>(config); }

}  // namespace hedgehop::avoidance
