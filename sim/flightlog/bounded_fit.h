#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// Returns the residuals at parameters in the unit box; nullopt if there is no such model.
using Residuals = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd& z)>;

/// The result of a least-squares fit in the unit box.
struct BoundedFit {
  Eigen::VectorXd z;                    ///< 0 to 1
  double start_cost = 0.0, cost = 0.0;  ///< mean of the squared residuals
  int steps = 0;
  Eigen::MatrixXd jacobian;  ///< of the residuals at z, by differences
};

/// Minimizes the sum of squared residuals within 0 <= z <= 1 by the method of Levenberg and Marquardt with an active
/// set of bounds. The Jacobian is by differences.
/// @param start  in the box; residuals must exist there. Throws std::invalid_argument otherwise.
/// Source: [More1978] sec. 1; bounds by projection of the step.
BoundedFit fit_in_box(const Residuals& residuals, const Eigen::VectorXd& start, int max_steps);

/// Accuracy of fitted parameters.
struct Determination {
  Eigen::VectorXd standard_error;   ///< in the unit box; infinite along directions without influence
  Eigen::VectorXd singular_values;  ///< of the Jacobian, falling
  std::vector<bool> determined;  ///< the standard error is below kDetermined, and no direction without influence has it
  /// Directions of parameters, unit vectors, along which the residuals hardly change.
  std::vector<Eigen::VectorXd> silent;
};

/// Returns it from the singular values of the Jacobian. @param cost  mean of the squared residuals.
/// The standard errors are those of independent residuals; residuals that are correlated in time have larger ones.
/// Source: [GolubVanLoan2013] sec. 5.5.
Determination determination(const Eigen::MatrixXd& jacobian, double cost);

}  // namespace hedgehop::sim
