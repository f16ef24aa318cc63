#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/camera/pinhole_camera.h"

namespace hedgehop::vision::motion {

/// Motion of a camera between two images, with its error. K is the camera at the earlier image, the key image.
struct CameraMotion {
  Eigen::Matrix3d R_CK = Eigen::Matrix3d::Identity();  ///< rotation of K in C
  Eigen::Vector3d p_CK = Eigen::Vector3d::Zero();      ///< position of K in C, m
  double sigma_p_m = 0.0;                              ///< 1-sigma of p_CK, per axis, >= 0
  double sigma_rad = 0.0;                              ///< 1-sigma of R_CK, per axis, >= 0
};

/// Noise of the images and accuracy of a match.
struct MatchNoise {
  double grey = 1.4;      ///< 1-sigma of a pixel of the reduced image, grey levels, > 0
  double floor_px = 0.15;  ///< 1-sigma of a match on perfect texture, pixels of the reduced image, > 0
  double share = 0.02;   ///< additional 1-sigma, as a share of the displacement: windows on inclined surfaces, >= 0
};

/// Inverse depth with its uncertainty, at half the resolution of the camera.
struct InverseDepth {
  cv::Mat per_m;        ///< CV_32FC1, 1 / z in C, 1/m, >= 0; NaN if unmatched
  cv::Mat sigma_per_m;  ///< CV_32FC1, 1-sigma of it, 1/m; NaN if unmatched
};

/// Returns the displacement of a match in the key image per change of inverse depth.
/// @param ray_C  of the pixel, scaled to z = 1. @param per_m  inverse depth, 1/m. @param focal_px  focal length.
/// @return px m. Zero at the focus of expansion, where depth is not observable.
Eigen::Vector2d displacement(const Eigen::Vector3d& ray_C, const Eigen::Vector3d& p_CK, double per_m, double focal_px);

/// Returns the 1-sigma error of an inverse depth, 1/m: errors of the match along the epipolar line and of the motion,
/// divided by the displacement per inverse depth. Both errors are independent. A match that minimizes the squared
/// difference of noisy images errs by sqrt(2 noise^2 / sum of squared gradients), the Cramer-Rao bound.
/// @param gradients  sums of gx gx, gx gy, gy gy over the window, grey levels^2 / px^2.
/// Infinite at the focus of expansion and without texture.
double sigma_of_inverse_depth(const Eigen::Vector3d& ray_C, const CameraMotion& motion, double per_m, double focal_px,
                              const Eigen::Vector3d& gradients, const MatchNoise& noise);

/// Computes depth from two images of one moving pinhole camera by a plane sweep: the derotated key image is compared
/// with the current one for planes z = constant in C, equally spaced in inverse depth: [Collins1996] sec. 3. Such a
/// plane only scales and shifts the image, so windows keep their size next to the focus of expansion, where an
/// epipolar rectification would not.
/// - Images have half of the camera's resolution, less a local mean, because vignetting changes the brightness of a
///   point that moves through the image.
/// - A match is rejected if another depth costs about the same, or if a cheaper match covers its place in the key image.
/// Differs: absolute instead of squared differences, and uncertainty from texture and motion.
class PlaneSweep {
 public:
  static constexpr int kReduction = 2;     ///< of the resolution
  static constexpr int kHalfWindowPx = 8;  ///< half the side of the window, pixels of the camera

  /// @param camera  undistorted, of even size. Throws std::invalid_argument on other sizes or unequal focal lengths.
  PlaneSweep(const camera::PinholeCamera& camera, const MatchNoise& noise);

  /// Returns the sum over the four pixels to the right of and below each pixel, divided by four; CV_8UC1 of equal size.
  /// Key images are stored like this. @param grey  CV_8UC1 of the camera's size.
  static cv::Mat smooth(const cv::Mat& grey);

  /// Returns an image without matches.
  InverseDepth none() const;
  /// @param current, key  smooth() images. @return none() if the camera did not move.
  InverseDepth match(const cv::Mat& current, const cv::Mat& key, const CameraMotion& motion);

  /// Returns the maximum inverse depth that match() finds, 1/m.
  double reach_per_m(const Eigen::Vector3d& p_CK) const { return kPlanes * spacing_per_m(p_CK); }

 private:
  static constexpr int kPlanes = 64;    ///< in front of the camera
  static constexpr int kBeyond = 4;     ///< behind infinity, to interpolate there
  static constexpr int kSides = kHalfWindowPx / kReduction;
  static constexpr uint8_t kOutside = 255;

  struct Sampling;
  size_t pixels() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }
  Eigen::Vector3d ray_C(int u, int v) const { return {(u - center_u_) / focal_, (v - center_v_) / focal_, 1.0}; }
  double inverse_depth(int plane) const { return (plane - kBeyond) * step_per_m_; }
  double spacing_per_m(const Eigen::Vector3d& p_CK) const;
  void derotate(const cv::Mat& key, const Eigen::Matrix3d& R_CK, cv::Mat& derotated, cv::Mat& valid) const;
  void sum_gradients(const cv::Mat& detail);
  void compare(const cv::Mat& current, const cv::Mat& key, const Eigen::Vector3d& p_CK, int plane);
  void find_best();
  void find_second(const Eigen::Vector3d& p_CK);
  void find_covered(const Eigen::Vector3d& p_CK, const cv::Mat& valid);
  double interpolate(size_t pixel, int reach) const;

  int width_, height_;  ///< of the reduced image
  double focal_, center_u_, center_v_;
  MatchNoise noise_;
  double step_per_m_ = 0.0;
  std::vector<int16_t> costs_;  ///< plane by plane
  std::vector<int16_t> best_, best_plane_, second_, first_near_, last_near_, key_cost_, key_plane_;
  std::vector<uint8_t> matched_;
  std::vector<int16_t> reach_;
  cv::Mat gradients_;  ///< CV_32FC3: sums of gx gx, gx gy, gy gy
};

}  // namespace hedgehop::vision::motion
