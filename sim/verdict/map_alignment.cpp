#include "sim/verdict/map_alignment.h"

#include <cmath>
#include <vector>

#include "sim/verdict/assignment.h"

namespace hedgehop::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Returns the transform of the least-squares fit of pairs, at least one.
Isometry3d fit(const std::vector<Vector3d>& to, const std::vector<Vector3d>& from) {
  Vector3d to_mean = Vector3d::Zero(), from_mean = Vector3d::Zero();
  for (size_t i = 0; i < to.size(); ++i) {
    to_mean += to[i] / static_cast<double>(to.size());
    from_mean += from[i] / static_cast<double>(to.size());
  }
  double cosine = 0.0, sine = 0.0;
  for (size_t i = 0; i < to.size(); ++i) {
    const Vector3d a = from[i] - from_mean, b = to[i] - to_mean;
    cosine += a.x() * b.x() + a.y() * b.y();
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const double norm = std::hypot(cosine, sine);
  Isometry3d X = Isometry3d::Identity();
  if (norm > 0.0) X.linear().topLeftCorner<2, 2>() << cosine / norm, -sine / norm, sine / norm, cosine / norm;
  X.translation() = to_mean - X.linear() * from_mean;
  return X;
}

}  // namespace

std::optional<Isometry3d> align_map(std::span<const Vector3d> corners_W, std::span<const Vector3d> map_W,
                                    double tolerance_m) {
  Isometry3d X = Isometry3d::Identity();
  for (const double times : {3.0, 1.5}) {
    std::vector<Vector3d> moved;
    for (const Vector3d& p_W : map_W) moved.emplace_back(X * p_W);
    const auto matches = match_points(corners_W, moved, times * tolerance_m);
    std::vector<Vector3d> to, from;
    for (size_t corner = 0; corner < matches.size(); ++corner) {
      if (!matches[corner]) continue;
      to.push_back(corners_W[corner]);
      from.push_back(map_W[static_cast<size_t>(*matches[corner])]);
    }
    if (to.size() < 2) return std::nullopt;
    X = fit(to, from);
  }
  return X;
}

}  // namespace hedgehop::sim
