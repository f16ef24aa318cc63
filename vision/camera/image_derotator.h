#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::vision::camera {

/// Resamples images of one camera to those of a camera that did not rotate. A corner's window then keeps its shape, and
/// tracking it succeeds more often than when rays are rotated afterwards: near a fisheye's rim the window rotates with
/// the vehicle. Where pixels lie is computed for every fourth row and column, and is linear in between: off by less
/// than 4 px times the turn over the focal length in pixels, 0.003 px at 0.1 rad and 145 px.
class ImageDerotator {
 public:
  /// @param wanted  CV_8UC1, of the camera's size: not 0 at the pixels to compute.
  ImageDerotator(const Camera& camera, const cv::Mat& wanted);

  /// Returns the image that C1 would take of points infinitely far; 0 where `image` does not show them or no pixel is
  /// wanted. @param image  CV_8UC1, taken by C2. @param R_C1C2  rotation of C2 in C1, the camera that did not rotate.
  /// Source: [Zingg2010] eq. (5). Differs: rotates the rays of all pixels, before corners are tracked.
  cv::Mat derotate(const cv::Mat& image, const Eigen::Matrix3d& R_C1C2) const;

  /// Where C2 shows what C1 shows at the pixels wanted: CV_32FC2 of box()'s size, px; far outside the image elsewhere.
  cv::Mat places(const Eigen::Matrix3d& R_C1C2) const;
  const cv::Rect& box() const { return box_; }  ///< holds all that is wanted

 private:
  struct Ray {
    int row, col;
    Eigen::Vector3d ray_C;
  };
  Camera camera_;
  cv::Rect box_;
  std::vector<Ray> rays_;  ///< of the pixels wanted, row by row
  cv::Size nodes_;
  std::vector<std::optional<Eigen::Vector3d>> node_rays_;  ///< of every fourth row and column of the box
};

}  // namespace hedgehop::vision::camera
