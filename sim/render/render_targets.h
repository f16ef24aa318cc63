#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/gl_functions.h"

namespace hedgehop::sim {

/// What OpenGL puts into a pixel of a pinhole's picture.
enum class Raster {
  grey,    ///< CV_8UC1
  color,   ///< CV_8UC3, RGB
  depth,   ///< CV_32FC1, z in C, m
  planes,  ///< CV_32FC4, see plane_program()
  labels,  ///< CV_32SC1
};

/// Framebuffers to draw into, one for each size and raster asked for, made once and kept.
class RenderTargets {
 public:
  /// Binds the framebuffer for a view and sets the viewport. Throws std::runtime_error when it cannot be had.
  void bind(const GlFunctions& gl, int width_px, int height_px, Raster raster);

  /// Copies the bound framebuffer into a picture of its own size and type, created when it does not fit.
  /// Throws std::invalid_argument when the picture's rows are not a whole number of pixels apart.
  void read(const GlFunctions& gl, cv::Mat& out);

 private:
  struct Target {
    int width_px = 0, height_px = 0;
    Raster raster = Raster::grey;
    GLuint framebuffer = 0;
  };
  static Target make(const GlFunctions& gl, int width_px, int height_px, Raster raster);

  std::vector<Target> targets_;
  size_t bound_ = 0;
};

}  // namespace hedgehop::sim
