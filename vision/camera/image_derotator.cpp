#include "vision/camera/image_derotator.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace hedgehop::vision::camera {

ImageDerotator::ImageDerotator(const Camera& camera, const cv::Mat& wanted)
    : camera_(camera), box_(cv::boundingRect(wanted)) {
  if (wanted.size() != cv::Size(camera.width_px, camera.height_px)) {
    throw std::invalid_argument("what is wanted differs from the camera's size");
  }
  for (int row = box_.y; row < box_.br().y; ++row) {
    for (int col = box_.x; col < box_.br().x; ++col) {
      if (!wanted.at<uint8_t>(row, col)) continue;
      if (const auto ray_C = camera.ray({col, row})) rays_.push_back({row, col, *ray_C});
    }
  }
}

cv::Mat ImageDerotator::derotate(const cv::Mat& image, const Eigen::Matrix3d& R_C1C2) const {
  cv::Mat result = cv::Mat::zeros(image.size(), CV_8UC1);
  if (box_.empty()) return result;
  // So far outside that no pixel of the image has a share: OpenCV then needs no arithmetic.
  constexpr double kOutside = -100.0;
  cv::Mat places(box_.size(), CV_32FC2, cv::Scalar::all(kOutside));
  const Eigen::Matrix3d R_C2C1 = R_C1C2.transpose();
  for (const Ray& ray : rays_) {
    const auto pixel = camera_.project(R_C2C1 * ray.ray_C);
    if (!pixel) continue;
    places.at<cv::Vec2f>(ray.row - box_.y, ray.col - box_.x) = {static_cast<float>(pixel->x()),
                                                                static_cast<float>(pixel->y())};
  }
  cv::Mat shown = result(box_);
  cv::remap(image, shown, places, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return result;
}

}  // namespace hedgehop::vision::camera
