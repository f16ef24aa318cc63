#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/moving_obstacles.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// What a film shows of a decision.
struct ShownPlan {
  const LevelSlice& slice;
  const std::vector<PathState>& path;          ///< to the planned stop
  const std::vector<Eigen::Vector2d> route_W;  ///< hoped for
  std::optional<Eigen::Vector2d> look_W;       ///< what is unknown and in the way
  const std::vector<MovingObstacle>& moving_obstacles;
  double hull_m;
  std::string status;
};

/// Draws the slice from above, north up: free light, unknown grey, occupied dark; the route thin, the planned stop
/// green, what it waits for red, and what moves orange, with its way of a second. @return CV_8UC3, RGB.
cv::Mat draw(const ShownPlan& shown);

}  // namespace hedgehop::avoidance::local_map
