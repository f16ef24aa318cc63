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

/// What is known of the flow at the nodes of the patch grid while levels and passes improve it.
struct NodeFlow {
  NodeFlow(int row_count, int col_count);
  void set_zero();
  size_t size() const { return u_px.size(); }

  int rows, cols;
  std::vector<double> u_px, v_px;  ///< px of the full image per frame
  std::vector<double> confidence;  ///< 0 (no texture) to 1
};

/// Smooths the flow between neighboring nodes (1 2 1 both ways, weighted by confidence): a node without texture takes
/// its neighbors' flow. `spare` is scratch space of the same size.
void smooth_by_confidence(NodeFlow& flow, NodeFlow& spare);

/// Means, over the patches of a grid, of flow that is spread bilinearly between the patch centers and constant beyond.
class PatchMeans {
 public:
  explicit PatchMeans(const PatchGrid& grid);
  /// Replaces node values (rows x cols) by the means over their patches.
  void apply(std::vector<double>& values);

 private:
  Eigen::MatrixXd over_rows_, over_cols_;  ///< weights of the nodes (columns) in each patch (rows)
  Eigen::MatrixXd spare_;
};

/// The image interpolation algorithm on one pair of reduced images.
///
/// A patch of the newer image, moved back by the flow known so far, is written as the older image plus a linear
/// combination of differences of copies of the older one shifted by one reduced pixel either way,
///   newer(x + F) = older(x) - r_x [older(x + 1) - older(x - 1)] / 2 - r_y [...] / 2 ,
/// and the r that makes the squared error over the patch least solves a 2 x 2 system.
/// Source: [Garratt2009] sec. 3.2, after [Srinivasan1994]. Differs: iterated, the newer image re-centered by the flow
/// found so far (spread bilinearly between patches), since one pass is off by the curvature of the image over the
/// reference shift. The remaining r is added to the patch's mean of the flow used for re-centering, so that how that
/// varies within the patch leaves no trace.
class FlowLevel {
 public:
  /// @param band_begin_px  row of the full image where the examined band begins.
  /// @param width_px, height_px  of the band in full pixels.  @param bits  of the images' numbers.
  FlowLevel(const ImageInterpolationConfig& config, const PatchGrid& grid, int reduction, int band_begin_px,
            int width_px, int height_px, int bits);

  int reduction() const { return reduction_; }
  ReducedImage& newer() { return newer_; }
  void swap_images() { std::swap(older_, newer_); }

  /// Prepares what depends on the older image alone.
  void begin();
  /// One re-centered pass: improves `flow`.
  void iterate(NodeFlow& flow);
  /// Writes the flow after the last pass, with what makes a vector invalid.
  void finish(const NodeFlow& flow, FlowField& field) const;

 private:
  /// Least squares of one patch: normal matrix, right side, squared difference; in numbers of the reduced images.
  struct PatchFit {
    double a_xx = 0.0, a_xy = 0.0, a_yy = 0.0, b_x = 0.0, b_y = 0.0, dd = 0.0;
    double least_eigenvalue = 0.0;
    Eigen::Vector2d step_px = Eigen::Vector2d::Zero();  ///< full px
  };
  /// Fills the differences of the copies at a row.
  void difference_copies(int y);
  void solve(PatchFit& patch) const;
  bool is_valid(const PatchFit& patch, const Eigen::Vector2d& flow_px) const;

  ImageInterpolationConfig config_;
  int reduction_;
  double pixels_;        ///< per patch
  double noise_energy_;  ///< expected square of a difference of two pixels that differ by noise only
  PatchGrid grid_;
  ReducedImage older_, newer_;
  // One row each, padded: made again where it is needed, as the whole images' would not stay in a processor's cache.
  std::vector<int16_t> copy_x_, copy_y_;  ///< older(x + 1) - older(x - 1), and along y; 0 at the rim
  std::vector<int16_t> difference_;
  SpreadFlow spread_;
  PatchMeans means_;
  PatchSums sums_;
  std::vector<PatchFit> patches_;
  NodeFlow spare_;
  std::vector<double> level_u_, level_v_;  ///< node flow in reduced px
};

}  // namespace hedgehop::vision::flow
