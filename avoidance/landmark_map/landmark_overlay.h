#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>

#include "vision/landmark_map.h"

namespace hedgehop::avoidance {

/// A picture with its corners (yellow squares) and the landmarks of the map as the camera should see them: confirmed
/// ones green, young ones grey, each with its ellipse of three standard deviations; those that were missed red.
/// @param grey  CV_8UC1. @return CV_8UC3, RGB.
cv::Mat landmark_picture(const cv::Mat& grey, std::span<const Eigen::Vector2d> corners_px,
                         const vision::LandmarkMap& map, const vision::CameraPose& pose,
                         const vision::PinholeCamera& camera);

}  // namespace hedgehop::avoidance
