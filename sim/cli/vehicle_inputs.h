#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/vehicle.h"
#include "sim/pages/response_data.h"

/// The controls of vehicles, as the commands `step` and `identify` name them.
namespace hedgehop::sim::cli {

/// One control of a vehicle.
struct VehicleInput {
  std::string name;                       ///< "longitudinal"
  Eigen::Index axis = 0;                  ///< in Controls
  std::string unit;                       ///< "deg", "N" or "N m"
  double scale = 1.0;                     ///< from the unit of the linear model to `unit`
  std::string trim;                       ///< name of its Quantity in the trim
  std::vector<Eigen::Index> main_states;  ///< that it commands, as in linear_system()
};

/// Returns a control by its name. Throws InputError with the names of the vehicle's controls.
VehicleInput vehicle_input(const dynamics::VehicleConfig& vehicle, const std::string& name);

/// Returns "1deg", "0.02 rad", "0.5N" or "0.1 Nm" in the unit of the linear model. Throws InputError on another text or
/// unit. @param option  its name, for the message.
double input_size(const VehicleInput& input, const std::string& option, const std::string& text);

/// Throws InputError if the trim at this airspeed does not exist or is beyond a limit, or if the control at its trim
/// plus or minus `size` is beyond its stops.
void require_within_stops(const dynamics::VehicleConfig& vehicle, const VehicleInput& input, double size,
                          double speed_mps);

}  // namespace hedgehop::sim::cli
