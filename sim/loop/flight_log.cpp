#include "sim/loop/flight_log.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

/// The columns that commands and setpoints of a velocity, a point or an attitude share.
struct CommandColumns {
  std::optional<Eigen::Vector2d> v_WB_W;
  std::optional<double> altitude_m, heading_rad;
};

CommandColumns columns(const DirectCommand&) { return {}; }

template <class... Commands>
CommandColumns columns(const std::variant<Commands...>& command) {
  return std::visit(
      [](const auto& c) {
        CommandColumns out;
        if constexpr (requires { c.v_WB_W; }) out.v_WB_W = c.v_WB_W;
        if constexpr (requires { c.altitude_m; }) out.altitude_m = c.altitude_m;
        if constexpr (requires { c.p_WB; }) out.altitude_m = -c.p_WB.z();
        if constexpr (requires { c.heading_rad; }) out.heading_rad = c.heading_rad;
        return out;
      },
      command);
}

}  // namespace

void FlightLog::set_signals(const std::vector<avoidance::Signal>& signals) {
  for (const avoidance::Signal& signal : signals) flight_.signals.push_back({signal.name, signal.unit});
  flight_.result.closest_obstacle.distance_m = kInfinity;
  flight_.result.closest_ground.distance_m = kInfinity;
  flight_.last_obstacle.distance_m = kInfinity;
}

void FlightLog::add(double t_s, const Eigen::Vector3d& p_WB_true, const Proximity& proximity) {
  last_solid_ = proximity.nearest_solid;
  flight_.last_obstacle = {proximity.obstacle_clearance_m, t_s, "", p_WB_true};
  ClosestApproach& obstacle = flight_.result.closest_obstacle;
  if (proximity.obstacle_clearance_m < obstacle.distance_m) {
    const std::string what = proximity.nearest_solid ? scenes::solid_at(scene_, *proximity.nearest_solid).name : "";
    obstacle = {proximity.obstacle_clearance_m, t_s, what, p_WB_true};
  }
  ClosestApproach& ground = flight_.result.closest_ground;
  if (proximity.ground_clearance_m < ground.distance_m) {
    ground = {proximity.ground_clearance_m, t_s, "ground", p_WB_true};
  }
}

void FlightLog::add(double t_s, const Aircraft& aircraft, const Steering& steering, const Proximity& proximity) {
  const dynamics::RigidBodyState& body = aircraft.body();
  const dynamics::control::NavigationEstimate& navigation = aircraft.navigation();
  hash_.add(body);
  const CommandColumns command = std::visit([](const auto& followed) { return columns(followed); }, steering);
  flight_.trajectory.push_back({.t_s = t_s,
                                .p_WB_true = body.p_WB,
                                .rpy_true = dynamics::to_roll_pitch_heading(body.q_WB),
                                .v_WB_W_true = body.q_WB * body.v_WB_B,
                                .w_WB_B_true = body.w_WB_B,
                                .p_WB_est = navigation.p_WB_est,
                                .rpy_est = dynamics::to_roll_pitch_heading(navigation.q_WB_est),
                                .v_WB_W_est = navigation.q_WB_est * navigation.v_WB_B_est,
                                .v_WB_W_cmd = command.v_WB_W,
                                .altitude_cmd_m = command.altitude_m,
                                .heading_cmd_rad = command.heading_rad,
                                .obstacle_clearance_m = proximity.obstacle_clearance_m,
                                .ground_clearance_m = proximity.ground_clearance_m,
                                .controls = aircraft.vehicle().actuators(),
                                .wind_W = aircraft.wind_W(),
                                .model_valid = aircraft.vehicle().within_validity(),
                                .range_m = aircraft.avionics().range_m()});
}

void FlightLog::add(double t_s, const avoidance::Decision& decision) {
  const CommandColumns command = columns(decision.command);
  flight_.decisions.push_back(
      {t_s, decision.status, command.v_WB_W, command.altitude_m, command.heading_rad, decision.signals});
}

void FlightLog::add_direct_command(double t_s) {
  const std::vector<double> no_signals(flight_.signals.size(), std::nan(""));
  flight_.decisions.push_back({t_s, std::string(kCommanded), {}, {}, {}, no_signals});
}

Flight FlightLog::flight(double flight_time_s) const {
  Flight flight = flight_;
  if (last_solid_) flight.last_obstacle.what = scenes::solid_at(scene_, *last_solid_).name;
  FlightResult& result = flight.result;
  for (size_t i = 1; i < flight.trajectory.size(); ++i) {
    result.path_length_m += (flight.trajectory[i].p_WB_true - flight.trajectory[i - 1].p_WB_true).norm();
  }
  result.flight_time_s = flight_time_s;
  result.mean_speed_mps = flight_time_s > 0.0 ? result.path_length_m / flight_time_s : 0.0;
  result.decisions = static_cast<int64_t>(flight.decisions.size());
  result.trajectory_hash = hash_.hex();
  return flight;
}

void TrajectoryHash::add(const dynamics::RigidBodyState& body) {
  hash_.add({body.p_WB.data(), 3});
  hash_.add({body.q_WB.coeffs().data(), 4});
  hash_.add({body.v_WB_B.data(), 3});
  hash_.add({body.w_WB_B.data(), 3});
}

std::string TrajectoryHash::hex() const { return fmt::format("{:016x}", hash_.value()); }

}  // namespace hedgehop::sim
