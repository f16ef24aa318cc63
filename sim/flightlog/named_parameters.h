#pragma once

#include <string>
#include <vector>

#include "dynamics/vehicle.h"
#include "sim/flightlog/log_columns.h"

namespace hedgehop::sim {

/// A vehicle and the column map of its logs, which a fit changes.
struct FittedModel {
  dynamics::VehicleConfig vehicle;
  LogColumnsConfig columns;
};

/// A number of a model that a fit changes within bounds, in the unit of its YAML key.
struct FitParameter {
  std::string name;  ///< dotted: "rotor.drag", "mass.inertia.0"; "columns.pwm.at_zero", "columns.tail_rad.offset"
  double low = 0.0, high = 0.0;  ///< low < high
  std::string unit;
};

/// Reads "rotor.drag=0:1e-3" for a model. Throws InputError if the model has no such number, or the bounds are not
/// rising or beyond the number's own.
FitParameter fit_parameter(const FittedModel& model, const std::string& text);

/// Returns a parameter's value in the unit of its YAML key.
double parameter_value(const FittedModel& model, const FitParameter& parameter);

/// Sets a parameter, in the unit of its YAML key.
void set_parameter(FittedModel& model, const FitParameter& parameter, double value);

}  // namespace hedgehop::sim
