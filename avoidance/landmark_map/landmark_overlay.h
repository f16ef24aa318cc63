#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>

#include "vision/landmarks/landmark_filter.h"

namespace hedgehop::avoidance::landmark_map {

/// An image with its corners (yellow squares) and the landmarks of the map as the camera should see them: confirmed
/// ones green, others grey, each with its ellipse of three standard deviations; missed ones red.
/// @param grey  CV_8UC1. @return CV_8UC3, RGB.
cv::Mat landmark_overlay(const cv::Mat& grey, std::span<const Eigen::Vector2d> corners_px,
                         const vision::landmarks::LandmarkMap& map, const vision::landmarks::CameraPose& pose,
                         const vision::camera::PinholeCamera& camera);

}  // namespace hedgehop::avoidance::landmark_map
