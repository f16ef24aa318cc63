#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/mapping/depth_blocks.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {

/// Recognizes plain upright surfaces, which stereo cannot match, by the ground at their foot. As in a world of stixels,
/// each column of blocks, vertical in the world, shows ground and then an upright surface: [Badino2009] p. 51. Blocks
/// are marked `plain` if:
/// - below them, the column shows level ground, matched without gaps from the image's lower border;
/// - between that ground and them is at most an edge, and ground begins at the lower side of that edge;
/// - they are smooth and equally bright up to the next edge;
/// - no side of the surface is matched nearer than its foot.
/// A surface without an edge on the ground at a distance R is at R; a patch of plain ground, or sky, is
/// farther. In both cases the rays of these blocks are free up to R. `foot16` is the disparity of an upright surface at
/// R. `stands` is true if the blocks extend above the horizon and the foot is an edge, so that a surface at R is
/// likely. An object that hangs in front of the surface has a silhouette, which ends the column: blocks above it remain
/// unknown. If it hides the foot, the ground seems to end at its lower edge, but its sides are matched nearer than
/// that. Limitations: a plain object that hangs in front of a plain surface of equal brightness is not seen, nor is one
/// that hides the ground and whose sides are out of view. Differs from [Badino2009] sec. 2, in which the ends of free
/// space minimize a cost over all columns: here each column counts alone, because one undetected object matters more
/// than a rough outline.
/// @param down_C  unit vector of the vertical in C. @param disparity16, grey  images from which the blocks
/// were built. @return number of plain blocks.
int find_plain(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const cv::Mat& disparity16,
               const cv::Mat& grey, DepthBlocks& blocks);

}  // namespace hedgehop::vision::mapping
