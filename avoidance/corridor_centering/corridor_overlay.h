#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "avoidance/corridor_centering/wall_observer.h"
#include "vision/corridor/corridor_space.h"

namespace hedgehop::avoidance::corridor_centering {

/// Content of the annotated image of one decision.
struct CorridorScene {
  const WallObservation* seen = nullptr;  ///< null before the second image
  vision::corridor::Gap gap;              ///< NaN if unknown
  std::optional<double> course_rad;       ///< to the right of the heading
  double radius_m = 0.0;                  ///< of the vehicle
  std::string caption;
};

/// Returns the fisheye image with bright regions, accepted flow in green and rejected flow in red, next to a map from
/// above with wall points, both medians, the gap and the course. CV_8UC3, RGB.
cv::Mat corridor_overlay(const WallObserver& observer, const CorridorScene& scene);

}  // namespace hedgehop::avoidance::corridor_centering
