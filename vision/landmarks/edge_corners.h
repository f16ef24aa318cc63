#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

// Corners are points at which two straight edges of an image end. Grass, clouds and other texture have grey-level
// corners at every scale, but few long straight edges, and hardly two with a common end.

namespace hedgehop::vision::landmarks {

/// A straight edge in an image between two end points, px.
struct ImageEdge {
  Eigen::Vector2d from_px = Eigen::Vector2d::Zero(), to_px = Eigen::Vector2d::Zero();

  double length_px() const { return (to_px - from_px).norm(); }
};

/// Returns the straight segments of an image's edges with a length of at least 9 px. The brighter side is on the right,
/// seen from start to end. Maxima of the gradient are followed along straight lines: a line continues while the next
/// maximum lies on it and has its direction. The gradient is computed in integers, and the remaining arithmetic is
/// equal on all processors. @param plane  CV_8UC1. Source: [Gioi2010] sec. 2. Differs: the paper's lines grow over all
/// pixels with one gradient direction, ours only over maxima. This takes a fifth of the time and also detects edges of
/// a third of the contrast.
std::vector<ImageEdge> line_segments(const cv::Mat& plane);

// Thresholds for edges and corners, chosen for rendered images of towers, 320 to 640 px wide.
inline constexpr double kMinEdgePx = 20.0;    ///< shorter edges rarely belong to a building
inline constexpr double kGapPx = 20.0;        ///< maximum gap of an edge in front of ground of equal brightness
inline constexpr double kAsidePx = 1.5;       ///< maximum offset of a segment from its line: the detector's error
inline constexpr double kBeyondPx = 8.0;      ///< maximum distance of an edge's end from its corner
inline constexpr double kFarBeyondPx = 25.0;  ///< the same if the other edge reaches the corner,
inline constexpr double kFarShare = 0.2;      ///< but at most this share of the edge's length

/// Joins collinear segments of equal orientation into edges, the longest first. Edges in front of textured ground are
/// interrupted at points of equal brightness.
std::vector<ImageEdge> joined_edges(std::span<const ImageEdge> pieces);

/// Returns the common end points of two or more edges, px. An edge that passes through the end of another does not form
/// a corner with it, because one object occludes another there.
/// @param min_angle_rad  minimum angle between the edges of a corner, in (0, pi / 2].
std::vector<Eigen::Vector2d> corners_of(std::span<const ImageEdge> edges, double min_angle_rad);

/// Returns the corners of an image, px. @param image  CV_8UC1 or CV_8UC3 (RGB); in RGB, edges between red and green of
/// equal brightness are also detected. @param min_angle_rad  as in corners_of().
std::vector<Eigen::Vector2d> edge_corners(const cv::Mat& image, double min_angle_rad);

}  // namespace hedgehop::vision::landmarks
