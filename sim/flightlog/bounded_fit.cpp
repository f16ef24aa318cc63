#include "sim/flightlog/bounded_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hedgehop::sim {
namespace {

constexpr double kDifference = 1e-4;  // of the unit box: far above the rounding of a replay

double mean_square(const Eigen::VectorXd& r) { return r.squaredNorm() / static_cast<double>(r.size()); }

/// Returns the Jacobian at `z`, inside the box, by differences of the second order: first-order ones would hide from
/// determination() that parameters act through their ratio only. A column without a model on either side is 0.
Eigen::MatrixXd jacobian_at(const Residuals& residuals, const Eigen::VectorXd& z, const Eigen::VectorXd& r) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(r.size(), z.size());
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const auto at = [&](double step) -> std::optional<Eigen::VectorXd> {
      Eigen::VectorXd moved = z;
      moved[k] += step;
      if (moved[k] < 0.0 || moved[k] > 1.0) return std::nullopt;
      return residuals(moved);
    };
    const auto ahead = at(kDifference), behind = at(-kDifference);
    if (ahead && behind) {
      J.col(k) = (*ahead - *behind) / (2.0 * kDifference);
    } else if (ahead || behind) {
      const double step = ahead ? kDifference : -kDifference;
      const auto further = at(2.0 * step);
      if (further) J.col(k) = (4.0 * (ahead ? *ahead : *behind) - 3.0 * r - *further) / (2.0 * step);
    }
  }
  return J;
}

/// Returns the step of the free parameters; those at a bound that the gradient pushes against stay.
Eigen::VectorXd step_of(const Eigen::MatrixXd& J, const Eigen::VectorXd& r, const Eigen::VectorXd& z, double damping) {
  const Eigen::VectorXd gradient = J.transpose() * r;
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const bool held = (z[k] <= 0.0 && gradient[k] > 0.0) || (z[k] >= 1.0 && gradient[k] < 0.0);
    if (!held && J.col(k).squaredNorm() > 0.0) free.push_back(k);
  }
  Eigen::VectorXd step = Eigen::VectorXd::Zero(z.size());
  if (free.empty()) return step;
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd A(count, count);
  Eigen::VectorXd b(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    b[i] = -gradient[free[static_cast<size_t>(i)]];
    for (Eigen::Index j = 0; j < count; ++j) {
      A(i, j) = J.col(free[static_cast<size_t>(i)]).dot(J.col(free[static_cast<size_t>(j)]));
    }
  }
  A.diagonal() *= 1.0 + damping;
  const Eigen::VectorXd moved = A.ldlt().solve(b);
  for (Eigen::Index i = 0; i < count; ++i) step[free[static_cast<size_t>(i)]] = moved[i];
  return step;
}

}  // namespace

BoundedFit fit_in_box(const Residuals& residuals, const Eigen::VectorXd& start, int max_steps) {
  constexpr double kSettled = 1e-6, kMaxDamping = 1e8;
  std::optional<Eigen::VectorXd> r = residuals(start);
  if (!r) throw std::invalid_argument("the model does not exist at the start of the fit");
  BoundedFit fit{start, mean_square(*r), mean_square(*r), 0, jacobian_at(residuals, start, *r)};
  double damping = 1e-3;
  while (fit.steps < max_steps && damping < kMaxDamping) {
    const Eigen::VectorXd step = step_of(fit.jacobian, *r, fit.z, damping);
    const Eigen::VectorXd z = (fit.z + step).cwiseMax(0.0).cwiseMin(1.0);
    if ((z - fit.z).norm() < kSettled) break;
    const std::optional<Eigen::VectorXd> there = residuals(z);
    if (!there || !(mean_square(*there) < fit.cost)) {
      damping *= 10.0;
      continue;
    }
    const double gain = 1.0 - mean_square(*there) / fit.cost;
    fit.z = z;
    r = there;
    fit.cost = mean_square(*r);
    fit.jacobian = jacobian_at(residuals, fit.z, *r);
    damping = std::max(0.1 * damping, 1e-9);
    ++fit.steps;
    if (gain < kSettled) break;
  }
  return fit;
}

Determination determination(const Eigen::MatrixXd& jacobian, double cost) {
  constexpr double kSilent = 1e-6;        // singular values below this share of the largest are rounding
  constexpr double kPartOfSilent = 0.05;  // component of a unit direction
  constexpr double kDetermined = 0.25;    // standard error that still leaves half of the range out at 95 %
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::Index parameters = jacobian.cols();
  const double freedom = std::max<double>(1.0, static_cast<double>(jacobian.rows() - parameters));
  const double variance = cost * static_cast<double>(jacobian.rows()) / freedom;
  Determination out;
  out.singular_values = svd.singularValues();
  out.standard_error = Eigen::VectorXd::Zero(parameters);
  out.determined.assign(static_cast<size_t>(parameters), true);
  const double largest = out.singular_values.size() > 0 ? out.singular_values[0] : 0.0;
  for (Eigen::Index s = 0; s < parameters; ++s) {
    const Eigen::VectorXd direction = svd.matrixV().col(s);
    if (out.singular_values[s] > kSilent * largest) {
      out.standard_error += variance / (out.singular_values[s] * out.singular_values[s]) * direction.cwiseAbs2();
      continue;
    }
    out.silent.push_back(direction);
    for (Eigen::Index k = 0; k < parameters; ++k) {
      if (std::abs(direction[k]) < kPartOfSilent) continue;
      out.determined[static_cast<size_t>(k)] = false;
      out.standard_error[k] = INFINITY;
    }
  }
  out.standard_error = out.standard_error.cwiseSqrt();
  for (Eigen::Index k = 0; k < parameters; ++k) {
    if (!(out.standard_error[k] < kDetermined)) out.determined[static_cast<size_t>(k)] = false;
  }
  return out;
}

}  // namespace hedgehop::sim
