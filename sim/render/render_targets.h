#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/drawing_options.h"
#include "sim/render/gl_functions.h"

namespace hedgehop::sim {

/// Throws std::invalid_argument if the context cannot draw exactly this number of samples per pixel.
/// @param samples  valid: 1, 2, 4, 8.
void require_samples(const GlFunctions& gl, int samples);

/// Framebuffers, one for each size, raster and number of samples. Each is created once and reused.
class RenderTargets {
 public:
  /// Properties of a framebuffer.
  struct TargetShape {
    int width_px = 0, height_px = 0;
    Raster raster = Raster::grey;
    int samples = 1;  ///< per pixel; more than one for grey and color only
    bool operator==(const TargetShape&) const = default;
  };

  /// Binds the framebuffer of this shape and sets the viewport. Throws std::runtime_error if the framebuffer cannot be
  /// created, std::invalid_argument if it is too large or require_samples() rejects the number of samples.
  void bind(const GlFunctions& gl, const TargetShape& shape);

  /// Copies the bound framebuffer, averaged over the samples of each pixel, into an image. The image is created if its
  /// size or type differs. Throws std::invalid_argument if the row step of the image is not a whole number of pixels.
  void read(const GlFunctions& gl, cv::Mat& out);

 private:
  struct Target {
    TargetShape shape;
    GLuint drawn = 0, read = 0;  ///< framebuffers; equal unless samples are averaged
  };
  static Target make(const GlFunctions& gl, const TargetShape& shape);

  std::vector<Target> targets_;
  size_t bound_ = 0;
};

}  // namespace hedgehop::sim
