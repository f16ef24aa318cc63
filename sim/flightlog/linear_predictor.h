#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/rigid_body.h"
#include "sim/flightlog/recorded_flight.h"

namespace hedgehop::sim {

/// Range of samples of one log, [begin, end).
struct LogPart {
  const RecordedFlight* flight = nullptr;
  size_t begin = 0, end = 0;
};

/// A linear model of a vehicle, fitted to logs by least squares: the baseline that any model of the vehicle must beat.
///
/// x_{k+1} = A x_k + B u_k + c with x = (velocity in the level frame of the heading, roll, pitch, p, q, r). The turn of
/// the heading and the displacement in that frame over one sample are linear in the same quantities.
class LinearPredictor {
 public:
  /// @param parts  with the same inputs and period.
  explicit LinearPredictor(std::span<const LogPart> parts);

  /// Returns the predicted states of the samples start + 1 to start + count.
  std::vector<dynamics::RigidBodyState> predict(const RecordedFlight& flight, size_t start, size_t count) const;

 private:
  Eigen::MatrixXd rows_;  ///< per (x, u, 1): next x, turn, displacement
};

}  // namespace hedgehop::sim
