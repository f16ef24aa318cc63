#pragma once

#include <opencv2/core.hpp>

#include "vision/stereo/depth_pyramid.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {

/// How far a cylinder round a pixel's ray is free of anything seen.
struct Corridor {
  enum class State { free, blocked, unknown };
  State state = State::unknown;  ///< unknown: nothing is seen inside
  double z_m = 0.0;  ///< nearest depth inside, z in C, +infinity for sky; when blocked, any one inside that blocks
  int tests = 0;     ///< pixels and blocks looked at
};

/// Examines the flight corridor of radius `radius_m` (> 0) round the ray of `path`, a pixel of the image: blocked
/// when anything inside lies no farther than `target_m` (z in C, >= 0; 0 asks for the nearest depth, whatever it is).
/// Descends the pyramid from its top: a block all outside the corridor at its nearest depth is dropped, one all inside
/// ends there. The answer is that of a test of every pixel.
/// Source: [Andert2007] sec. 4.2, eq. (9) to (11).
Corridor examine_corridor(const DepthPyramid& pyramid, const StereoGeometry& geometry, const cv::Point& path,
                          double radius_m, double target_m);

}  // namespace hedgehop::vision::stereo
