#include "vision/landmarks/landmark_matching.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

namespace hedgehop::vision::landmarks {

namespace {

using Eigen::Vector2d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Measured bearings sorted by x, for nearest-neighbor queries.
class SortedBearings {
 public:
  explicit SortedBearings(std::span<const Vector2d> bearings) : sorted_(bearings.begin(), bearings.end()) {
    std::ranges::sort(sorted_, {}, [](const Vector2d& b) { return std::pair(b.x(), b.y()); });
  }

  /// Calls `visit` with every bearing in the square with half side `within` around `at`.
  template <class Visit>
  void near(const Vector2d& at, double within, Visit&& visit) const {
    auto bearing = std::ranges::lower_bound(sorted_, at.x() - within, {}, [](const Vector2d& b) { return b.x(); });
    for (; bearing != sorted_.end() && bearing->x() <= at.x() + within; ++bearing) {
      if (std::abs(bearing->y() - at.y()) <= within) visit(*bearing);
    }
  }
  std::optional<Vector2d> nearest(const Vector2d& at, double within) const {
    std::optional<Vector2d> best;
    near(at, within, [&](const Vector2d& b) {
      if (!best || (b - at).squaredNorm() < (*best - at).squaredNorm()) best = b;
    });
    return best;
  }

 private:
  std::vector<Vector2d> sorted_;
};

double support(std::span<const PredictedBearing> landmarks, const SortedBearings& bearings, const CameraError& error,
               double within) {
  double sum = 0.0;
  for (const PredictedBearing& seen : landmarks) {
    const Vector2d at = seen.bearing + seen.d_bearing_pose * error;
    if (const auto b = bearings.nearest(at, within)) {
      sum += std::max(0.0, 1.0 - (*b - at).squaredNorm() / (within * within));
    }
  }
  return sum;
}

/// Returns the most likely error, given its prior and the landmarks' nearest bearings.
CameraError refined(std::span<const PredictedBearing> landmarks, const SortedBearings& bearings,
                    const CameraError& error, const Matrix6& information, double bearing_sigma, double within) {
  Matrix6 normal = information;
  CameraError right = CameraError::Zero();
  for (const PredictedBearing& seen : landmarks) {
    const auto b = bearings.nearest(seen.bearing + seen.d_bearing_pose * error, within);
    if (!b) continue;
    const double weight = 1.0 / (bearing_sigma * bearing_sigma);
    normal += weight * seen.d_bearing_pose.transpose() * seen.d_bearing_pose;
    right += weight * seen.d_bearing_pose.transpose() * (*b - seen.bearing);
  }
  return normal.ldlt().solve(right);
}

}  // namespace

CameraError common_error(std::span<const std::optional<PredictedBearing>> predicted,
                         std::span<const Vector2d> bearings_meas, const Matrix6& prior, double bearing_sigma) {
  constexpr size_t kGuessing = 6, kJudging = 16, kRefining = 60;
  constexpr double kSupportSigmas = 10.0, kMaxSigmas = 4.0, kMinVariance = 1e-12;
  std::vector<PredictedBearing> landmarks;
  for (const auto& seen : predicted) {
    if (seen) landmarks.push_back(*seen);
  }
  // Best-known landmarks first. The first ones provide hypotheses, more of them judge, and even more refine.
  const auto own_variance = [](const PredictedBearing& seen) { return (seen.covariance - seen.noise).trace(); };
  std::ranges::stable_sort(landmarks, {}, own_variance);
  if (landmarks.size() > kRefining) landmarks.resize(kRefining);
  const auto judges = std::span(landmarks).first(std::min(kJudging, landmarks.size()));

  const SortedBearings bearings(bearings_meas);
  const double within = kSupportSigmas * bearing_sigma;
  CameraError best = CameraError::Zero();
  double max_support = support(judges, bearings, best, within);
  for (const PredictedBearing& seen : std::span(landmarks).first(std::min(kGuessing, landmarks.size()))) {
    const Eigen::Matrix2d S = seen.d_bearing_pose * prior * seen.d_bearing_pose.transpose() +
                              bearing_sigma * bearing_sigma * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 6, 2> gain = prior * seen.d_bearing_pose.transpose() * S.inverse();
    bearings.near(seen.bearing, kMaxSigmas * std::sqrt(S.trace()), [&](const Vector2d& b) {
      const CameraError guess = gain * (b - seen.bearing);
      const double found = support(judges, bearings, guess, within);
      if (found > max_support) {
        max_support = found;
        best = guess;
      }
    });
  }
  const Matrix6 information = (prior + kMinVariance * Matrix6::Identity()).inverse();
  for (int round = 0; round < 4; ++round) {
    best = refined(landmarks, bearings, best, information, bearing_sigma, within);
  }
  return best;
}

CameraPose corrected(const CameraPose& pose, const CameraError& error) {
  Eigen::Isometry3d X_CC = Eigen::Isometry3d::Identity();
  X_CC.translation() = error.head<3>();
  const Eigen::Vector3d turn_C = error.tail<3>();
  if (turn_C.norm() > 0.0) X_CC.linear() = Eigen::AngleAxisd(turn_C.norm(), turn_C.normalized()).toRotationMatrix();
  return {pose.X_WC_est * X_CC, pose.position_sigma_m, pose.attitude_sigma_rad};
}

PredictedBearing with_known_pose(const PredictedBearing& seen, double bearing_sigma) {
  PredictedBearing known = seen;
  known.noise = bearing_sigma * bearing_sigma * Eigen::Matrix2d::Identity();
  known.covariance = seen.covariance - seen.noise + known.noise;
  return known;
}

namespace {

struct MatchPair {
  double z = 0.0;
  size_t bearing = 0, landmark = 0;
  auto order() const { return std::tie(z, bearing, landmark); }
};

/// Returns a bound, in x and y, for residuals whose Z value is below a gate. Along a unit vector e the squared residual
/// is below 4 gate e'Se, which is bounded by the maximum eigenvalue of S.
double reach(const PredictedBearing& seen, double gate) {
  const Eigen::Matrix2d& S = seen.covariance;
  const double mean = 0.5 * S.trace();
  const double max_eigenvalue = mean + std::hypot(0.5 * (S(0, 0) - S(1, 1)), S(0, 1));
  constexpr double kRounding = 1.0 + 1e-9;
  return kRounding * 2.0 * std::sqrt(gate * max_eigenvalue);
}

}  // namespace

std::vector<std::optional<size_t>> match_landmarks(std::span<const std::optional<PredictedBearing>> predicted,
                                                   std::span<const Eigen::Vector2d> bearings_meas, double gate) {
  std::vector<size_t> by_x(bearings_meas.size());
  std::iota(by_x.begin(), by_x.end(), size_t{0});
  std::ranges::sort(by_x, {}, [&](size_t i) { return std::pair(bearings_meas[i].x(), i); });

  std::vector<MatchPair> pairs;
  for (size_t k = 0; k < predicted.size(); ++k) {
    if (!predicted[k]) continue;
    const Eigen::Vector2d at = predicted[k]->bearing;
    const double within = reach(*predicted[k], gate);
    const auto first =
        std::ranges::lower_bound(by_x, at.x() - within, {}, [&](size_t i) { return bearings_meas[i].x(); });
    for (auto i = first; i != by_x.end() && bearings_meas[*i].x() <= at.x() + within; ++i) {
      if (std::abs(bearings_meas[*i].y() - at.y()) > within) continue;
      const double z = z_value(*predicted[k], bearings_meas[*i]);
      if (z < gate) pairs.push_back({z, *i, k});
    }
  }
  std::ranges::sort(pairs, {}, &MatchPair::order);

  std::vector<std::optional<size_t>> landmark_of(bearings_meas.size());
  std::vector<bool> taken(predicted.size(), false);
  for (const MatchPair& pair : pairs) {
    if (landmark_of[pair.bearing] || taken[pair.landmark]) continue;
    landmark_of[pair.bearing] = pair.landmark;
    taken[pair.landmark] = true;
  }
  return landmark_of;
}

}  // namespace hedgehop::vision::landmarks
