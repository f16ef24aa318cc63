#include "vision/flow/feature_flow.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"
#include "vision/flow/corner_tracker.h"
#include "vision/opencv_library.h"

namespace hedgehop::vision::flow {

namespace {

void check(const FeatureFlowConfig& c) {
  fields::require_bounds(c);
  if (c.window_px % 2 == 0) throw fields::InvalidField("window", "must be odd");
}

/// Returns the strongest corners of a region, strongest first.
std::vector<cv::Point2f> corners(const cv::Mat& image, const cv::Mat& region, const FeatureFlowConfig& config) {
  const cv::Rect box = cv::boundingRect(region);
  std::vector<cv::Point2f> found;
  if (box.empty()) return found;
  std::vector<float> strengths;
  constexpr int kBlockPx = 3, kGradientPx = 3;
  cv::goodFeaturesToTrack(image(box), found, config.most, config.quality, config.apart_px, region(box), strengths,
                          kBlockPx, kGradientPx);
  size_t strong = 0;
  while (strong < found.size() && strengths[strong] >= config.least_strength) ++strong;
  found.resize(strong);
  for (cv::Point2f& corner : found) corner += cv::Point2f(box.tl());
  return found;
}

/// Returns the positions of the corners in another image; std::nullopt for lost corners.
std::vector<std::optional<cv::Point2f>> track(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                                              const std::vector<cv::Point2f>& corners,
                                              const FeatureFlowConfig& config) {
  CornerTracker tracker(config.window_px, config.levels);
  std::vector<std::optional<cv::Point2f>> found(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto ahead = tracker.track(from, to, corners[i]);
    if (!ahead) continue;
    if (config.round_trip_px > 0.0) {
      const auto back = tracker.track(to, from, *ahead, corners[i]);
      if (!back || !(cv::norm(*back - corners[i]) <= config.round_trip_px)) continue;
    }
    found[i] = ahead;
  }
  return found;
}

}  // namespace

std::vector<std::vector<RayPair>> feature_flow(const cv::Mat& older, const cv::Mat& newer,
                                               std::span<const cv::Mat> regions, const camera::Camera& camera,
                                               const FeatureFlowConfig& config) {
  check(config);
  const cv::Size size(camera.width_px, camera.height_px);
  if (older.size() != size || newer.size() != size)
    throw std::invalid_argument("the images differ in size from the camera");
  std::vector<std::vector<RayPair>> pairs(regions.size());
  std::vector<cv::Point2f> all;
  std::vector<size_t> region_of;
  for (size_t k = 0; k < regions.size(); ++k) {
    if (regions[k].size() != size) throw std::invalid_argument("a region differs in size from the camera");
    for (const cv::Point2f& corner : corners(older, regions[k], config)) {
      all.push_back(corner);
      region_of.push_back(k);
    }
  }
  if (all.empty()) return pairs;

  const cv::Size window(config.window_px, config.window_px);
  std::vector<cv::Mat> from, to;
  opencv_library().pyramid(older, window, config.levels - 1, from);
  opencv_library().pyramid(newer, window, config.levels - 1, to);
  const auto found = track(from, to, all, config);
  for (size_t i = 0; i < all.size(); ++i) {
    if (!found[i]) continue;
    const Eigen::Vector2d before_px(all[i].x, all[i].y), after_px(found[i]->x, found[i]->y);
    const auto before_C = camera.unit_ray(before_px), after_C = camera.unit_ray(after_px);
    if (before_C && after_C) pairs[region_of[i]].push_back({before_px, after_px, *before_C, *after_C});
  }
  return pairs;
}

Eigen::Vector3d derotate_ray(const Eigen::Vector3d& after_C, const Eigen::Matrix3d& R_C1C2) { return R_C1C2 * after_C; }

double flow_angle_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  return std::atan2(before.cross(after).norm(), before.dot(after));
}

double distance_m(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled) {
  const double sin_flow = before.cross(after).norm();
  const double across_m = before.cross(traveled).norm();  // v dt sin(alpha)
  return sin_flow > 0.0 ? across_m / sin_flow : std::numeric_limits<double>::infinity();
}

double direction_error_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after,
                           const Eigen::Vector3d& traveled) {
  const Eigen::Vector3d moved = after - after.dot(before) * before;
  const Eigen::Vector3d fixed = traveled.dot(before) * before - traveled;
  if (moved.norm() == 0.0 || fixed.norm() == 0.0) return std::numbers::pi / 2.0;
  return flow_angle_rad(moved, fixed);
}

double off_tangent_rad(const Eigen::Vector2d& before_px, const Eigen::Vector2d& after_px,
                       const Eigen::Vector2d& center_px) {
  const Eigen::Vector2d radius = before_px - center_px, flow = after_px - before_px;
  if (flow.norm() == 0.0) return std::numbers::pi / 2.0;
  const double along = std::abs(radius.dot(flow)), across = std::abs(radius.x() * flow.y() - radius.y() * flow.x());
  return std::atan2(along, across);
}

}  // namespace hedgehop::vision::flow
