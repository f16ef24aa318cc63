#include "avoidance/landmark_map/map_overlay.h"

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
  constexpr double kSigmas = 3.0, kMaxPx = 4000.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(seen.covariance - seen.noise);
  const Eigen::Vector2d half_px =
      (kSigmas * camera.focal_x_px * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt()).cwiseMin(kMaxPx);
  const Eigen::Vector2d at(camera.center_u_px + camera.focal_x_px * seen.bearing.x(),
                           camera.center_v_px + camera.focal_y_px * seen.bearing.y());
  if (at.cwiseAbs().maxCoeff() > kMaxPx) return;
  const cv::Point middle(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())));
  const Eigen::Vector2d major = axes.eigenvectors().col(1);
  const double angle_deg = std::atan2(major.y(), major.x()) * 180.0 / std::numbers::pi;
  cv::ellipse(image, middle,
              {static_cast<int>(std::ceil(half_px.y())) + 2, static_cast<int>(std::ceil(half_px.x())) + 2}, angle_deg,
              0.0, 360.0, rgb, 1, cv::LINE_AA);
  cv::circle(image, middle, 1, rgb, cv::FILLED, cv::LINE_AA);
}

const cv::Scalar kGreen(90, 230, 110), kRed(240, 80, 60), kGrey(150, 150, 150), kYellow(255, 220, 40);

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

void draw_plan(const PlanView& view, cv::Mat& image) {
  constexpr int kSidePx = 200, kMarginPx = 6;
  constexpr double kAroundM = 12.0;
  if (image.cols < 2 * kSidePx || image.rows < kSidePx + 2 * kMarginPx) return;
  cv::Mat plan = image(cv::Rect(image.cols - kSidePx - kMarginPx, image.rows - kSidePx - kMarginPx, kSidePx, kSidePx));
  plan *= 0.25;

  const Eigen::Vector2d middle = 0.5 * (view.from_NE + view.to_NE);
  const double half_m = 0.5 * (view.to_NE - view.from_NE).cwiseAbs().maxCoeff() + kAroundM;
  const auto at = [&](const Eigen::Vector2d& p_NE) {
    const Eigen::Vector2d off = (p_NE - middle) * (0.5 * kSidePx / half_m);
    const auto pixel = [&](double px) {
      return static_cast<int>(std::lround(0.5 * kSidePx + std::clamp(px, -1.0 * kSidePx, 1.0 * kSidePx)));
    };
    return cv::Point(pixel(off.y()), pixel(-off.x()));
  };

  cv::line(plan, at(view.from_NE), at(view.to_NE), kGrey, 1, cv::LINE_AA);
  for (const PlanHull& hull : view.hulls) {
    for (size_t k = 0; k < hull.size(); ++k) {
      cv::line(plan, at(hull[k]), at(hull[(k + 1) % hull.size()]), kRed, 1, cv::LINE_AA);
    }
  }
  for (const Eigen::Vector2d& landmark : view.landmarks_NE) cv::circle(plan, at(landmark), 1, kGreen, cv::FILLED);
  Eigen::Vector2d from = view.at_NE;
  for (const Eigen::Vector2d& turn : view.path_NE) {
    cv::line(plan, at(from), at(turn), kYellow, 1, cv::LINE_AA);
    from = turn;
  }
  cv::circle(plan, at(view.at_NE), 3, kYellow, cv::FILLED, cv::LINE_AA);
}

}  // namespace hedgehop::avoidance::landmark_map
