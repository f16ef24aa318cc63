#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

/// Corners of what has straight edges: where two edges of an image end together. Grass, clouds and other texture have
/// corners of grey at every scale, but few long straight edges, and hardly two that end at one place.

namespace hedgehop::vision::landmarks {

/// A straight edge in an image, from end to end, px.
struct ImageEdge {
  Eigen::Vector2d from_px = Eigen::Vector2d::Zero(), to_px = Eigen::Vector2d::Zero();

  double length_px() const { return (to_px - from_px).norm(); }
};

/// Returns the straight pieces of an image's edges, 9 px and longer, each with the brighter side on the same hand on
/// the way from its beginning to its end. The maxima of the gradient are followed along straight lines: a line goes on
/// while the next maximum lies on it and has its direction. The gradient is in whole numbers, and the rest plain
/// arithmetic: all processors agree. @param plane  CV_8UC1. After [Gioi2010] sec. 2, whose lines grow over all pixels
/// of one direction of the gradient; ours take its maxima alone, in a fifth of the time, and edges of a third of the
/// contrast.
std::vector<ImageEdge> line_segments(const cv::Mat& plane);

// What counts as an edge, and as edges that end together. Chosen for rendered images of towers, 320 to 640 px wide.
inline constexpr double kMinEdgePx = 20.0;    ///< shorter ones are seldom edges of a building
inline constexpr double kGapPx = 20.0;        ///< an edge breaks for as long where the ground is as bright
inline constexpr double kAsidePx = 1.5;       ///< of a piece from its line: the detector's error
inline constexpr double kBeyondPx = 8.0;      ///< an edge ends so far before its corner
inline constexpr double kFarBeyondPx = 25.0;  ///< and so far where the other edge reaches it,
inline constexpr double kFarShare = 0.2;      ///< but no farther than this share of its length

/// Joins pieces of straight edges of one sense, from -> to, into whole ones, the longest first: what stands before a
/// textured ground has edges that break wherever the ground is as bright.
std::vector<ImageEdge> joined_edges(std::span<const ImageEdge> pieces);

/// Returns where two edges or more end together, px. An edge that passes through another's end makes no corner with it:
/// there one thing hides another, and no point of the world lies there.
/// @param least_angle_rad  in (0, pi / 2]: edges at a smaller angle make no corner.
std::vector<Eigen::Vector2d> corners_of(std::span<const ImageEdge> edges, double least_angle_rad);

/// Returns the corners of an image, px. @param image  CV_8UC1, or CV_8UC3 (RGB): then edges between red and green of
/// one brightness are found, too (line_segments()). @param least_angle_rad  as in corners_of().
std::vector<Eigen::Vector2d> edge_corners(const cv::Mat& image, double least_angle_rad);

}  // namespace hedgehop::vision::landmarks
