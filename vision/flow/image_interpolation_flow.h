#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "sim/fields/field.h"
#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// The grid of patches of the image interpolation algorithm, and its effort and thresholds. Keys of a scenario are the
/// grid and `levels`; the defaults of the rest suit 8-bit images of 100 to 400 px, from simulation and from real
/// cameras.
struct ImageInterpolationConfig {
  int rows = 16, cols = 16;    ///< patches in the grid
  int patch_px = 64;           ///< side of a square patch
  int margin_px = 28;          ///< rim of the image that no patch enters
  int reduction = 1;           ///< the finest images compared are reduced this many times: 1, 2 or 4
  int levels = 3;              ///< images compared, each half as large as the one before
  int iterations = 2;          ///< re-centered passes per level
  double max_flow_px = 16.0;   ///< a longer vector is invalid
  double noise_grey = 1.0;     ///< standard deviation of a pixel's noise that texture must stand out from
  double max_sigma_px = 0.4;   ///< a vector whose expected error is larger is invalid
  double max_misfit_px = 2.0;  ///< a patch whose pixels moved apart by more (root mean square) is invalid
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ImageInterpolationConfig> auto& c) {
  v("rows", c.rows, {.at_least = 1, .at_most = 128, .meaning = "rows of patches, evenly spaced"});
  v("cols", c.cols, {.at_least = 1, .at_most = 128, .meaning = "columns of patches, evenly spaced"});
  v("patch", c.patch_px, {.unit = "px", .at_least = 8, .at_most = 512, .meaning = "side of a square patch"});
  v("margin", c.margin_px,
    {.unit = "px", .at_least = 0, .meaning = "rim of the image that no patch enters; 0 looks as far as the edges"});
  v("levels", c.levels, {.at_least = 1, .at_most = 4, .meaning = "images compared, each half as large as the last"});
}

/// Optic flow between successive images by the image interpolation algorithm.
class ImageInterpolationFlow {
 public:
  /// Throws std::invalid_argument when the config is out of range or the patches do not fit the image.
  ImageInterpolationFlow(const ImageInterpolationConfig& config, int width_px, int height_px);
  ~ImageInterpolationFlow();
  ImageInterpolationFlow(ImageInterpolationFlow&&) noexcept;
  ImageInterpolationFlow& operator=(ImageInterpolationFlow&&) noexcept;

  /// Flow from the image of the last call to this one; no vector is valid on the first call.
  /// @param grey  height x width, CV_8UC1. Throws std::invalid_argument for another size or type.
  /// @return valid until the next call.
  const FlowField& update(const cv::Mat& grey);
  /// Forgets the last image.
  void reset();
  /// The last result.
  const FlowField& field() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hedgehop::vision::flow
