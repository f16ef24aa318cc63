#pragma once

#include <Eigen/Core>

namespace hedgehop::vision::motion {

/// Motion of a camera between two images, with its error. Ck is the camera at the earlier image, the key image.
struct CameraMotion {
  Eigen::Matrix3d R_CCk = Eigen::Matrix3d::Identity();  ///< rotation of Ck in C
  Eigen::Vector3d p_CCk = Eigen::Vector3d::Zero();      ///< position of Ck in C, m
  double sigma_p_m = 0.0;                               ///< 1-sigma of p_CCk, per axis, >= 0
  double sigma_rad = 0.0;                               ///< 1-sigma of R_CCk, per axis, >= 0
};

/// Noise of the images and accuracy of a match.
struct MatchNoise {
  double grey = 1.4;      ///< 1-sigma of a pixel of the reduced image, grey levels, > 0
  double floor_px = 0.2;  ///< 1-sigma of a match on perfect texture, pixels of the reduced image, > 0
  double share = 0.02;    ///< additional 1-sigma, as a share of the displacement: windows on inclined surfaces, >= 0
};

/// Returns the displacement of a match in the key image per change of inverse depth.
/// @param ray_C  of the pixel, scaled to z = 1. @param per_m  inverse depth, 1/m. @param focal_px  focal length.
/// @return px m. Zero at the focus of expansion: depth there is not observable.
Eigen::Vector2d displacement(const Eigen::Vector3d& ray_C, const Eigen::Vector3d& p_CCk, double per_m, double focal_px);

/// Returns the variance of a match caused by grey noise, px^2: the Cramer-Rao bound for the squared difference of two
/// noisy images, 2 noise^2 / sum of squared gradients. Infinite without texture.
/// @param along_px  direction in which the match moves. @param gradients  sums of gx gx, gx gy, gy gy over the window,
/// grey levels^2 / px^2.
double noise_px2(const Eigen::Vector3d& gradients, const Eigen::Vector2d& along_px, const MatchNoise& noise);

/// Returns the 1-sigma error of an inverse depth, 1/m: errors of the match along the epipolar line and of the motion,
/// divided by the displacement per inverse depth. All errors are independent. Infinite at the focus of expansion.
/// @param per_m  inverse depth, 1/m. @param focal_px  focal length. @param gradients  as for noise_px2().
double sigma_of_inverse_depth(const Eigen::Vector3d& ray_C, const CameraMotion& motion, double per_m, double focal_px,
                              const Eigen::Vector3d& gradients, const MatchNoise& noise);

}  // namespace hedgehop::vision::motion
