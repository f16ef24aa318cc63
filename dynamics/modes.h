#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "dynamics/steady_flight.h"

namespace hedgehop::dynamics {

/// Mode of motion: a real eigenvalue, or a pair of conjugates (given by the one with positive imaginary part).
struct Mode {
  std::complex<double> eigenvalue;  ///< rad/s
  double frequency_radps = 0.0;     ///< its magnitude
  double damping = 0.0;             ///< -Re / magnitude; < 0 for a growing mode
  std::string name;                 ///< "phugoid", "roll subsidence", "spiral", "Dutch roll" ...
  Eigen::VectorXcd eigenvector;     ///< in the order and units of the states; 1 at the state with the largest part
};

/// Returns the modes of a linear model, slowest first. A mode is named by the states that take part in it, and by the
/// airspeed: below 1 m/s, slow oscillations are those of the hover cubics.
/// Sources: names of [Padfield2007] sec. 4.3.3; participation factors of [PerezArriaga1982] pp. 3117-3125.
std::vector<Mode> modes(const NamedLinearSystem& linear, double airspeed_mps);

}  // namespace hedgehop::dynamics
