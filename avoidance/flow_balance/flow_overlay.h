#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "vision/flow/flow_field.h"

namespace hedgehop::avoidance::flow_balance {

/// One camera's part of the image that flow_overlay() makes.
struct FlowTile {
  std::string role;
  cv::Mat grey;  ///< CV_8UC1
  const vision::flow::FlowField* field = nullptr;
  std::string caption;
};

/// An arrow of the compass in the middle: forward is up, right is right.
struct CompassArrow {
  Eigen::Vector2d v_H = Eigen::Vector2d::Zero();  ///< m/s
  cv::Scalar rgb;
};

/// Returns the cameras' images two by two with their flow vectors, captions, and a compass of velocities.
/// @param full_scale_mps  velocity as long as the compass's radius, > 0.
/// @return CV_8UC3, RGB; empty when there are no tiles.
cv::Mat flow_overlay(std::span<const FlowTile> tiles, std::span<const CompassArrow> arrows, double full_scale_mps);

}  // namespace hedgehop::avoidance::flow_balance
