#pragma once

#include <Eigen/Core>
#include <span>

#include "sim/scenario/link_config.h"

namespace hedgehop::sim::link {

/// Returns the number of servos of a swashplate, 3 or 4.
size_t swash_servos(HelicopterLinkConfig::Swashplate type);

/// Collective 0..1, roll (right) and pitch (nose up) of a swashplate, as ArduPilot commands them.
struct SwashCommand {
  double collective = 0.0, roll = 0.0, pitch = 0.0;
};

/// The inverse of ArduPilot's swashplate mixing. Source: ArduPilot, libraries/AP_Motors/AP_MotorsHeli_Swash.cpp, sec.
/// on the factors of each type.
class SwashplateInverse {
 public:
  /// Throws std::invalid_argument if the servos' azimuths do not determine all three motions.
  explicit SwashplateInverse(const HelicopterLinkConfig& config);

  /// @param pulse_us  of the servos SERVO1, 2, 3 and, with four, 5. With four servos, the inverse is that of least
  /// squares.
  SwashCommand command(std::span<const double> pulse_us) const;

 private:
  Eigen::Matrix<double, 3, 4> inverse_ = Eigen::Matrix<double, 3, 4>::Zero();  ///< of factors of the servos
  Eigen::Vector4d zero_us_ = Eigen::Vector4d::Zero();                          ///< pulses at collective 0
  size_t servos_ = 3;
  bool reversed_ = false;
};

}  // namespace hedgehop::sim::link
