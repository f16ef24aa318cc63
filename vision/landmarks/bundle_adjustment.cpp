#include "vision/landmarks/bundle_adjustment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Rows6 = Eigen::Matrix<double, 6, Eigen::Dynamic>;

constexpr double kHuberSigmas = 2.0;  // residuals above this count linearly: of wrong matches

Matrix3d skew(const Vector3d& a) {
  Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Matrix3d rotation(const Vector3d& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3d::Identity();
}

/// Returns the small rotation vector of a matrix near the identity.
Vector3d small_rotation(const Matrix3d& R) {
  return 0.5 * Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

Isometry3d moved(const Isometry3d& X_WB, const Vector6& step) {
  Isometry3d X = X_WB;
  X.translation() += step.head<3>();
  X.linear() = Eigen::Quaterniond(rotation(step.tail<3>()) * X_WB.linear()).normalized().toRotationMatrix();
  return X;
}

/// Difference between a frame's pose and the navigation's, along the axes of W.
Vector6 off_navigation(const BundleFrame& frame) {
  Vector6 r;
  r << frame.X_WB.translation() - frame.X_WB_nav.translation(),
      small_rotation(frame.X_WB.linear() * frame.X_WB_nav.linear().transpose());
  return r;
}

/// Difference between two frames' relative pose and that of the sensors, along the axes of W.
Vector6 off_step(const BundleFrame& before, const BundleFrame& frame) {
  Vector6 r;
  r << frame.X_WB.translation() - before.X_WB.translation() - frame.step_W,
      small_rotation(frame.X_WB.linear() * (before.X_WB.linear() * frame.turn_B).transpose());
  return r;
}

Vector6 information(double position_sigma, double rotation_sigma) {
  Vector6 i;
  i << Vector3d::Constant(1.0 / (position_sigma * position_sigma)),
      Vector3d::Constant(1.0 / (rotation_sigma * rotation_sigma));
  return i;
}

/// The normal equations: poses block tridiagonal, points block diagonal.
struct Normal {
  std::vector<Matrix6> pose, lower;  ///< diagonal blocks, and the blocks left of them
  std::vector<Vector6> pose_gradient;
  std::vector<Matrix3d> point;
  std::vector<Vector3d> point_gradient;
  std::vector<std::vector<Eigen::Matrix<double, 6, 3>>> cross;  ///< of each bearing of each frame
};

class Problem {
 public:
  Problem(const Isometry3d& X_BC, const BundleNoise& noise) : X_BC_(X_BC), noise_(noise) {}

  double cost(std::span<const BundleFrame> frames, std::span<const Vector3d> points) const {
    double sum = 0.0;
    const Vector6 absolute = information(noise_.position_m, noise_.attitude_rad);
    for (size_t k = 0; k < frames.size(); ++k) {
      sum += 0.5 * off_navigation(frames[k]).cwiseAbs2().dot(absolute);
      if (k > 0) sum += 0.5 * off_step(frames[k - 1], frames[k]).cwiseAbs2().dot(step_information(frames[k]));
      for (const BundleBearing& seen : frames[k].bearings) {
        const BundleProjection at = project_point(points[seen.point], frames[k].X_WB, X_BC_);
        if (!(at.depth_m > kMinBundleDepthM)) return std::numeric_limits<double>::infinity();
        const double sigmas = (at.bearing - seen.bearing).norm() / noise_.bearing;
        sum += sigmas <= kHuberSigmas ? 0.5 * sigmas * sigmas : kHuberSigmas * (sigmas - 0.5 * kHuberSigmas);
      }
    }
    return sum;
  }

  Normal normal(std::span<const BundleFrame> frames, std::span<const Vector3d> points) const {
    Normal n;
    n.pose.resize(frames.size());
    n.lower.assign(frames.size(), Matrix6::Zero());
    n.pose_gradient.resize(frames.size());
    n.point.assign(points.size(), Matrix3d::Zero());
    n.point_gradient.assign(points.size(), Vector3d::Zero());
    n.cross.resize(frames.size());
    const Vector6 absolute = information(noise_.position_m, noise_.attitude_rad);
    for (size_t k = 0; k < frames.size(); ++k) {
      n.pose[k] = absolute.asDiagonal();
      n.pose_gradient[k] = absolute.cwiseProduct(off_navigation(frames[k]));
      if (k > 0) add_step(frames, k, n);
      for (const BundleBearing& seen : frames[k].bearings) add_bearing(frames[k], k, seen, points, n);
    }
    return n;
  }

 private:
  Vector6 step_information(const BundleFrame& frame) const {
    const double root = std::sqrt(frame.dt_s);
    return information(root * noise_.step_m_rt_s, root * noise_.turn_rad_rt_s);
  }

  void add_step(std::span<const BundleFrame> frames, size_t k, Normal& n) const {
    const Vector6 weight = step_information(frames[k]);
    const Vector6 gradient = weight.cwiseProduct(off_step(frames[k - 1], frames[k]));
    n.pose[k].diagonal() += weight;
    n.pose[k - 1].diagonal() += weight;
    n.lower[k].diagonal() -= weight;
    n.pose_gradient[k] += gradient;
    n.pose_gradient[k - 1] -= gradient;
  }

  void add_bearing(const BundleFrame& frame, size_t k, const BundleBearing& seen, std::span<const Vector3d> points,
                   Normal& n) const {
    const BundleProjection at = project_point(points[seen.point], frame.X_WB, X_BC_);
    const Vector2d residual = at.bearing - seen.bearing;
    const double sigmas = residual.norm() / noise_.bearing;
    const double weight = std::min(1.0, kHuberSigmas / std::max(sigmas, 1e-12)) / (noise_.bearing * noise_.bearing);
    n.pose[k] += weight * at.d_pose.transpose() * at.d_pose;
    n.pose_gradient[k] += weight * at.d_pose.transpose() * residual;
    n.point[seen.point] += weight * at.d_point.transpose() * at.d_point;
    n.point_gradient[seen.point] += weight * at.d_point.transpose() * residual;
    n.cross[k].emplace_back(weight * at.d_pose.transpose() * at.d_point);
  }

  Isometry3d X_BC_;
  BundleNoise noise_;
};

/// The normal equations without the poses: Cholesky's factors of the poses' block tridiagonal matrix, and the dense
/// system of the points.
class Reduced {
 public:
  Reduced(std::span<const BundleFrame> frames, const Normal& n, double damping)
      : size_(3 * static_cast<Eigen::Index>(n.point.size())) {
    const Eigen::Index right = size_;  // the last column is the right side
    MatrixXd S = MatrixXd::Zero(size_, size_);
    VectorXd b(size_);
    for (size_t i = 0; i < n.point.size(); ++i) {
      const auto at = 3 * static_cast<Eigen::Index>(i);
      S.block<3, 3>(at, at) = n.point[i];
      S.block<3, 3>(at, at).diagonal() *= 1.0 + damping;
      b.segment<3>(at) = -n.point_gradient[i];
    }
    for (size_t k = 0; k < frames.size(); ++k) {
      Matrix6 H = n.pose[k];
      H.diagonal() *= 1.0 + damping;
      Rows6 W = Rows6::Zero(6, size_ + 1);
      for (size_t j = 0; j < frames[k].bearings.size(); ++j) {
        W.middleCols<3>(3 * static_cast<Eigen::Index>(frames[k].bearings[j].point)) += n.cross[k][j];
      }
      W.col(right) = -n.pose_gradient[k];
      Matrix6 before = Matrix6::Zero();
      if (k > 0) {
        before = factor_.back().triangularView<Eigen::Lower>().solve(n.lower[k].transpose()).transpose();
        H -= before.lazyProduct(before.transpose());
        W -= before.lazyProduct(Y_.back());
      }
      const Matrix6 L = H.llt().matrixL();
      for (Eigen::Index c = 0; c < W.cols(); ++c) {
        W.col(c) = L.triangularView<Eigen::Lower>().solve(Vector6(W.col(c)));
      }
      S.selfadjointView<Eigen::Lower>().rankUpdate(W.leftCols(size_).transpose(), -1.0);
      b -= W.leftCols(size_).transpose().lazyProduct(W.col(right));
      before_.push_back(before);
      factor_.push_back(L);
      Y_.push_back(std::move(W));
    }
    points_.compute(S.selfadjointView<Eigen::Lower>());
    steps_ = points_.solve(b);
  }

  bool solved() const { return points_.info() == Eigen::Success && points_.isPositive() && steps_.allFinite(); }
  Vector3d point_step(size_t i) const { return steps_.segment<3>(3 * static_cast<Eigen::Index>(i)); }

  std::vector<Vector6> pose_steps() const {
    std::vector<Vector6> steps(factor_.size());
    for (size_t k = factor_.size(); k-- > 0;) {
      Vector6 right = Y_[k].col(size_) - Y_[k].leftCols(size_).lazyProduct(steps_);
      if (k + 1 < factor_.size()) right -= before_[k + 1].transpose() * steps[k + 1];
      steps[k] = factor_[k].transpose().triangularView<Eigen::Upper>().solve(right);
    }
    return steps;
  }

  Matrix3d covariance(size_t i) const {
    Matrix3d P;
    for (Eigen::Index c = 0; c < 3; ++c) {
      const Eigen::Index at = 3 * static_cast<Eigen::Index>(i);
      const VectorXd column = points_.solve(VectorXd(VectorXd::Unit(size_, at + c)));
      P.col(c) = column.segment<3>(at);
    }
    return 0.5 * (P + P.transpose());
  }

 private:
  Eigen::Index size_;
  std::vector<Matrix6> factor_, before_;
  std::vector<Rows6> Y_;
  Eigen::LDLT<MatrixXd> points_;  // without blocks whose size depends on the processor's caches
  VectorXd steps_;
};

}  // namespace

BundleProjection project_point(const Vector3d& p_W, const Isometry3d& X_WB, const Isometry3d& X_BC) {
  const Matrix3d R_CW = (X_WB.linear() * X_BC.linear()).transpose();
  const Vector3d p_BW = p_W - X_WB.translation();
  const Vector3d p_C = R_CW * p_BW - X_BC.linear().transpose() * X_BC.translation();
  BundleProjection at;
  at.depth_m = p_C.z();
  if (!(at.depth_m > kMinBundleDepthM)) return at;
  at.bearing = p_C.head<2>() / p_C.z();
  Eigen::Matrix<double, 2, 3> d_p_C;
  d_p_C << Eigen::Matrix2d::Identity(), -at.bearing;
  at.d_point = d_p_C / p_C.z() * R_CW;
  at.d_pose << -at.d_point, at.d_point * skew(p_BW);
  return at;
}

BundleResult adjust_bundle(std::span<BundleFrame> frames, std::span<Vector3d> points_W, const Isometry3d& X_BC,
                           const BundleNoise& noise, int iterations) {
  constexpr double kMinDamping = 1e-7, kMaxDamping = 1e4, kConverged = 1e-5;
  const Problem problem(X_BC, noise);
  BundleResult result;
  result.cost = problem.cost(frames, points_W);
  double damping = 1e-6;
  std::vector<BundleFrame> tried_frames;
  std::vector<Vector3d> tried_points;
  for (int i = 0; i < iterations && damping < kMaxDamping; ++i) {
    const Reduced reduced(frames, problem.normal(frames, points_W), damping);
    double cost = std::numeric_limits<double>::infinity();
    if (reduced.solved()) {
      tried_frames.assign(frames.begin(), frames.end());
      tried_points.assign(points_W.begin(), points_W.end());
      const std::vector<Vector6> steps = reduced.pose_steps();
      for (size_t k = 0; k < frames.size(); ++k) tried_frames[k].X_WB = moved(frames[k].X_WB, steps[k]);
      for (size_t j = 0; j < points_W.size(); ++j) tried_points[j] += reduced.point_step(j);
      cost = problem.cost(tried_frames, tried_points);
    }
    if (!(cost < result.cost)) {
      damping *= 10.0;
      continue;
    }
    const bool converged = result.cost - cost < kConverged * result.cost;
    result.cost = cost;
    std::ranges::move(tried_frames, frames.begin());
    std::ranges::copy(tried_points, points_W.begin());
    damping = std::max(kMinDamping, 0.1 * damping);
    if (converged) break;
  }
  const Reduced final(frames, problem.normal(frames, points_W), kMinDamping);
  for (size_t j = 0; j < points_W.size(); ++j) result.covariances_W.push_back(final.covariance(j));
  return result;
}

}  // namespace hedgehop::vision::landmarks
