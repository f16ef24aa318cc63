#pragma once

#include <Eigen/Core>

#include "vision/mapping/depth_blocks.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {

/// Recognizes sky: it cannot be matched, and without it nothing flies in the open. A block is sky only on evidence:
/// - below the horizon, which attitude predicts, its column ends in ground matched at 15 m or farther, level, without
///   a gap from the image's edge; a column is upright in the world, however the camera is tilted;
/// - from there up nothing was matched that is nearer than 15 m;
/// - above what was matched its column is smooth, and as bright as the sky of columns near to ground at 25 m is in
///   its row: where there are none, there is no sky.
/// What is thin and dark before it, a wire or a bare branch, is matched late or never, and stays apart as a line: up to
/// three blocks of a column.
/// With it goes what lies between that ground and the horizon. A plain wall stands on ground that is nearer, a plain
/// box in the air has edges or another brightness: both stay unknown. And a wall would stand at the end of
/// that ground: `foot16` says how far sky is free at least. A plain ceiling over far ground, with no sky beside it,
/// passes for sky. Differs from [Andert2007] eq. (6) to (8), where
/// all that is bright and without texture is infinitely far.
/// @param down_C  the vertical in C, of length 1. @return blocks of sky found.
int find_sky(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, DepthBlocks& blocks);

}  // namespace hedgehop::vision::mapping
