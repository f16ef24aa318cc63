#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/gl_functions.h"
#include "sim/render/raster.h"

namespace hedgehop::sim {

/// Throws std::invalid_argument unless the context draws exactly so many samples a pixel.
/// @param samples  1, 2, 4 or 8.
void require_samples(const GlFunctions& gl, int samples);

/// Framebuffers to draw into, one for each size, raster and number of samples, created once and reused.
class RenderTargets {
 public:
  /// What a framebuffer is made for.
  struct Shape {
    int width_px = 0, height_px = 0;
    Raster raster = Raster::grey;
    int samples = 1;  ///< a pixel; more than one for grey and color only
    bool operator==(const Shape&) const = default;
  };

  /// Binds the framebuffer for a view and sets the viewport. Throws std::runtime_error when it cannot be created,
  /// std::invalid_argument when it is too large or require_samples() refuses.
  void bind(const GlFunctions& gl, const Shape& shape);

  /// Copies the bound framebuffer, the mean of a pixel's samples, into an image of its own size and type, created
  /// when it does not fit.
  /// Throws std::invalid_argument when the image's rows are not a whole number of pixels apart.
  void read(const GlFunctions& gl, cv::Mat& out);

 private:
  struct Target {
    Shape shape;
    GLuint drawn = 0, read = 0;  ///< framebuffers; one and the same unless there are samples to be averaged
  };
  static Target make(const GlFunctions& gl, const Shape& shape);

  std::vector<Target> targets_;
  size_t bound_ = 0;
};

}  // namespace hedgehop::sim
