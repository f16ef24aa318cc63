#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vision/flow/patch_grid.h"
#include "vision/flow/reduced_image.h"

namespace hedgehop::vision::flow {

/// Flow at the nodes of a grid, interpolated bilinearly over an image and constant beyond the outer nodes; computed row
/// by row.
class SpreadFlow {
 public:
  /// @param node_u, node_v  positions of the grid's columns and rows, px, increasing.
  SpreadFlow(std::span<const double> node_u, std::span<const double> node_v, int width);

  /// Sets the values at the nodes. @param flow_u, flow_v  rows x cols, px.
  void set(std::span<const double> flow_u, std::span<const double> flow_v);
  /// Makes row y current. Consecutive rows are the fastest.
  void go_to(int y);
  /// Returns the flow of the current row in 1/65536 px, padded to a multiple of 8.
  const int32_t* u_q16() const { return u_.data(); }
  const int32_t* v_q16() const { return v_.data(); }

 private:
  void spread_sideways(std::span<const double> flow, std::vector<int32_t>& lines) const;
  void spread_between(double from, double difference, int begin, int end, int32_t* line) const;
  void start_band(int y);

  std::vector<double> node_v_;
  std::vector<int> first_column_;    ///< first column after each node except the last, then the width
  std::vector<double> right_share_;  ///< per column: weight of the node after it
  int width_, rows_, cols_;
  std::vector<int32_t> lines_u_, lines_v_;  ///< grid rows x padded width
  std::vector<int32_t> u_, v_, step_u_, step_v_;
  int y_ = -1, band_end_ = -1;  ///< the steps are valid for rows before band_end_
};

/// Computes one row of the difference between the older image and the newer one shifted back by the flow; 0 outside the
/// newer image. Interpolation is bilinear in steps of 1/128 px. Flow must not exceed the images' rim or 255 px.
/// @param out  padded width; values beyond the image's width are undefined.
/// @param columns  columns to compute, both ends multiples of 8; by default all.
void recentered_difference(const ReducedImage& older, const ReducedImage& newer, int y, const int32_t* u_q16,
                           const int32_t* v_q16, int16_t* out);
void recentered_difference(const ReducedImage& older, const ReducedImage& newer, int y, const int32_t* u_q16,
                           const int32_t* v_q16, int16_t* out, const PatchRange& columns);

}  // namespace hedgehop::vision::flow
