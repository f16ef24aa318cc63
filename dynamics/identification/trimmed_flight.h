#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "dynamics/actuators.h"
#include "dynamics/steady_flight.h"
#include "dynamics/vehicle.h"

/// Flights of the full model from a trim, for comparison with its linear model.
namespace hedgehop::dynamics::identification {

/// Samples of a flight, one row each, as deviations from the trim. The columns are the inputs and states of
/// linear_system(). The inputs of a helicopter are the blade angles that its servos reach.
struct Record {
  double step_s = 0.0;     ///< between samples
  Eigen::MatrixXd inputs;  ///< samples x inputs
  Eigen::MatrixXd states;  ///< samples x states
};

struct TestFlight {
  Eigen::Vector3d v_air_W = Eigen::Vector3d::Zero();  ///< velocity of the trim relative to the air, m/s
  std::function<Controls(double t_s)> input;          ///< deviation of the command from the trim
  double duration_s = 0.0;
  Eigen::MatrixXd gain;  ///< inputs x states: the command gains -gain * x; empty for no feedback
  int steps_per_sample = 1;
};

/// Step of the integration, s.
inline constexpr double kTestStepS = 0.002;

/// Returns the record of a flight in still air; nullopt if there is no trim. Throws std::invalid_argument if the
/// vehicle is invalid.
std::optional<Record> fly_test(const VehicleConfig& vehicle, const TestFlight& test);

/// Returns the states of the linear model for the inputs of a record, which are linear between the samples.
Eigen::MatrixXd linear_states(const control::LinearSystem& linear, const Record& record);

/// Returns gains that keep a vehicle near its trim, weak enough for its own modes to remain visible.
/// @param acceptable  deviations of the controls, as HoverModel::acceptable.
Eigen::MatrixXd holding_gain(const NamedLinearSystem& linear, const Controls& acceptable);

}  // namespace hedgehop::dynamics::identification
