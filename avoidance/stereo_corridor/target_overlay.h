#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vision/stereo/disparity.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::stereo_corridor {

/// Input and result of one decision of the stereo corridor.
struct TargetImage {
  struct Candidate {
    cv::Point pixel;  ///< center of a block of the pyramid
    bool free = false;
  };
  cv::Mat grey;       ///< CV_8UC1, left
  cv::Mat matched16;  ///< disparity before filtering
  std::vector<Candidate> candidates;
  std::optional<cv::Point> target;
  int target_radius_px = 0;  ///< radius of the corridor at the target
  std::string chosen_by;     ///< the step of [Andert2007] sec. 4.3.4 that found the target
};

/// Draws the processing chain of [Andert2007] fig. 1 in six panels, left to right, top to bottom: left image, matched
/// depth, filtered depth, regions without near objects, the dangerous (red) and free (green) ones of these, chosen
/// target.
/// @param pyramid  of the filtered disparity. @param far_m  depth beyond which the color is constant, > 0.
/// @return CV_8UC3, RGB.
cv::Mat draw(const TargetImage& shown, const vision::stereo::DepthPyramid& pyramid,
             const vision::stereo::StereoGeometry& geometry, double far_m);

}  // namespace hedgehop::avoidance::stereo_corridor
