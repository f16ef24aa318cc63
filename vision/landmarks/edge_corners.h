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

// What counts as an edge, and as edges that end together. Chosen for rendered images of towers, 320 to 640 px wide.
inline constexpr double kShortestEdgePx = 20.0;  ///< shorter ones are seldom edges of a building
inline constexpr double kGapPx = 20.0;           ///< an edge breaks for as long where the ground is as bright
inline constexpr double kAsidePx = 1.5;          ///< of a piece from its line: the detector's error
inline constexpr double kBeyondPx = 8.0;         ///< an edge ends so far before its corner

/// Joins pieces of straight edges into whole ones, the longest first: what stands before a textured ground has edges
/// that break wherever the ground is as bright.
std::vector<ImageEdge> joined_edges(std::span<const ImageEdge> pieces);

/// Returns where two edges or more end together, px. An edge that passes through another's end makes no corner with it:
/// there one thing hides another, and no point of the world lies there.
/// @param least_angle_rad  in (0, pi / 2]: edges at a smaller angle make no corner.
std::vector<Eigen::Vector2d> corners_of(std::span<const ImageEdge> edges, double least_angle_rad);

/// Returns the corners of an image, px. @param image  CV_8UC1, or CV_8UC3 (RGB): then edges between red and green of
/// one brightness are found, too. @param least_angle_rad  as in corners_of().
/// Source: the pieces of edges are those of the line segment detector, [Gioi2010] sec. 2.
std::vector<Eigen::Vector2d> edge_corners(const cv::Mat& image, double least_angle_rad);

}  // namespace hedgehop::vision::landmarks
