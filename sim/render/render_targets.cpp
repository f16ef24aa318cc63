#include "sim/render/render_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace hedgehop::sim {

namespace {

struct Format {
  GLenum storage, read_format, read_type;
  int mat_type;
};

Format format_of(Raster raster) {
  switch (raster) {
    case Raster::grey:
      return {GL_R8, GL_RED, GL_UNSIGNED_BYTE, CV_8UC1};
    case Raster::color:
      return {GL_RGBA8, GL_RGB, GL_UNSIGNED_BYTE, CV_8UC3};
    case Raster::depth:
      return {GL_R32F, GL_RED, GL_FLOAT, CV_32FC1};
    case Raster::planes:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT, CV_32FC4};
    case Raster::labels:
      return {GL_R32I, GL_RED_INTEGER, GL_INT, CV_32SC1};
  }
  throw std::invalid_argument("unknown raster");
}

}  // namespace

RenderTargets::Target RenderTargets::make(const GlFunctions& gl, int width_px, int height_px, Raster raster) {
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (std::max(width_px, height_px) > largest) {
    throw std::invalid_argument(fmt::format("a picture of {} x {} px is larger than this OpenGL can draw ({} px)",
                                            width_px, height_px, largest));
  }
  std::array<GLuint, 2> buffers{};
  gl.GenRenderbuffers(2, buffers.data());
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
  gl.RenderbufferStorage(GL_RENDERBUFFER, format_of(raster).storage, width_px, height_px);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_px, height_px);

  Target target{width_px, height_px, raster, 0};
  gl.GenFramebuffers(1, &target.framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(
        fmt::format("no framebuffer of {} x {} px (OpenGL status {:#06x})", width_px, height_px, status));
  }
  check_gl(gl, "making a framebuffer");
  return target;
}

void RenderTargets::bind(const GlFunctions& gl, int width_px, int height_px, Raster raster) {
  const auto fits = [&](const Target& target) {
    return target.width_px == width_px && target.height_px == height_px && target.raster == raster;
  };
  auto target = std::ranges::find_if(targets_, fits);
  if (target == targets_.end()) target = targets_.insert(target, make(gl, width_px, height_px, raster));
  bound_ = static_cast<size_t>(target - targets_.begin());
  gl.BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
  gl.Viewport(0, 0, width_px, height_px);
}

void RenderTargets::read(const GlFunctions& gl, cv::Mat& out) {
  const Target& target = targets_[bound_];
  const Format format = format_of(target.raster);
  out.create(target.height_px, target.width_px, format.mat_type);
  if (out.step % out.elemSize() != 0) {
    throw std::invalid_argument("the rows of a picture to draw into must be a whole number of pixels apart");
  }
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.PixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(out.step / out.elemSize()));
  gl.ReadPixels(0, 0, target.width_px, target.height_px, format.read_format, format.read_type, out.data);
}

}  // namespace hedgehop::sim
