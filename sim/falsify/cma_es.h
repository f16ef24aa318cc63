#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/libm/random.h"

namespace hedgehop::sim {

/// Default parameters of the strategy for a number of unknowns.
/// Source: [Hansen2016] sec. A (default parameters), with positive weights only.
struct CmaEsParameters {
  explicit CmaEsParameters(Eigen::Index dimensions);

  size_t population = 0;    ///< lambda: points per generation
  Eigen::VectorXd weights;  ///< of the best mu points; they sum to 1
  double mu_eff = 0.0;      ///< variance effective selection mass
  double c_sigma = 0.0, d_sigma = 0.0, c_c = 0.0, c_1 = 0.0, c_mu = 0.0;
  double chi_n = 0.0;  ///< expected length of a standard normal vector
};

/// A point and its cost.
struct CostedPoint {
  Eigen::VectorXd x;
  double cost = 0.0;
};

/// Covariance matrix adaptation evolution strategy, which minimizes a function without derivatives. Equal seeds and
/// costs give equal points.
/// Source: [Hansen2016] sec. A.
class CmaEs {
 public:
  /// @param start  mean of the first generation. @param step  its standard deviation along every axis, > 0.
  CmaEs(Eigen::VectorXd start, double step, uint64_t seed);

  size_t population() const { return parameters_.population; }
  /// Returns a random point of the current distribution.
  Eigen::VectorXd draw();
  /// Adapts mean, step and covariance to a generation of population() points. The points need not come from draw().
  void adapt(std::vector<CostedPoint> generation);

 private:
  void decompose();

  const CmaEsParameters parameters_;
  RandomStream random_;
  Eigen::VectorXd mean_;
  double sigma_;
  Eigen::MatrixXd C_;              ///< covariance of the points, divided by sigma squared
  Eigen::MatrixXd B_;              ///< its eigenvectors
  Eigen::VectorXd D_;              ///< square roots of its eigenvalues
  Eigen::VectorXd p_sigma_, p_c_;  ///< evolution paths
  int generations_ = 0;
};

}  // namespace hedgehop::sim
