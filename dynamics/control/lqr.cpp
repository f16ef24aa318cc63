#include "dynamics/control/lqr.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace hedgehop::dynamics::control {
namespace {

/// Returns e^M by scaling, a Taylor series and squaring.
DesignMatrix exponential(const DesignMatrix& M) {
  constexpr int kTerms = 12;  // relative remainder of the series below 1e-16 for a norm of 1/4
  const double norm = M.cwiseAbs().rowwise().sum().maxCoeff();
  const int squarings = norm > 0.25 ? static_cast<int>(std::ceil(std::log2(norm / 0.25))) : 0;
  const DesignMatrix scaled = M / std::exp2(squarings);
  DesignMatrix term = DesignMatrix::Identity(M.rows(), M.cols());
  DesignMatrix sum = term;
  for (int k = 1; k <= kTerms; ++k) {
    term = (term * scaled / k).eval();
    sum += term;
  }
  for (int i = 0; i < squarings; ++i) sum = (sum * sum).eval();
  return sum;
}

}  // namespace

LinearSystem sampled(const LinearSystem& continuous, double dt_s) {
  const Eigen::Index n = continuous.A.rows(), m = continuous.B.cols();
  DesignMatrix M = DesignMatrix::Zero(n + m, n + m);
  M.topLeftCorner(n, n) = continuous.A * dt_s;
  M.topRightCorner(n, m) = continuous.B * dt_s;
  const DesignMatrix E = exponential(M);
  return {E.topLeftCorner(n, n), E.topRightCorner(n, m)};
}

DesignMatrix lqr_gain(const LinearSystem& system, const DesignMatrix& Q, const DesignMatrix& R) {
  const Eigen::Index n = system.A.rows();
  const DesignMatrix I = DesignMatrix::Identity(n, n);
  DesignMatrix A = system.A;
  DesignMatrix G = system.B * R.partialPivLu().solve(DesignMatrix(system.B.transpose()));
  DesignMatrix H = Q;

  constexpr int kMaxDoublings = 60;
  constexpr double kConverged = 1e-12;  // relative; the error squares with every doubling
  bool converged = false;
  for (int i = 0; i < kMaxDoublings && !converged && H.allFinite(); ++i) {
    const DesignMatrix W = I + G * H;
    const Eigen::PartialPivLU<DesignMatrix> lu(W);
    const DesignMatrix V1 = lu.solve(A);
    const DesignMatrix V2 = lu.solve(G);
    const DesignMatrix added = A.transpose() * H * V1;
    G = (G + A * V2 * A.transpose()).eval();
    H += added;
    A = (A * V1).eval();
    converged = added.cwiseAbs().maxCoeff() <= kConverged * H.cwiseAbs().maxCoeff();
  }
  if (!converged || !H.allFinite()) throw std::invalid_argument("the vehicle cannot be stabilized by its linear model");
  const DesignMatrix S = R + system.B.transpose() * H * system.B;
  return S.partialPivLu().solve(DesignMatrix(system.B.transpose() * H * system.A));
}

}  // namespace hedgehop::dynamics::control
