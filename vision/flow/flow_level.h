#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "vision/flow/flow_field.h"
#include "vision/flow/image_interpolation_flow.h"
#include "vision/flow/patch_grid.h"
#include "vision/flow/recentered_difference.h"
#include "vision/flow/reduced_image.h"

namespace hedgehop::vision::flow {

/// Current estimate of the flow at the nodes of the patch grid.
struct NodeFlow {
  NodeFlow(int row_count, int col_count);
  void set_zero();
  size_t size() const { return u_px.size(); }

  int rows, cols;
  std::vector<double> u_px, v_px;  ///< px of the full image per frame
  std::vector<double> confidence;  ///< 0 (no texture) to 1
};

/// Smooths the flow between neighboring nodes (1 2 1 in both directions, weighted by confidence). A node without
/// texture takes the flow of its neighbors. `spare` is scratch space of the same size.
void smooth_by_confidence(NodeFlow& flow, NodeFlow& spare);

/// Means over the patches of a grid, for flow interpolated bilinearly between the patch centers and constant beyond.
class PatchMeans {
 public:
  explicit PatchMeans(const PatchGrid& grid);
  /// Replaces node values (rows x cols) with the means over their patches.
  void apply(std::vector<double>& values);

 private:
  Eigen::MatrixXd over_rows_, over_cols_;  ///< weights of the nodes (columns) in each patch (rows)
  Eigen::MatrixXd spare_;
};

/// The image interpolation algorithm on one pair of reduced images.
///
/// A patch of the newer image, shifted back by the current flow, is modeled as the older image plus a linear
/// combination of differences of copies of the older image shifted by one reduced pixel in each direction,
///   newer(x + F) = older(x) - r_x [older(x + 1) - older(x - 1)] / 2 - r_y [...] / 2 .
/// The r that minimizes the squared error over the patch solves a 2 x 2 system.
/// Source: [Garratt2009] sec. 3.2, after [Srinivasan1994]. Differs: iterated, with the newer image re-centered by the
/// current flow (interpolated bilinearly between patches), because the error of one pass grows with the curvature of
/// the image over the reference shift. The remaining r is added to the patch's mean of the flow used for re-centering,
/// so that the variation of that flow within the patch has no effect.
class FlowLevel {
 public:
  /// @param band_begin_px  first row of the examined band in the full image.
  /// @param width_px, height_px  of the band in full pixels.  @param bits  of the image values.
  FlowLevel(const ImageInterpolationConfig& config, const PatchGrid& grid, int reduction, int band_begin_px,
            int width_px, int height_px, int bits);

  int reduction() const { return reduction_; }
  ReducedImage& newer() { return newer_; }
  void swap_images() { std::swap(older_, newer_); }

  /// Computes all terms that depend only on the older image.
  void begin();
  /// Improves `flow` by one re-centered pass.
  void iterate(NodeFlow& flow);
  /// Writes the flow after the last pass and whether each vector is valid.
  void finish(const NodeFlow& flow, FlowField& field) const;

 private:
  /// Least-squares terms of one patch: normal matrix, right side, squared difference; in units of the reduced images.
  struct PatchFit {
    double a_xx = 0.0, a_xy = 0.0, a_yy = 0.0, b_x = 0.0, b_y = 0.0, dd = 0.0;
    double min_eigenvalue = 0.0;
    Eigen::Vector2d step_px = Eigen::Vector2d::Zero();  ///< full px
  };
  /// Computes the differences of the shifted copies in a row.
  void difference_copies(int y);
  void solve(PatchFit& patch) const;
  bool is_valid(const PatchFit& patch, const Eigen::Vector2d& flow_px) const;

  ImageInterpolationConfig config_;
  int reduction_;
  double pixels_;        ///< per patch
  double noise_energy_;  ///< expected squared difference of two pixels that differ only by noise
  PatchGrid grid_;
  ReducedImage older_, newer_;
  // One padded row each, recomputed if required, because complete images would not fit the processor's cache.
  std::vector<int16_t> copy_x_, copy_y_;  ///< older(x + 1) - older(x - 1), and along y; 0 at the border
  std::vector<int16_t> difference_;
  SpreadFlow spread_;
  PatchMeans means_;
  PatchSums sums_;
  std::vector<PatchFit> patches_;
  NodeFlow spare_;
  std::vector<double> level_u_, level_v_;  ///< node flow in reduced px
};

}  // namespace hedgehop::vision::flow
