#include "vision/corridor/corridor_regions.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "sim/fields/bounds.h"

namespace hedgehop::vision::corridor {
namespace {

std::optional<Region> region_of(const Eigen::Vector3d& ray_B, const CorridorRegions& regions) {
  const double elevation_rad = std::atan2(-ray_B.z(), ray_B.head<2>().norm());
  if (elevation_rad < regions.lowest_rad || elevation_rad > regions.highest_rad) return std::nullopt;
  const double azimuth_rad = std::atan2(ray_B.y(), ray_B.x()), aside_rad = std::abs(azimuth_rad);
  if (aside_rad < regions.ahead_rad) return kAhead;
  if (aside_rad > regions.ahead_rad + regions.segment_rad) return std::nullopt;
  return azimuth_rad < 0.0 ? kLeft : kRight;
}

}  // namespace

std::array<cv::Mat, kRegions> region_masks(const camera::Camera& camera, const Eigen::Isometry3d& X_BC,
                                           const CorridorRegions& regions, int rim_px) {
  fields::require_bounds(regions);
  if (!(regions.lowest_rad < regions.highest_rad)) {
    throw std::invalid_argument("highest: must be above the lowest elevation");
  }
  std::array<cv::Mat, kRegions> masks;
  for (cv::Mat& mask : masks) mask = cv::Mat::zeros(camera.height_px, camera.width_px, CV_8UC1);
  cv::Mat shown = cv::Mat::zeros(camera.height_px, camera.width_px, CV_8UC1);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const auto ray_C = camera.unit_ray({u, v});
      if (!ray_C) continue;
      shown.at<uint8_t>(v, u) = 255;
      const auto region = region_of(X_BC.linear() * *ray_C, regions);
      if (region) masks[*region].at<uint8_t>(v, u) = 255;
    }
  }
  const cv::Mat window = cv::Mat::ones(2 * rim_px + 1, 2 * rim_px + 1, CV_8UC1);
  cv::erode(shown, shown, window, cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  for (cv::Mat& mask : masks) cv::bitwise_and(mask, shown, mask);
  return masks;
}

}  // namespace hedgehop::vision::corridor
