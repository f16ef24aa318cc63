#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/rigid_body.h"
#include "dynamics/vehicle.h"
#include "sim/flightlog/log_columns.h"

namespace hedgehop::sim {

/// A flight as its log has it, in W and B, one entry or row per sample.
struct RecordedFlight {
  std::string file;         ///< as the user named it
  std::vector<double> t_s;  ///< rising
  std::vector<dynamics::RigidBodyState> states;
  bool has_position = false;  ///< otherwise all positions are 0
  LogColumnsConfig::Inputs kind = LogColumnsConfig::Inputs::motor_speeds;
  /// Speed of each rotor, rad/s, commanded or measured; or the Controls; or velocity north, east (m/s), altitude (m),
  /// heading (rad).
  Eigen::MatrixXd inputs;
  /// The log is a trajectory.csv, whose controls are positions, but no column map has the kind of its inputs.
  bool takes_positions_for_commands = false;
  std::vector<Eigen::Vector3d> wind_W;                      ///< m/s
  std::vector<Eigen::Vector3d> specific_force_B;            ///< m/s2, at the mass center; empty if not recorded
  double warm_up_s = 0.0;                                   ///< see LogColumnsConfig
  double torque_share = 1.0;                                ///< see DutySpeedConfig
  Eigen::Vector3d rate_feedback = Eigen::Vector3d::Zero();  ///< see LogColumnsConfig
  std::vector<bool> gap_after;                              ///< the log pauses after this sample

  size_t size() const { return states.size(); }
  /// Median time between samples, s.
  double period_s = 0.0;
};

/// Reads a log of a vehicle from a CSV file with a header line. Required are t_s; an attitude as angles or quaternion;
/// a velocity in W or in B; the rates; and the columns of one kind of input. Throws InputError with file and line for
/// missing columns, fields that are no numbers, and times that do not rise.
RecordedFlight read_recorded_flight(const std::filesystem::path& file, const LogColumnsConfig& columns,
                                    const dynamics::VehicleConfig& vehicle);

}  // namespace hedgehop::sim
