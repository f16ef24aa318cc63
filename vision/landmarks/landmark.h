#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

/// One point of the world, estimated from the bearings under which a moving camera sees it: the extended Kalman filter
/// of [Shah2009] ch. 4. The thesis's camera frame has x along the optical axis; ours (C) has z forward, so its
/// (X_c, Y_c, Z_c) is our (z, x, y).
namespace hedgehop::vision::landmarks {

/// Which three numbers the filter keeps of a landmark.
enum class LandmarkCoordinates {
  cartesian,      ///< the point in W, m
  inverse_depth,  ///< bearing and inverse depth seen from where the landmark was first seen
};

/// An estimated point. Inverse depth is linear where depth is nearly unknown, so that its Gaussian stays honest.
struct Landmark {
  LandmarkCoordinates coordinates = LandmarkCoordinates::cartesian;
  Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity();  ///< estimated pose of the camera that saw it first
  Eigen::Vector3d x = Eigen::Vector3d::Zero();             ///< p_W, m; or (x_A / z_A, y_A / z_A, 1 / z_A), z_A > 0 in m
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();             ///< covariance of x
};

/// A landmark of a map, with its history.
struct MappedLandmark {
  int64_t id = 0;  ///< counted from 0 in the order in which the landmarks began
  Landmark landmark;
  int matches = 0;      ///< images in which it was seen, the first included
  int misses = 0;       ///< consecutive images that should have shown it and did not
  int passed_over = 0;  ///< such images between its first match and its last
};

/// The camera's estimated pose and its 1-sigma uncertainty.
struct CameraPose {
  Eigen::Isometry3d X_WC_est = Eigen::Isometry3d::Identity();
  double position_sigma_m = 0.0;    ///< per axis, >= 0
  double attitude_sigma_rad = 0.0;  ///< small rotations about each axis of C, >= 0
};

/// A landmark as the camera should see it.
struct PredictedBearing {
  Eigen::Vector2d bearing = Eigen::Vector2d::Zero();  ///< (x_C / z_C, y_C / z_C): the image plane at focal length 1
  Eigen::Matrix<double, 2, 3> d_bearing_x = Eigen::Matrix<double, 2, 3>::Zero();  ///< with respect to Landmark::x
  /// With respect to an error of the camera: shift of its position and small rotation, both along the axes of C.
  Eigen::Matrix<double, 2, 6> d_bearing_pose = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();  ///< R: a measured bearing's covariance, navigation errors included
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the residual: that and the landmark's own
};

/// Covariance of a camera's errors, shift and rotation, in the order of PredictedBearing::d_bearing_pose.
Eigen::Matrix<double, 6, 6> error_covariance(const CameraPose& pose);

/// Position in W, m.
Eigen::Vector3d position_W(const Landmark& landmark);
/// Covariance of that position, m^2; to first order for inverse depth.
Eigen::Matrix3d covariance_W(const Landmark& landmark);

/// Projects a landmark. @param bearing_sigma  of a measured bearing, per axis, at focal length 1, > 0.
/// @return nothing for a point that is not in front of the camera.
/// Source: [Shah2009] eq. (4.8) to (4.11), (4.19), (4.22). Differs: the Jacobian carries the rotation from W into the
/// camera (L_bv), which eq. (4.19) and (4.20) leave out in print; R also holds the navigation's errors, as a shift of
/// the camera cannot be told from a shift of the point.
std::optional<PredictedBearing> predict_bearing(const Landmark& landmark, const CameraPose& pose, double bearing_sigma);

/// Returns a landmark after a time without a measurement: the point stands still, its covariance grows.
/// @param drift_m_rt_s  growth of its standard deviation, m / sqrt(s), >= 0. @param dt_s  >= 0.
/// Source: [Shah2009] eq. (4.13), (4.14).
Landmark predicted(const Landmark& landmark, double drift_m_rt_s, double dt_s);

/// Returns a landmark corrected by a measured bearing. @param seen  predict_bearing() of this landmark.
/// Source: [Shah2009] eq. (4.15) to (4.17). Differs: the gain is taken from the projection's Jacobian, not from the
/// residual's, eq. (4.18), which is its negative: as printed, eq. (4.16) would push the point away from its
/// measurement. The covariance is updated in Joseph's form, which stays symmetric and positive.
Landmark updated(const Landmark& landmark, const PredictedBearing& seen, const Eigen::Vector2d& bearing_meas);

/// Z value of a measurement for a landmark: the squared residual's square over its variance, >= 0; 0 for no residual.
/// Small values indicate a match. Source: [Shah2009] eq. (4.5) to (4.7), (4.12), (4.23), (4.24).
double z_value(const PredictedBearing& seen, const Eigen::Vector2d& bearing_meas);

/// How new landmarks begin. No number of it is printed in the thesis.
struct LandmarkStart {
  LandmarkCoordinates coordinates = LandmarkCoordinates::inverse_depth;
  double ground_sigma = 0.3;        ///< of a start on the ground: of the depth, as a share of it, > 0
  double nearest_m = 20.0;          ///< of a start by inverse depth, > 0
  double beyond_horizon_m = 150.0;  ///< depth where a ray does not meet the ground nearer, > 0
};

/// Returns a landmark from its first bearing. Cartesian: where the ray meets the ground (z = 0 in W), [Shah2009] sec.
/// "3D Modeling Algorithm". Inverse depth, not in the thesis: evenly between `nearest_m` and infinity, to two standard
/// deviations.
Landmark first_seen(const Eigen::Vector2d& bearing_meas, const CameraPose& pose, double bearing_sigma,
                    const LandmarkStart& start);

}  // namespace hedgehop::vision::landmarks
