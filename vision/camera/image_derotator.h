#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::vision::camera {

/// Resamples images of a camera to those of a camera that did not rotate. A corner's window then keeps its shape, and
/// tracking succeeds more often than with rays rotated afterward, because near a fisheye's rim the window rotates with
/// the vehicle. Source pixels are computed for every fourth row and column and interpolated linearly. The error is
/// below 4 px times the rotation divided by the focal length in pixels: 0.003 px at 0.1 rad and 145 px.
class ImageDerotator {
 public:
  /// @param mask  CV_8UC1, of the camera's size: not 0 at the pixels to compute.
  ImageDerotator(const Camera& camera, const cv::Mat& mask);

  /// Returns the image that C1 would take of points at infinity; 0 outside the mask and at points outside `image`.
  /// @param image  CV_8UC1, taken by C2. @param R_C1C2  rotation of C2 in C1, the camera that did not rotate.
  /// Source: [Zingg2010] eq. (5). Differs: rotates the rays of all pixels, before corners are tracked.
  cv::Mat derotate(const cv::Mat& image, const Eigen::Matrix3d& R_C1C2) const;

  /// Returns for each pixel of C1 in the mask the corresponding pixel of C2: CV_32FC2 of box()'s size, px. All other
  /// entries are far outside the image.
  cv::Mat source_pixels(const Eigen::Matrix3d& R_C1C2) const;
  const cv::Rect& box() const { return box_; }  ///< bounding box of the mask

 private:
  struct Ray {
    int row, col;
    Eigen::Vector3d ray_C;
  };
  Camera camera_;
  cv::Rect box_;
  std::vector<Ray> rays_;  ///< of the pixels in the mask, row by row
  cv::Size nodes_;
  std::vector<Eigen::Vector3d> node_rays_;  ///< of every fourth row and column of the box; NaN without a ray
};

}  // namespace hedgehop::vision::camera
