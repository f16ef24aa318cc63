#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

// Joint estimation of the poses of a moving camera and of the points that it observes, from all images of a flight.
namespace hedgehop::vision::landmarks {

/// A measured bearing of a point at focal length 1.
struct BundleBearing {
  size_t point = 0;  ///< index of the point
  Eigen::Vector2d bearing = Eigen::Vector2d::Zero();
};

/// An image of a bundle: its bearings, the navigation's estimates, and the pose that is to be estimated.
struct BundleFrame {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();      ///< estimated pose of the body
  Eigen::Isometry3d X_WB_nav = Eigen::Isometry3d::Identity();  ///< pose according to the navigation
  Eigen::Vector3d step_W = Eigen::Vector3d::Zero();  ///< displacement since the previous frame, integrated velocity, m
  Eigen::Matrix3d turn_B = Eigen::Matrix3d::Identity();  ///< rotation since the previous frame: its R_WB times `turn_B`
  double dt_s = 0.0;                                     ///< since the previous frame, > 0; not used in the first frame
  std::vector<BundleBearing> bearings;
};

/// Standard deviations of the errors, each per axis, > 0.
struct BundleNoise {
  double bearing = 0.0;        ///< of a bearing, at focal length 1
  double position_m = 0.0;     ///< of the navigation's position, independent between frames
  double attitude_rad = 0.0;   ///< of its attitude, independent between frames
  double step_m_rt_s = 0.0;    ///< of a displacement over the root of its duration, m / sqrt(s)
  double turn_rad_rt_s = 0.0;  ///< of a rotation over the root of its duration, rad / sqrt(s)
};

/// The result of adjust_bundle().
struct BundleResult {
  double cost = 0.0;  ///< half the sum of squared residuals over their sigmas, with Huber's loss for bearings
  std::vector<Eigen::Matrix3d> covariances_W;  ///< of each point, including the uncertainty of the poses, m^2
};

/// Moves the poses of frames and the points to a minimum of the cost. Levenberg's and Marquardt's method; the poses are
/// eliminated first, because their equations are block tridiagonal, which leaves a dense system of the points. Single
/// thread; the sums have a fixed order, so the result is equal on all processors.
/// @param frames  at least one, in order of time. @param points_W  m, in front of the cameras that observe them; each
/// observed. @param X_BC  pose of the camera in the body. @param iterations  maximum number of steps, >= 0.
/// Source: [Triggs2000] sec. 4.3 (method), 6.1 (elimination), 3.3 (robust loss).
BundleResult adjust_bundle(std::span<BundleFrame> frames, std::span<Eigen::Vector3d> points_W,
                           const Eigen::Isometry3d& X_BC, const BundleNoise& noise, int iterations);

/// A bearing of a point and its Jacobians with respect to the point, and to the body's pose: translation and small
/// rotation, both along the axes of W, the latter applied to the left of R_WB.
struct BundleProjection {
  Eigen::Vector2d bearing = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 3> d_point = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Matrix<double, 2, 6> d_pose = Eigen::Matrix<double, 2, 6>::Zero();
  double depth_m = 0.0;  ///< z in C; the other members are valid if it is above kMinBundleDepthM
};
inline constexpr double kMinBundleDepthM = 0.1;
BundleProjection project_point(const Eigen::Vector3d& p_W, const Eigen::Isometry3d& X_WB,
                               const Eigen::Isometry3d& X_BC);

}  // namespace hedgehop::vision::landmarks
