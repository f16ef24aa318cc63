#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/camera/pinhole_camera.h"
#include "vision/motion/match_error.h"

namespace hedgehop::vision::motion {

/// Inverse depth with its uncertainty, at half the resolution of the camera.
struct InverseDepth {
  cv::Mat per_m;        ///< CV_32FC1, 1 / z in C, 1/m, >= 0; NaN if unmatched
  cv::Mat sigma_per_m;  ///< CV_32FC1, 1-sigma of it, 1/m; NaN if unmatched
};

/// Computes depth from two images of one moving pinhole camera by a plane sweep: the derotated key image is compared
/// with the current one for planes z = constant in C, equally spaced in inverse depth: [Collins1996] p. 358. Such a
/// plane only scales and shifts the image. Windows therefore keep their size next to the focus of expansion, unlike
/// those of an epipolar rectification.
/// - Images have half of the camera's resolution, less a local mean, because vignetting changes the brightness of a
///   point that moves through the image.
/// - A match is rejected if another depth costs about the same, or if a cheaper match covers its place in the key
/// image. Differs: absolute instead of squared differences, and uncertainty from texture and motion.
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

 private:
  static constexpr int kPlanes = 64;  ///< in front of the camera
  static constexpr int kBeyond = 4;   ///< behind infinity, to interpolate there
  static constexpr int kSides = kHalfWindowPx / kReduction;
  static constexpr uint8_t kOutside = 255;

  size_t pixels() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }
  Eigen::Vector3d ray_C(int u, int v) const { return {(u - center_u_) / focal_, (v - center_v_) / focal_, 1.0}; }
  double inverse_depth(int plane) const { return (plane - kBeyond) * step_per_m_; }
  double spacing_per_m(const Eigen::Vector3d& p_CCk) const;
  void derotate(const cv::Mat& key, const Eigen::Matrix3d& R_CCk, cv::Mat& derotated, cv::Mat& valid) const;
  void sum_gradients(const cv::Mat& detail);
  void compare(const cv::Mat& current, const cv::Mat& key, const Eigen::Vector3d& p_CCk, int plane);
  void find_best();
  void find_second(const Eigen::Vector3d& p_CCk);
  void find_covered(const Eigen::Vector3d& p_CCk, const cv::Mat& valid);
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
