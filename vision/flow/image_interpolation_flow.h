#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "sim/fields/field.h"
#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// Patch grid, effort and thresholds of the image interpolation algorithm. Only the grid and `levels` are scenario
/// keys. The other defaults suit simulated and real 8-bit images of 100 to 400 px.
struct ImageInterpolationConfig {
  int rows = 16, cols = 16;    ///< patches in the grid
  int patch_px = 64;           ///< side of a square patch
  int margin_px = 28;          ///< border of the image without patches
  int reduction = 1;           ///< reduction of the finest images compared: 1, 2 or 4
  int levels = 3;              ///< number of pyramid levels, each half the size of the previous one
  int iterations = 2;          ///< re-centered passes per level
  double max_flow_px = 16.0;   ///< maximum length of a valid vector
  double noise_grey = 1.0;     ///< standard deviation of pixel noise, which texture must exceed
  double max_sigma_px = 0.4;   ///< maximum expected error of a valid vector
  double max_misfit_px = 2.0;  ///< maximum spread of motion within a valid patch, root mean square
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ImageInterpolationConfig> auto& c) {
  v("rows", c.rows, {.at_least = 1, .at_most = 128, .meaning = "number of rows of patches, evenly spaced"});
  v("cols", c.cols, {.at_least = 1, .at_most = 128, .meaning = "number of columns of patches, evenly spaced"});
  v("patch", c.patch_px, {.unit = "px", .at_least = 8, .at_most = 512, .meaning = "side of a square patch"});
  v("margin", c.margin_px,
    {.unit = "px", .at_least = 0, .meaning = "border of the image without patches; 0: patches reach the edges"});
  v("levels", c.levels,
    {.at_least = 1, .at_most = 4, .meaning = "number of pyramid levels, each half the size of the previous one"});
}

/// Computes optic flow between successive images by the image interpolation algorithm.
class ImageInterpolationFlow {
 public:
  /// Throws std::invalid_argument if the config is out of range or the patches do not fit the image.
  ImageInterpolationFlow(const ImageInterpolationConfig& config, int width_px, int height_px);
  ~ImageInterpolationFlow();
  ImageInterpolationFlow(ImageInterpolationFlow&&) noexcept;
  ImageInterpolationFlow& operator=(ImageInterpolationFlow&&) noexcept;

  /// Returns the flow from the image of the previous call to this one. On the first call no vector is valid. The
  /// reference is valid until the next call.
  /// @param grey  height x width, CV_8UC1. Throws std::invalid_argument for another size or type.
  const FlowField& update(const cv::Mat& grey);
  /// Discards the previous image.
  void reset();
  /// Returns the last result.
  const FlowField& field() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hedgehop::vision::flow
