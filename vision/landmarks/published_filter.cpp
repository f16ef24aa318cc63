#include "vision/landmarks/published_filter.h"

#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <tuple>

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// A database point on the image plane, with the symbols of the thesis.
struct Projected {
  Vector2d x_k = Vector2d::Zero();  ///< its position, at focal length 1
  Matrix23 H = Matrix23::Zero();    ///< derivative of x_k with respect to the point in W
  Matrix2d R = Matrix2d::Zero();    ///< covariance of a measurement of it
};

/// Returns the projection of a point; std::nullopt if it is not in front of the camera.
std::optional<Projected> project(const Vector3d& X_v, const CameraPose& camera, double bearing_sigma) {
  constexpr double kMinDepthM = 1e-3;
  const Matrix3d L_bv = camera.X_WC_est.linear().transpose();
  const Vector3d X = X_v - camera.X_WC_est.translation();  // eq. (4.8)
  const Vector3d X_c = L_bv * X;                           // eq. (4.9); our optical axis is z
  if (!(X_c.z() > kMinDepthM)) return std::nullopt;
  Projected seen;
  seen.x_k = X_c.head<2>() / X_c.z();         // eq. (4.11), f = 1
  seen.H << Matrix2d::Identity(), -seen.x_k;  // eq. (4.19)
  seen.H = (seen.H / X_c.z() * L_bv).eval();  // eq. (4.20)
  const double shift = camera.position_sigma_m / X_c.z();
  const double variance =
      bearing_sigma * bearing_sigma + shift * shift + camera.attitude_sigma_rad * camera.attitude_sigma_rad;
  seen.R = variance * Matrix2d::Identity();  // eq. (4.22)
  return seen;
}

/// Returns the Z value: the error index J squared over its variance C.
double z_of(const Projected& seen, const Matrix3d& P, const Vector2d& Z) {
  const Vector2d d = Z - seen.x_k;   // eq. (4.7)
  const double J = d.squaredNorm();  // eq. (4.5)
  if (J == 0.0) return 0.0;
  const Eigen::RowVector3d C_x = 2.0 * d.transpose() * seen.H;                            // eq. (4.23)
  const Eigen::RowVector2d C_z = 2.0 * d.transpose();                                     // eq. (4.24)
  const double C = (C_x * P * C_x.transpose() + C_z * seen.R * C_z.transpose()).value();  // eq. (4.5)
  return J * J / C;
}

/// Corrects a point by its measurement.
void correct(const Projected& seen, const Vector2d& Z, Landmark& point) {
  const Matrix2d S = seen.H * point.P * seen.H.transpose() + seen.R;
  const Eigen::Matrix<double, 3, 2> K = point.P * seen.H.transpose() * S.inverse();  // eq. (4.15)
  point.x += K * (Z - seen.x_k);                                                     // eq. (4.16)
  point.P -= (K * seen.H * point.P).eval();                                          // eq. (4.17)
}

/// Returns the point of each measurement: the pairs below the gate in increasing order of their Z value, one to one.
std::vector<std::optional<size_t>> correspond(const PublishedFilter& filter, std::span<const Vector2d> measured,
                                              const std::vector<std::optional<Projected>>& projected,
                                              const std::vector<MappedLandmark>& database) {
  std::vector<std::tuple<double, size_t, size_t>> pairs;
  for (size_t i = 0; i < measured.size(); ++i) {
    for (size_t k = 0; k < projected.size(); ++k) {
      if (!projected[k]) continue;
      const double z = z_of(*projected[k], database[k].landmark.P, measured[i]);
      if (z < filter.gate) pairs.emplace_back(z, i, k);
    }
  }
  std::ranges::sort(pairs);
  std::vector<std::optional<size_t>> point_of(measured.size());
  std::vector<bool> taken(database.size(), false);
  for (const auto& [z, i, k] : pairs) {
    if (point_of[i] || taken[k]) continue;
    point_of[i] = k;
    taken[k] = true;
  }
  return point_of;
}

}  // namespace

std::vector<int64_t> update_as_published(const PublishedFilter& filter, std::span<const Vector2d> bearings_meas,
                                         const CameraPose& pose, double dt_s, std::vector<MappedLandmark>& database,
                                         int64_t& next_id) {
  std::vector<std::optional<Projected>> projected;
  for (MappedLandmark& point : database) {
    const double Q_m2 = filter.drift_m_rt_s * filter.drift_m_rt_s * dt_s;
    point.landmark.P += Q_m2 * Matrix3d::Identity();  // eq. (4.14); the point is fixed, eq. (4.13)
    projected.push_back(project(point.landmark.x, pose, filter.bearing_sigma));
  }
  const auto point_of = correspond(filter, bearings_meas, projected, database);

  // Count a miss for every point; a correspondence resets the count.
  for (MappedLandmark& point : database) ++point.misses;
  std::vector<int64_t> ids;
  for (size_t i = 0; i < bearings_meas.size(); ++i) {
    if (const auto k = point_of[i]) {
      MappedLandmark& point = database[*k];
      correct(*projected[*k], bearings_meas[i], point.landmark);
      ++point.matches;
      point.misses = 0;
      ids.push_back(point.id);
    } else {
      const LandmarkStart ground{.coordinates = LandmarkCoordinates::cartesian};
      ids.push_back(next_id);
      database.push_back({next_id++, first_seen(bearings_meas[i], pose, filter.bearing_sigma, ground), 1, 0});
    }
  }
  std::erase_if(database, [&](const MappedLandmark& point) { return point.misses >= filter.misses; });
  return ids;
}

}  // namespace hedgehop::vision::landmarks
