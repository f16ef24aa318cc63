#pragma once

#include <optional>

#include "dynamics/identification/frequency_response.h"
#include "dynamics/identification/test_inputs.h"
#include "dynamics/vehicle.h"

namespace hedgehop::dynamics::identification {

/// A vehicle's frequency responses from sweeps of all controls, and those of its linear model.
struct Identification {
  NamedLinearSystem linear;
  FrequencyResponse measured, model;
  std::vector<Record> records;  ///< two sweeps per control, in the order of Controls
};

struct SweepPlan {
  Eigen::Vector3d v_air_W = Eigen::Vector3d::Zero();  ///< of the trim, relative to the air, m/s
  FrequencySweep sweep;                               ///< its size does not count
  std::optional<double> size;  ///< amplitude of one control, see `input`; nullopt: default_size()
  Eigen::Index input = kHeave;
};

/// Returns the default amplitude of a sweep: 0.2 deg of a blade angle, 2 % of a multicopter's largest thrust or torque.
Controls default_sizes(const VehicleConfig& vehicle);

/// Flies a sweep of each control with weak feedback and identifies the frequency responses. Returns nullopt if there is
/// no trim. Throws std::invalid_argument if the vehicle is invalid.
std::optional<Identification> identify(const VehicleConfig& vehicle, const SweepPlan& plan);

}  // namespace hedgehop::dynamics::identification
