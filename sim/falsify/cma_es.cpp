#include "sim/falsify/cma_es.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace hedgehop::sim {

using Eigen::MatrixXd;
using Eigen::VectorXd;

CmaEsParameters::CmaEsParameters(Eigen::Index dimensions) {
  const auto n = static_cast<double>(dimensions);
  population = 4 + static_cast<size_t>(std::floor(3.0 * std::log(n)));
  const auto lambda = static_cast<double>(population);
  weights.resize(static_cast<Eigen::Index>(population / 2));
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    weights[i] = std::log(0.5 * (lambda + 1.0)) - std::log(static_cast<double>(i + 1));
  }
  weights /= weights.sum();
  mu_eff = 1.0 / weights.squaredNorm();
  c_sigma = (mu_eff + 2.0) / (n + mu_eff + 5.0);
  d_sigma = 1.0 + c_sigma + 2.0 * std::max(0.0, std::sqrt((mu_eff - 1.0) / (n + 1.0)) - 1.0);
  c_c = (4.0 + mu_eff / n) / (n + 4.0 + 2.0 * mu_eff / n);
  c_1 = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff);
  c_mu = std::min(1.0 - c_1, 2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / ((n + 2.0) * (n + 2.0) + mu_eff));
  chi_n = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
}

CmaEs::CmaEs(VectorXd start, double step, uint64_t seed)
    : parameters_(start.size()),
      random_(seed),
      mean_(std::move(start)),
      sigma_(step),
      C_(MatrixXd::Identity(mean_.size(), mean_.size())),
      p_sigma_(VectorXd::Zero(mean_.size())),
      p_c_(VectorXd::Zero(mean_.size())) {
  decompose();
}

VectorXd CmaEs::draw() {
  VectorXd z(mean_.size());
  for (double& component : z) component = random_.normal();
  return mean_ + sigma_ * (B_ * D_.cwiseProduct(z));
}

void CmaEs::adapt(std::vector<CostedPoint> generation) {
  std::ranges::stable_sort(generation, {}, &CostedPoint::cost);
  const CmaEsParameters& s = parameters_;
  const VectorXd before = mean_;
  mean_.setZero();
  for (Eigen::Index i = 0; i < s.weights.size(); ++i) mean_ += s.weights[i] * generation[static_cast<size_t>(i)].x;
  const VectorXd moved = (mean_ - before) / sigma_;

  // Step size: from the evolution path in whitened coordinates (identity covariance).
  const VectorXd whitened = B_ * (B_.transpose() * moved).cwiseQuotient(D_);
  p_sigma_ = (1.0 - s.c_sigma) * p_sigma_ + std::sqrt(s.c_sigma * (2.0 - s.c_sigma) * s.mu_eff) * whitened;
  ++generations_;
  const double warm = std::sqrt(1.0 - std::pow(1.0 - s.c_sigma, 2 * generations_));
  const double length = p_sigma_.norm() / s.chi_n;
  const bool path_is_short = length / warm < 1.4 + 2.0 / (static_cast<double>(mean_.size()) + 1.0);  // h_sigma

  // Covariance: from the path of the mean (rank one) and from the best points (rank mu).
  p_c_ = (1.0 - s.c_c) * p_c_;
  if (path_is_short) p_c_ += std::sqrt(s.c_c * (2.0 - s.c_c) * s.mu_eff) * moved;
  const double lost = path_is_short ? 0.0 : s.c_1 * s.c_c * (2.0 - s.c_c);
  C_ = (1.0 - s.c_1 - s.c_mu + lost) * C_ + s.c_1 * p_c_ * p_c_.transpose();
  for (Eigen::Index i = 0; i < s.weights.size(); ++i) {
    const VectorXd y = (generation[static_cast<size_t>(i)].x - before) / sigma_;
    C_ += s.c_mu * s.weights[i] * y * y.transpose();
  }
  sigma_ *= std::exp(s.c_sigma / s.d_sigma * (length - 1.0));
  decompose();
}

void CmaEs::decompose() {
  C_ = 0.5 * (C_ + C_.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(C_);
  constexpr double kMinEigenvalue = 1e-20;  // round-off must not make an eigenvalue negative
  B_ = solver.eigenvectors();
  D_ = solver.eigenvalues().cwiseMax(kMinEigenvalue).cwiseSqrt();
}

}  // namespace hedgehop::sim
