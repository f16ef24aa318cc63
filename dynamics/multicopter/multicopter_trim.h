#pragma once

#include <Eigen/Core>
#include <optional>

#include "dynamics/multicopter/multicopter_flight.h"

namespace hedgehop::dynamics::multicopter {

/// As trim(), also if the trim needs rotor speeds above the maximum.
std::optional<MulticopterTrim> trim_of_any_speed(const MulticopterModel& model, const Eigen::Vector3d& v_air_W,
                                                 double heading_rad = 0.0);

}  // namespace hedgehop::dynamics::multicopter
