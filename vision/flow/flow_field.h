#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::vision::flow {

/// Optic flow at one place of an image.
struct FlowVector {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  ///< pixel (u, v) of the patch center in the older image
  Eigen::Vector2d flow_px = Eigen::Vector2d::Zero();    ///< motion to the newer image, px per frame; 0 when not valid
  bool valid = false;
};

/// A grid of flow vectors, row by row from the top left; columns (rows) mirror one another about the image's middle.
struct FlowField {
  int rows = 0, cols = 0;
  std::vector<FlowVector> vectors;  ///< rows * cols

  const FlowVector& at(int row, int col) const { return vectors[static_cast<size_t>(row * cols + col)]; }
  FlowVector& at(int row, int col) { return vectors[static_cast<size_t>(row * cols + col)]; }
  /// Number of valid vectors.
  int valid_count() const;
  /// valid_count() over rows * cols; 0 for an empty field.
  double valid_share() const;
};

/// Draws each valid vector as a line from its patch center, with a dot there, and each invalid one as a red dot.
/// @param scale  drawn length per px of flow, > 0.
/// @param rgb  CV_8UC3, RGB, of the size the field was made for.
void draw_flow(const FlowField& field, double scale, cv::Mat& rgb);

}  // namespace hedgehop::vision::flow
