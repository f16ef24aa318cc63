#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

// Estimation of a fixed point from its bearings in the images of a moving camera: the extended Kalman filter of
// [Shah2009] ch. 4. The thesis's camera frame has x along the optical axis, ours (C) has z forward, so its
// (X_c, Y_c, Z_c) is our (z, x, y).
namespace hedgehop::vision::landmarks {

/// The three state variables of a landmark.
enum class LandmarkCoordinates {
  cartesian,      ///< the point in W, m
  inverse_depth,  ///< bearing and inverse depth from the position of the first observation
};

/// An estimated point. The measurement is nearly linear in inverse depth, even if the depth is almost unknown. The
/// Gaussian approximation therefore remains valid.
struct Landmark {
  LandmarkCoordinates coordinates = LandmarkCoordinates::cartesian;
  Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity();  ///< estimated camera pose at the first observation
  Eigen::Vector3d x = Eigen::Vector3d::Zero();             ///< p_W, m; or (x_A / z_A, y_A / z_A, 1 / z_A), z_A > 0 in m
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();             ///< covariance of x
};

/// A landmark of a map, with its history.
struct MappedLandmark {
  int64_t id = 0;  ///< from 0, in the order of initialization
  Landmark landmark;
  int matches = 0;        ///< number of images in which it was matched, including the first
  int misses = 0;         ///< consecutive images with it in view, but without a match
  int passed_over = 0;    ///< such images between its first and last match
  bool rejected = false;  ///< it is not a fixed point, according to the adjustment of all images (landmark_bundle.h)
};

/// The camera's estimated pose and its 1-sigma uncertainty.
struct CameraPose {
  Eigen::Isometry3d X_WC_est = Eigen::Isometry3d::Identity();
  double position_sigma_m = 0.0;    ///< per axis, >= 0
  double attitude_sigma_rad = 0.0;  ///< small rotations about each axis of C, >= 0
};

/// The predicted bearing of a landmark in an image.
struct PredictedBearing {
  Eigen::Vector2d bearing = Eigen::Vector2d::Zero();  ///< (x_C / z_C, y_C / z_C): the image plane at focal length 1
  Eigen::Matrix<double, 2, 3> d_bearing_x = Eigen::Matrix<double, 2, 3>::Zero();  ///< with respect to Landmark::x
  /// With respect to an error of the camera pose: translation and small rotation, both along the axes of C.
  Eigen::Matrix<double, 2, 6> d_bearing_pose = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Matrix2d noise =
      Eigen::Matrix2d::Zero();  ///< R: covariance of a measured bearing, including navigation errors
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the residual: noise plus the landmark's own
};

/// Returns the covariance of a camera's errors, translation and rotation, in the order of
/// PredictedBearing::d_bearing_pose.
Eigen::Matrix<double, 6, 6> error_covariance(const CameraPose& pose);

/// Returns the position in W, m.
Eigen::Vector3d position_W(const Landmark& landmark);
/// Returns the covariance of that position, m^2; to first order for inverse depth.
Eigen::Matrix3d covariance_W(const Landmark& landmark);

/// Returns the predicted bearing of a landmark; std::nullopt if it is not in front of the camera.
/// @param bearing_sigma  of a measured bearing, per axis, at focal length 1, > 0.
/// Source: [Shah2009] eq. (4.8) to (4.11), (4.19), (4.22). Differs: the Jacobian includes the rotation from W to the
/// camera (L_bv), which the printed eq. (4.19) and (4.20) omit; R also includes the navigation errors, because a shift
/// of the camera is indistinguishable from a shift of the point.
std::optional<PredictedBearing> predict_bearing(const Landmark& landmark, const CameraPose& pose, double bearing_sigma);

/// Returns a landmark after a time without measurements: the point is fixed, its covariance grows.
/// @param drift_m_rt_s  growth of its standard deviation, m / sqrt(s), >= 0. @param dt_s  >= 0.
/// Source: [Shah2009] eq. (4.13), (4.14).
Landmark predicted(const Landmark& landmark, double drift_m_rt_s, double dt_s);

/// Returns a landmark corrected by a measured bearing. @param seen  predict_bearing() of this landmark.
/// Source: [Shah2009] eq. (4.15) to (4.17). Differs: the gain uses the Jacobian of the projection instead of that of
/// the residual, eq. (4.18), which is its negative. The printed eq. (4.16) would move the point away from its
/// measurement. The covariance is updated in Joseph form, which remains symmetric and positive definite.
Landmark updated(const Landmark& landmark, const PredictedBearing& seen, const Eigen::Vector2d& bearing_meas);

/// Returns the Z value of a measurement for a landmark: the square of the squared residual over its variance, >= 0; 0
/// without residual. Small values indicate a match. Source: [Shah2009] eq. (4.5) to (4.7), (4.12), (4.23), (4.24).
double z_value(const PredictedBearing& seen, const Eigen::Vector2d& bearing_meas);

/// Initialization of landmarks. The thesis gives no values.
struct LandmarkStart {
  LandmarkCoordinates coordinates = LandmarkCoordinates::inverse_depth;
  double ground_sigma = 0.3;        ///< for a start on the ground: relative standard deviation of depth, > 0
  double nearest_m = 20.0;          ///< for a start by inverse depth, > 0
  double beyond_horizon_m = 150.0;  ///< depth if the ray does not meet the ground within it, > 0
};

/// Returns a landmark initialized from its first bearing. Cartesian: at the intersection of the ray with the ground (z
/// = 0 in W), [Shah2009] sec. "3D Modeling Algorithm". Inverse depth, not in the thesis: `nearest_m` and infinity are
/// two standard deviations from the mean.
Landmark first_seen(const Eigen::Vector2d& bearing_meas, const CameraPose& pose, double bearing_sigma,
                    const LandmarkStart& start);

}  // namespace hedgehop::vision::landmarks
