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

/// Which edges count, and where they end together.
struct EdgeCornerConfig {
  double least_edge_px = 20.0;
  double gap_px = 20.0;
  double aside_px = 1.5;
  double beyond_px = 8.0;
  double least_angle_rad = 0.2;
};

template <class Visitor>
void describe(Visitor& v, EdgeCornerConfig& c) {
  v("least_edge", c.least_edge_px, {.unit = "px", .above = 0.0, .meaning = "shorter edges make no corner"});
  v("gap", c.gap_px, {.unit = "px", .at_least = 0.0, .meaning = "pieces of one line so near each other are one edge"});
  v("aside", c.aside_px, {.unit = "px", .above = 0.0, .meaning = "pieces so far off a line do not belong to it"});
  v("beyond", c.beyond_px, {.unit = "px", .at_least = 0.0, .meaning = "an edge may end so far before its corner"});
  v("least_angle", c.least_angle_rad,
    {.unit = "deg", .above = 0.0, .at_most = 90.0, .meaning = "edges at a smaller angle make no corner"});
}

/// Joins pieces of straight edges into whole ones, the longest first: what stands before a textured ground has edges
/// that break wherever the ground is as bright.
std::vector<ImageEdge> joined_edges(std::span<const ImageEdge> pieces, const EdgeCornerConfig& config);

/// Returns where two edges or more end together, px. An edge that passes through another's end makes no corner with it:
/// there one thing hides another, and the place is none of the world.
std::vector<Eigen::Vector2d> corners_of(std::span<const ImageEdge> edges, const EdgeCornerConfig& config);

/// Throws std::invalid_argument, naming the key, on a bad config.
void check(const EdgeCornerConfig& config);

/// Returns the corners of an image, px. @param image  CV_8UC1, or CV_8UC3 (RGB): then edges between red and green of
/// one brightness are seen, too.
/// Source: the pieces of edges are those of the line segment detector, [Gioi2010] sec. 2.
std::vector<Eigen::Vector2d> edge_corners(const cv::Mat& image, const EdgeCornerConfig& config);

}  // namespace hedgehop::vision::landmarks
