#include "sim/verdict/map_alignment.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <vector>

#include "sim/verdict/assignment.h"

namespace hedgehop::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d mean_of(std::span<const Vector3d> points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::optional<Isometry3d> rigid_fit(std::span<const Vector3d> from, std::span<const Vector3d> to) {
  constexpr size_t kMinPairs = 3;
  constexpr double kOnOneLine = 1e-6;  // ratio of singular values; squares of lengths, of which rounding is 1e-16
  if (from.size() < kMinPairs) return std::nullopt;
  const Vector3d from_mean = mean_of(from), to_mean = mean_of(to);
  Matrix3d covariance = Matrix3d::Zero();
  for (size_t i = 0; i < from.size(); ++i) covariance += (to[i] - to_mean) * (from[i] - from_mean).transpose();
  const Eigen::JacobiSVD<Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector3d values = svd.singularValues();
  if (!(values[1] > kOnOneLine * values[0])) return std::nullopt;
  // Without the sign, a flat or distorted map could be fitted by a reflection.
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  Isometry3d X = Isometry3d::Identity();
  X.linear() = svd.matrixU() * Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
  X.translation() = to_mean - X.linear() * from_mean;
  return X;
}

std::optional<Isometry3d> align_map(std::span<const Vector3d> corners_W, std::span<const Vector3d> map_W,
                                    double tolerance_m) {
  Isometry3d X = Isometry3d::Identity();
  for (const double times : {3.0, 1.5, 1.0}) {
    std::vector<Vector3d> moved_W;
    for (const Vector3d& p_W : map_W) moved_W.emplace_back(X * p_W);
    const auto matches = match_points(corners_W, moved_W, times * tolerance_m);
    std::vector<Vector3d> from_W, to_W;
    for (size_t corner = 0; corner < matches.size(); ++corner) {
      if (!matches[corner]) continue;
      from_W.push_back(map_W[static_cast<size_t>(*matches[corner])]);
      to_W.push_back(corners_W[corner]);
    }
    const auto fitted = rigid_fit(from_W, to_W);
    if (!fitted) return std::nullopt;
    X = *fitted;
  }
  return X;
}

}  // namespace hedgehop::sim
