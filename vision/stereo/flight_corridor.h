#pragma once

#include <opencv2/core.hpp>

#include "vision/stereo/depth_pyramid.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {

/// How far a cylinder around a pixel's ray is free of observed points.
struct Corridor {
  enum class State { free, blocked, unknown };
  State state = State::unknown;  ///< unknown: no depth inside
  double z_m = 0.0;  ///< nearest depth inside, z in C, +infinity for sky; when blocked, any one inside that blocks
  int tests = 0;     ///< pixels and blocks examined
};

/// Examines the flight corridor of radius `radius_m` (> 0) around the ray of `path`, a pixel of the image: blocked
/// when anything inside lies no farther than `target_m` (z in C, >= 0; 0: returns the nearest depth).
/// Descends the pyramid from its top: a block all outside the corridor at its nearest depth is dropped, one all inside
/// ends there. The answer is that of a test of every pixel.
/// Source: [Andert2007] sec. 4.2, eq. (9) to (11).
Corridor examine_corridor(const DepthPyramid& pyramid, const StereoGeometry& geometry, const cv::Point& path,
                          double radius_m, double target_m);

}  // namespace hedgehop::vision::stereo
