#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::vision::flow {

/// Optic flow at one position of an image.
struct FlowVector {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  ///< pixel (u, v) of the patch center in the older image
  Eigen::Vector2d flow_px = Eigen::Vector2d::Zero();    ///< motion to the newer image, px per frame; 0 if not valid
  bool valid = false;
};

/// A grid of flow vectors, row by row from the top left, symmetric about the image's center.
struct FlowField {
  int rows = 0, cols = 0;
  std::vector<FlowVector> vectors;  ///< rows * cols

  const FlowVector& at(int row, int col) const { return vectors[static_cast<size_t>(row * cols + col)]; }
  FlowVector& at(int row, int col) { return vectors[static_cast<size_t>(row * cols + col)]; }
  /// Returns the number of valid vectors.
  int valid_count() const;
  /// Returns the share of valid vectors; 0 for an empty field.
  double valid_share() const;
};

/// Draws a dot at each patch center, red for an invalid vector, and a line along each valid vector.
/// @param scale  drawn length per px of flow, > 0.
/// @param rgb  CV_8UC3, RGB, of the size of the field's images.
void draw_flow(const FlowField& field, double scale, cv::Mat& rgb);

}  // namespace hedgehop::vision::flow
