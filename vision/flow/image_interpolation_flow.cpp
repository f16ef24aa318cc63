#include "vision/flow/image_interpolation_flow.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/fields/bounds.h"
#include "vision/flow/flow_level.h"
#include "vision/flow/patch_grid.h"
#include "vision/flow/reduced_image.h"

namespace hedgehop::vision::flow {
namespace {

// Image rows evaluated above and below the patches if the grid does not fill the image.
constexpr int kBandRimPx = 16;

/// Checks the fields that are not scenario keys.
void check_effort(const ImageInterpolationConfig& c) {
  if (c.iterations < 1) throw std::invalid_argument("flow: iterations must be at least 1");
  if (!(c.max_flow_px > 0.0 && c.noise_grey > 0.0 && c.max_sigma_px > 0.0 && c.max_misfit_px > 0.0)) {
    throw std::invalid_argument("flow: max_flow, noise, max_sigma and max_misfit must be above 0");
  }
  if (c.max_flow_px > 250.0) throw std::invalid_argument("flow: max_flow must be 250 px or less");  // 1/128 px, 16 bits
}

void check(const ImageInterpolationConfig& c) {
  fields::require_bounds(c, "flow");
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(std::string("flow: ") + message);
  };
  need(c.reduction == 1 || c.reduction == 2 || c.reduction == 4, "reduction must be 1, 2 or 4");
  need(c.patch_px >= 4 * (c.reduction << (c.levels - 1)),
       "patch must be at least four pixels of the coarsest image (patch / reduction / 2^(levels - 1) >= 4)");
}

}  // namespace

class ImageInterpolationFlow::Impl {
 public:
  Impl(const ImageInterpolationConfig& config, int width_px, int height_px)
      : width_(width_px), height_(height_px), iterations_(config.iterations) {
    check(config);
    check_effort(config);
    grid_ = make_patch_grid(config.rows, config.cols, config.patch_px, config.margin_px, config.reduction, width_px,
                            height_px);
    // Only the band with the patches is evaluated. It starts at a row that is a pixel row on every level.
    const int step = config.reduction << (config.levels - 1);
    band_begin_ = std::max(0, (grid_.rows.front().begin - kBandRimPx) / step * step);
    band_end_ = std::min(height_, (grid_.rows.back().end + kBandRimPx + step - 1) / step * step);
    const int bits = bits_for(config.patch_px / config.reduction);
    reducer_ = ImageReducer(width_, bits);

    for (int reduction = 2; reduction <= step; reduction *= 2) {
      halves_.emplace_back(width_ / reduction, (band_end_ - band_begin_) / reduction, 0);
    }
    for (int i = 0; i < config.levels; ++i) {
      levels_.emplace_back(config, grid_, config.reduction << i, band_begin_, width_, band_end_ - band_begin_, bits);
    }
    field_.rows = config.rows;
    field_.cols = config.cols;
    field_.vectors.resize(static_cast<size_t>(config.rows * config.cols));
    for (int row = 0; row < config.rows; ++row) {
      for (int col = 0; col < config.cols; ++col) {
        field_.at(row, col).center_px = {grid_.cols[static_cast<size_t>(col)].center(),
                                         grid_.rows[static_cast<size_t>(row)].center()};
      }
    }
    flow_ = NodeFlow(config.rows, config.cols);
  }

  const FlowField& update(const cv::Mat& grey) {
    if (grey.cols != width_ || grey.rows != height_ || grey.type() != CV_8UC1) {
      throw std::invalid_argument("flow: the image must be grey, 8 bits, " + std::to_string(width_) + " x " +
                                  std::to_string(height_));
    }
    for (FlowLevel& level : levels_) level.swap_images();
    reduce(grey.rowRange(band_begin_, band_end_));
    if (has_older_) {
      estimate();
    } else {
      for (FlowVector& vector : field_.vectors) vector = {vector.center_px, Eigen::Vector2d::Zero(), false};
    }
    has_older_ = true;
    return field_;
  }

  void reset() {
    has_older_ = false;
    for (FlowVector& vector : field_.vectors) vector = {vector.center_px, Eigen::Vector2d::Zero(), false};
  }

  const FlowField& field() const { return field_; }

 private:
  // Returns the bits of the reduced images for which a patch's sums of products are exact (PatchSums::add).
  static int bits_for(int patch_px) { return patch_px <= 64 ? 12 : patch_px <= 256 ? 11 : 10; }

  void reduce(const cv::Mat& band) {
    size_t level = 0;
    if (levels_[0].reduction() == 1) reducer_.smooth(band, levels_[level++].newer());
    for (size_t i = 0; i < halves_.size(); ++i) {
      if (i == 0) {
        reducer_.halve(band, halves_[0]);
      } else {
        reducer_.halve(halves_[i - 1], halves_[i]);
      }
      if (level < levels_.size() && levels_[level].reduction() == 2 << i) {
        reducer_.smooth(halves_[i], levels_[level++].newer());
      }
    }
  }

  void estimate() {
    flow_.set_zero();
    for (size_t i = levels_.size(); i-- > 0;) {
      levels_[i].begin();
      for (int pass = 0; pass < iterations_; ++pass) levels_[i].iterate(flow_);
    }
    levels_[0].finish(flow_, field_);
  }

  int width_, height_, iterations_;
  PatchGrid grid_;
  int band_begin_ = 0, band_end_ = 0;
  ImageReducer reducer_{1, 8};
  std::vector<ReducedImage> halves_;
  std::vector<FlowLevel> levels_;  ///< finest first
  NodeFlow flow_{1, 1};
  FlowField field_;
  bool has_older_ = false;
};

ImageInterpolationFlow::ImageInterpolationFlow(const ImageInterpolationConfig& config, int width_px, int height_px)
    : impl_(std::make_unique<Impl>(config, width_px, height_px)) {}
ImageInterpolationFlow::~ImageInterpolationFlow() = default;
ImageInterpolationFlow::ImageInterpolationFlow(ImageInterpolationFlow&&) noexcept = default;
ImageInterpolationFlow& ImageInterpolationFlow::operator=(ImageInterpolationFlow&&) noexcept = default;
const FlowField& ImageInterpolationFlow::update(const cv::Mat& grey) { return impl_->update(grey); }
void ImageInterpolationFlow::reset() { impl_->reset(); }
const FlowField& ImageInterpolationFlow::field() const { return impl_->field(); }

}  // namespace hedgehop::vision::flow
