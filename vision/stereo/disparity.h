#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>

namespace hedgehop::vision::stereo {

// A disparity image refers to the left of two rectified cameras: CV_16SC1, disparity x 16; 0: infinitely far; negative:
// unknown. [Andert2007] eq. (4). Differs from eq. (2) in sign: disparity is x_left - x_right.
inline constexpr double kDisparityUnits = 16.0;  ///< per pixel
inline constexpr int16_t kNoDisparity = -1;

/// Two rectified undistorted pinhole cameras side by side. Frame C is that of the left one.
struct StereoGeometry {
  double focal_px = 0.0;  ///< > 0
  double center_u_px = 0.0, center_v_px = 0.0;
  double baseline_m = 0.0;  ///< > 0

  /// Returns z in C of a disparity, m; +infinity for 0. [Andert2007] eq. (3).
  double z_m(int disparity16) const { return kDisparityUnits * baseline_m * focal_px / disparity16; }
  /// Returns the disparity x 16, not rounded, of a depth z > 0 in C, m.
  double disparity16(double z_m) const { return kDisparityUnits * baseline_m * focal_px / z_m; }
  /// Returns the ray of a pixel in C, scaled to z = 1. [Andert2007] eq. (9).
  Eigen::Vector3d ray_at_unit_depth(const cv::Point& pixel) const {
    return {(pixel.x - center_u_px) / focal_px, (pixel.y - center_v_px) / focal_px, 1.0};
  }
};

/// Converts disparity to depth: CV_32FC1, z in C, m; +infinity for 0, NaN if unknown.
void to_depth(const cv::Mat& disparity16, const StereoGeometry& geometry, cv::Mat& depth_m);

/// Marks segments with fewer than `smallest_px` pixels as unknown. Adjacent pixels (8-connected) belong to one segment
/// if their disparities differ by less than `difference16`.
/// @return number of pixels removed. Source: [Andert2007] sec. 3.3.1, eq. (5).
int remove_specks(cv::Mat& disparity16, int difference16, int smallest_px);

/// Marks pixels so close to an area without matches that their disparity may belong to the other surface: if one half
/// of the matcher's window is untextured, the other half determines the match.
/// @param half_window_px  half the side of the window, >= 0. @param smeared  CV_8UC1, 255 at such pixels, otherwise 0.
void find_smeared(const cv::Mat& disparity16, int half_window_px, cv::Mat& smeared);

/// Pixels that are tested for sky.
enum class SkyAmong {
  unknown,  ///< as published: unmatched pixels
  all,      ///< all, because a semi-global matcher extends a tree's disparity into the sky
};
/// Sets bright pixels without texture to infinitely far, except in column 0.
/// @param grey  CV_8UC1, the left image. @return number of sky pixels. Source: [Andert2007] eq. (6) to (8).
int mark_sky(const cv::Mat& grey, int texture, int brightness, SkyAmong among, cv::Mat& disparity16);

}  // namespace hedgehop::vision::stereo
