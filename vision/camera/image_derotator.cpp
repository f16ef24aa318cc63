#include "vision/camera/image_derotator.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace hedgehop::vision::camera {

constexpr int kNodePx = 4;

ImageDerotator::ImageDerotator(const Camera& camera, const cv::Mat& mask)
    : camera_(camera), box_(cv::boundingRect(mask)) {
  if (mask.size() != cv::Size(camera.width_px, camera.height_px)) {
    throw std::invalid_argument("the mask differs from the camera's image size");
  }
  nodes_ = {(box_.width + kNodePx - 1) / kNodePx + 1, (box_.height + kNodePx - 1) / kNodePx + 1};
  for (int row = 0; row < nodes_.height; ++row) {
    for (int col = 0; col < nodes_.width; ++col) {
      const auto ray_C = camera.unit_ray({box_.x + col * kNodePx, box_.y + row * kNodePx});
      node_rays_.push_back(ray_C.value_or(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())));
    }
  }
  for (int row = box_.y; row < box_.br().y; ++row) {
    for (int col = box_.x; col < box_.br().x; ++col) {
      if (!mask.at<uint8_t>(row, col)) continue;
      if (const auto ray_C = camera.unit_ray({col, row})) rays_.push_back({row, col, *ray_C});
    }
  }
}

cv::Mat ImageDerotator::source_pixels(const Eigen::Matrix3d& R_C1C2) const {
  // Far enough outside that OpenCV does not interpolate.
  constexpr double kOutside = -100.0;
  cv::Mat places(box_.size(), CV_32FC2, cv::Scalar::all(kOutside));
  const Eigen::Matrix3d R_C2C1 = R_C1C2.transpose();
  std::vector<Eigen::Vector3d> rays_C2;
  rays_C2.reserve(node_rays_.size());
  for (const Eigen::Vector3d& ray_C1 : node_rays_) rays_C2.emplace_back(R_C2C1 * ray_C1);
  const std::vector<Eigen::Vector2d> nodes = camera_.project_each(rays_C2);
  const auto columns = static_cast<size_t>(nodes_.width);
  std::vector<Eigen::Vector2d> line(columns);  // nodes of one row of pixels
  int line_row = -1;
  for (const Ray& ray : rays_) {
    const int row = ray.row - box_.y, col = ray.col - box_.x;
    if (row != line_row) {
      line_row = row;
      const Eigen::Vector2d* above = nodes.data() + static_cast<size_t>(row / kNodePx) * columns;
      const double below = (row % kNodePx) / double{kNodePx};
      for (size_t i = 0; i < columns; ++i) line[i] = above[i] + below * (above[i + columns] - above[i]);
    }
    const auto left = static_cast<size_t>(col / kNodePx);
    Eigen::Vector2d place = line[left] + (col % kNodePx) / double{kNodePx} * (line[left + 1] - line[left]);
    if (std::isnan(place.x())) {  // next to the border of the image circle
      const auto pixel = camera_.project(R_C2C1 * ray.ray_C);
      if (!pixel) continue;
      place = *pixel;
    }
    places.at<cv::Vec2f>(row, col) = {static_cast<float>(place.x()), static_cast<float>(place.y())};
  }
  return places;
}

cv::Mat ImageDerotator::derotate(const cv::Mat& image, const Eigen::Matrix3d& R_C1C2) const {
  cv::Mat result = cv::Mat::zeros(image.size(), CV_8UC1);
  if (box_.empty()) return result;
  cv::Mat shown = result(box_);
  cv::remap(image, shown, source_pixels(R_C1C2), cv::noArray(), cv::INTER_CUBIC, cv::BORDER_CONSTANT,
            cv::Scalar::all(0));
  return result;
}

}  // namespace hedgehop::vision::camera
