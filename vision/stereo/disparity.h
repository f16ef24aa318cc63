#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace hedgehop::vision::stereo {

// A disparity image belongs to the left of two rectified cameras: CV_16SC1, disparity x 16; 0 infinitely far;
// negative where nothing is known. [Andert2007] eq. (4). Differs from eq. (2) in sign: disparity is x_left - x_right.
inline constexpr double kDisparityUnits = 16.0;  ///< per pixel
inline constexpr int16_t kNoDisparity = -1;

/// Two rectified undistorted pinholes side by side. Frame C is the left one's.
struct StereoGeometry {
  double focal_px = 0.0;  ///< > 0
  double center_u_px = 0.0, center_v_px = 0.0;
  double baseline_m = 0.0;  ///< > 0

  /// z in C of a disparity, m; +infinity for 0. [Andert2007] eq. (3).
  double z_m(int disparity16) const { return kDisparityUnits * baseline_m * focal_px / disparity16; }
  /// The disparity, x 16 and not rounded, of a distance z > 0 in C, m.
  double disparity16(double z_m) const { return kDisparityUnits * baseline_m * focal_px / z_m; }
  /// Direction of a pixel in C, scaled to z = 1. [Andert2007] eq. (9).
  Eigen::Vector3d ray_at_unit_depth(const cv::Point& pixel) const {
    return {(pixel.x - center_u_px) / focal_px, (pixel.y - center_v_px) / focal_px, 1.0};
  }
};

/// Turns disparity into depth: CV_32FC1, z in C, m; +infinity for 0, NaN where nothing is known.
void to_depth(const cv::Mat& disparity16, const StereoGeometry& geometry, cv::Mat& depth_m);

/// Marks segments smaller than `smallest_px` pixels as unknown. Neighbors, of eight, belong together when their
/// disparities differ by less than `difference16`; unknown pixels belong to none.
/// @return pixels removed. Source: [Andert2007] sec. 3.3.1, eq. (5).
int remove_specks(cv::Mat& disparity16, int difference16, int smallest_px);

/// Which pixels are tested for sky.
enum class SkyAmong {
  unknown,  ///< as printed: where the matcher found nothing
  all,      ///< also where it did: a semi-global matcher extends a tree's disparity across the untextured sky
};
/// Makes pixels that are bright and without texture infinitely far; column 0 is left as it is.
/// @param grey  CV_8UC1, the left image. @return pixels found to be sky. Source: [Andert2007] eq. (6) to (8).
int mark_sky(const cv::Mat& grey, int texture, int brightness, SkyAmong among, cv::Mat& disparity16);

}  // namespace hedgehop::vision::stereo
