#include "avoidance/landmark_map/landmark_overlay.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "avoidance/stereo/depth_overlay.h"

namespace hedgehop::avoidance::landmark_map {
namespace {

void draw_landmark(const vision::landmarks::PredictedBearing& seen, const vision::camera::PinholeCamera& camera,
                   const cv::Scalar& rgb, cv::Mat& image) {
  constexpr double kSigmas = 3.0, kLargestPx = 4000.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(seen.covariance - seen.noise);
  const Eigen::Vector2d half_px =
      (kSigmas * camera.focal_x_px * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt()).cwiseMin(kLargestPx);
  const Eigen::Vector2d at(camera.center_u_px + camera.focal_x_px * seen.bearing.x(),
                           camera.center_v_px + camera.focal_y_px * seen.bearing.y());
  if (at.cwiseAbs().maxCoeff() > kLargestPx) return;
  const cv::Point middle(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())));
  const Eigen::Vector2d major = axes.eigenvectors().col(1);
  const double angle_deg = std::atan2(major.y(), major.x()) * 180.0 / std::numbers::pi;
  cv::ellipse(image, middle,
              {static_cast<int>(std::ceil(half_px.y())) + 2, static_cast<int>(std::ceil(half_px.x())) + 2}, angle_deg,
              0.0, 360.0, rgb, 1, cv::LINE_AA);
  cv::circle(image, middle, 1, rgb, cv::FILLED, cv::LINE_AA);
}

}  // namespace

cv::Mat landmark_overlay(const cv::Mat& grey, std::span<const Eigen::Vector2d> corners_px,
                         const vision::landmarks::LandmarkMap& map, const vision::landmarks::CameraPose& pose,
                         const vision::camera::PinholeCamera& camera) {
  const cv::Scalar green(90, 230, 110), grey_tone(190, 190, 190), red(240, 80, 60), yellow(255, 220, 40);
  cv::Mat image;
  cv::cvtColor(grey, image, cv::COLOR_GRAY2RGB);
  for (const Eigen::Vector2d& corner : corners_px) {
    const cv::Point at(static_cast<int>(std::lround(corner.x())), static_cast<int>(std::lround(corner.y())));
    cv::drawMarker(image, at, yellow, cv::MARKER_SQUARE, 9);
  }
  int confirmed = 0;
  for (const vision::landmarks::MappedLandmark& mapped : map.landmarks()) {
    confirmed += map.confirmed(mapped);
    const auto seen = vision::landmarks::predict_bearing(mapped.landmark, pose, 1.0 / camera.focal_x_px);
    if (seen) draw_landmark(*seen, camera, mapped.misses > 0 ? red : map.confirmed(mapped) ? green : grey_tone, image);
  }
  stereo::caption(image, std::to_string(corners_px.size()) + " corners  " + std::to_string(confirmed) + " landmarks");
  return image;
}

}  // namespace hedgehop::avoidance::landmark_map
