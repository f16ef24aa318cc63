#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::vision::camera {

/// Shows images of one camera as they would be, had it not turned. A corner's surroundings then keep their shape, and
/// it is found better than when rays are turned afterwards: a window near a fisheye's rim turns with the vehicle.
class ImageDerotator {
 public:
  /// @param wanted  CV_8UC1, of the camera's size: pixels to be shown where it is not 0.
  ImageDerotator(const Camera& camera, const cv::Mat& wanted);

  /// @param image  CV_8UC1, taken by C2. @param R_C1C2  rotation of C2 in C1, the camera not turned.
  /// @return what C1 would see of things infinitely far, 0 where `image` shows nothing of it or nothing is wanted.
  /// Source: [Zingg2010] eq. (5). Differs: turns the rays of all pixels, before corners are followed.
  cv::Mat derotate(const cv::Mat& image, const Eigen::Matrix3d& R_C1C2) const;

 private:
  struct Ray {
    int row, col;
    Eigen::Vector3d ray_C;
  };
  Camera camera_;
  cv::Rect box_;  ///< holds all that is wanted
  std::vector<Ray> rays_;
};

}  // namespace hedgehop::vision::camera
