#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "avoidance/landmark_map/map_route.h"
#include "vision/landmarks/landmark_filter.h"

namespace hedgehop::avoidance::landmark_map {

/// Returns an image with its corners (yellow squares) and the predicted landmarks of the map: confirmed ones green,
/// others grey, missed ones red, each with its ellipse of three standard deviations.
/// @param grey  CV_8UC1. @return CV_8UC3, RGB.
cv::Mat landmark_overlay(const cv::Mat& grey, std::span<const Eigen::Vector2d> corners_px,
                         const vision::landmarks::LandmarkMap& map, const vision::landmarks::CameraPose& pose,
                         const vision::camera::PinholeCamera& camera);

/// View from above of a flight with a map; north and east, m.
struct PlanView {
  std::vector<Eigen::Vector2d> landmarks_NE;
  std::span<const PlanHull> hulls;
  Eigen::Vector2d from_NE = Eigen::Vector2d::Zero(), to_NE = Eigen::Vector2d::Zero();  ///< of the course
  Eigen::Vector2d at_NE = Eigen::Vector2d::Zero();                                     ///< the vehicle
  std::span<const Eigen::Vector2d> path_NE;                                            ///< planned from there
};

/// Draws a view from above in the bottom right corner of an image, north up: landmarks green, outlines of obstacles
/// red, the course grey, the vehicle and its planned path yellow. The view contains the whole course and is clipped
/// there.
/// @param image  CV_8UC3, RGB; not changed if it is too small.
void draw_plan(const PlanView& view, cv::Mat& image);

}  // namespace hedgehop::avoidance::landmark_map
