#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/gl_functions.h"
#include "sim/render/renderer.h"

namespace hedgehop::sim {

/// Framebuffers to draw into, one for each size and channel asked for, made once and kept.
class RenderTargets {
 public:
  /// Binds the framebuffer for a view and sets the viewport. Throws std::runtime_error when it cannot be had.
  void bind(const GlFunctions& gl, int width_px, int height_px, Channel channel);

  /// Copies the bound framebuffer into a picture of its own size and type, created when it does not fit.
  /// Throws std::invalid_argument when the picture's rows are not a whole number of pixels apart.
  void read(const GlFunctions& gl, cv::Mat& out);

 private:
  struct Target {
    int width_px = 0, height_px = 0;
    Channel channel = Channel::grey;
    GLuint framebuffer = 0;
  };
  static Target make(const GlFunctions& gl, int width_px, int height_px, Channel channel);

  std::vector<Target> targets_;
  size_t bound_ = 0;
};

}  // namespace hedgehop::sim
