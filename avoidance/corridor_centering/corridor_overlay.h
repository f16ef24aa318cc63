#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "avoidance/corridor_centering/wall_observer.h"
#include "vision/corridor/corridor_flow.h"

namespace hedgehop::avoidance::corridor_centering {

/// What corridor_centering shows of a decision.
struct CorridorScene {
  const WallObservation* seen = nullptr;  ///< null before the second image
  vision::corridor::Gap gap;              ///< NaN where unknown
  std::optional<double> course_rad;       ///< to the right of the heading
  double radius_m = 0.0;                  ///< of the vehicle
  std::string caption;
};

/// Returns the fisheye's image, regions bright, with accepted flow in green and rejected in red, and beside it the
/// map seen from above: walls' points, both medians, the gap and the course. CV_8UC3, RGB.
cv::Mat corridor_overlay(const WallObserver& observer, const CorridorScene& scene);

}  // namespace hedgehop::avoidance::corridor_centering
