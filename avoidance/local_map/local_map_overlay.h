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

/// Content of the video image of one decision.
struct ShownPlan {
  const LevelSlice& slice;
  const std::vector<PathState>& path;          ///< to the planned stop
  const std::vector<Eigen::Vector2d> route_W;  ///< assumed
  std::optional<Eigen::Vector2d> look_W;       ///< unknown position that prevents a better stop
  const std::vector<MovingObstacle>& moving_obstacles;
  double hull_m;
  std::string status;
};

/// Draws the slice from above, north up: free light, unknown grey, occupied dark; the route as a thin line, the planned
/// stop green, the unknown position red, moving obstacles orange with their motion in one second. @return CV_8UC3, RGB.
cv::Mat draw(const ShownPlan& shown);

}  // namespace hedgehop::avoidance::local_map
