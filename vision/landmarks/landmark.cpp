#include "vision/landmarks/landmark.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace hedgehop::vision::landmarks {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;

/// Returns the Jacobian of the position with respect to the state.
Eigen::Matrix3d d_position_x(const Landmark& landmark) {
  if (landmark.coordinates == LandmarkCoordinates::cartesian) return Eigen::Matrix3d::Identity();
  const double depth_m = 1.0 / landmark.x.z();
  Eigen::Matrix3d d_p_A = depth_m * Eigen::Matrix3d::Identity();
  d_p_A.col(2) = -depth_m * depth_m * Eigen::Vector3d(landmark.x.x(), landmark.x.y(), 1.0);
  return landmark.X_WA.linear() * d_p_A;
}

/// Returns the Jacobian of a bearing with respect to the point in C. [Shah2009] eq. (4.19), with the axes of C.
Matrix23 d_bearing_p_C(const Eigen::Vector2d& bearing, double z_C_m) {
  Matrix23 jacobian;
  jacobian << Eigen::Matrix2d::Identity(), -bearing;
  return jacobian / z_C_m;
}

/// Returns the Jacobian of a bearing with respect to an error of the camera pose.
Matrix26 d_bearing_pose(const Eigen::Vector2d& bearing, const Matrix23& d_bearing_p) {
  const double x = bearing.x(), y = bearing.y();
  Matrix23 d_bearing_turn;
  d_bearing_turn << x * y, -(1.0 + x * x), y, 1.0 + y * y, -x * y, -x;
  Matrix26 jacobian;
  jacobian << -d_bearing_p, d_bearing_turn;
  return jacobian;
}

Eigen::Matrix2d noise_of(const Matrix26& d_pose, const CameraPose& pose, double bearing_sigma) {
  return bearing_sigma * bearing_sigma * Eigen::Matrix2d::Identity() +
         d_pose * error_covariance(pose) * d_pose.transpose();
}

}  // namespace

Eigen::Matrix<double, 6, 6> error_covariance(const CameraPose& pose) {
  Eigen::Matrix<double, 6, 1> sigmas;
  sigmas << Eigen::Vector3d::Constant(pose.position_sigma_m), Eigen::Vector3d::Constant(pose.attitude_sigma_rad);
  return sigmas.cwiseAbs2().asDiagonal();
}

Eigen::Vector3d position_W(const Landmark& landmark) {
  if (landmark.coordinates == LandmarkCoordinates::cartesian) return landmark.x;
  return landmark.X_WA * Eigen::Vector3d(Eigen::Vector3d(landmark.x.x(), landmark.x.y(), 1.0) / landmark.x.z());
}

Eigen::Matrix3d covariance_W(const Landmark& landmark) {
  const Eigen::Matrix3d jacobian = d_position_x(landmark);
  return jacobian * landmark.P * jacobian.transpose();
}

std::optional<PredictedBearing> predict_bearing(const Landmark& landmark, const CameraPose& pose,
                                                double bearing_sigma) {
  const Eigen::Matrix3d R_CW = pose.X_WC_est.linear().transpose();
  const Eigen::Vector3d p_C = R_CW * (position_W(landmark) - pose.X_WC_est.translation());
  constexpr double kMinDepthM = 1e-3;
  if (!(p_C.z() > kMinDepthM)) return std::nullopt;
  PredictedBearing seen;
  seen.bearing = p_C.head<2>() / p_C.z();
  const Matrix23 d_bearing_p = d_bearing_p_C(seen.bearing, p_C.z());
  const Eigen::Matrix3d d_p_C = R_CW * d_position_x(landmark);
  seen.d_bearing_x = d_bearing_p * d_p_C;
  seen.d_bearing_pose = d_bearing_pose(seen.bearing, d_bearing_p);
  // The effect of a camera shift is proportional to the inverse depth, which is uncertain. Its mean square is used,
  // because with the estimate alone, measurements of distant landmarks would gain weight and drive them to infinity.
  const double relative_sigma2 = d_p_C.row(2).dot(landmark.P * d_p_C.row(2).transpose()) / (p_C.z() * p_C.z());
  seen.d_bearing_pose.leftCols<3>() *= std::sqrt(1.0 + relative_sigma2);
  seen.noise = noise_of(seen.d_bearing_pose, pose, bearing_sigma);
  seen.d_bearing_pose.leftCols<3>() = -d_bearing_p;
  seen.covariance = seen.d_bearing_x * landmark.P * seen.d_bearing_x.transpose() + seen.noise;
  return seen;
}

Landmark predicted(const Landmark& landmark, double drift_m_rt_s, double dt_s) {
  Landmark later = landmark;
  const Eigen::Matrix3d to_x = d_position_x(landmark).inverse();
  later.P += drift_m_rt_s * drift_m_rt_s * dt_s * to_x * to_x.transpose();
  return later;
}

Landmark updated(const Landmark& landmark, const PredictedBearing& seen, const Eigen::Vector2d& bearing_meas) {
  const Eigen::Matrix<double, 3, 2> K =
      landmark.P * seen.d_bearing_x.transpose() * seen.covariance.inverse();  // eq. (4.15)
  Landmark better = landmark;
  better.x += K * (bearing_meas - seen.bearing);  // eq. (4.16)
  const Eigen::Matrix3d left = Eigen::Matrix3d::Identity() - K * seen.d_bearing_x;
  better.P = left * landmark.P * left.transpose() + K * seen.noise * K.transpose();  // eq. (4.17)
  if (better.coordinates == LandmarkCoordinates::inverse_depth) {
    constexpr double kMinInverseDepthPerM = 1e-4;  // 10 km; must remain positive
    better.x.z() = std::max(better.x.z(), kMinInverseDepthPerM);
  }
  return better;
}

double z_value(const PredictedBearing& seen, const Eigen::Vector2d& bearing_meas) {
  const Eigen::Vector2d d = bearing_meas - seen.bearing;  // eq. (4.7)
  const double J = d.squaredNorm();
  if (J == 0.0) return 0.0;
  const double C = 4.0 * d.dot(seen.covariance * d);  // eq. (4.5), (4.23), (4.24)
  return J * J / C;
}

Landmark first_seen(const Eigen::Vector2d& bearing_meas, const CameraPose& pose, double bearing_sigma,
                    const LandmarkStart& start) {
  Landmark landmark;
  landmark.coordinates = start.coordinates;
  landmark.X_WA = pose.X_WC_est;
  const Eigen::Vector3d ray_C(bearing_meas.x(), bearing_meas.y(), 1.0);
  const Eigen::Vector3d ray_W = pose.X_WC_est.linear() * ray_C;
  const double height_m = -pose.X_WC_est.translation().z();
  const bool meets_ground = ray_W.z() * start.beyond_horizon_m > height_m && height_m > 0.0;
  const double depth_m = meets_ground ? height_m / ray_W.z() : start.beyond_horizon_m;

  if (start.coordinates == LandmarkCoordinates::cartesian) {
    landmark.x = pose.X_WC_est.translation() + depth_m * ray_W;
    const double along_m = start.ground_sigma * depth_m;
    const double aside_m = depth_m * bearing_sigma;
    landmark.P = along_m * along_m * ray_W * ray_W.transpose() +
                 (aside_m * aside_m + pose.position_sigma_m * pose.position_sigma_m) * Eigen::Matrix3d::Identity();
    return landmark;
  }
  const double inverse_depth = 0.5 / start.nearest_m, sigma = 0.5 * inverse_depth;
  landmark.x = {bearing_meas.x(), bearing_meas.y(), inverse_depth};
  const Matrix23 d_bearing_p = d_bearing_p_C(bearing_meas, 1.0 / inverse_depth);
  landmark.P.topLeftCorner<2, 2>() = noise_of(d_bearing_pose(bearing_meas, d_bearing_p), pose, bearing_sigma);
  landmark.P(2, 2) = sigma * sigma;
  return landmark;
}

}  // namespace hedgehop::vision::landmarks
