#include "sim/render/render_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace hedgehop::sim {

namespace {

struct Format {
  GLenum storage, read_format, read_type;
};

Format format_of(Raster raster) {
  switch (raster) {
    case Raster::grey:
      return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
    case Raster::color:
      return {GL_RGBA8, GL_RGB, GL_UNSIGNED_BYTE};
    case Raster::depth:
      return {GL_R32F, GL_RED, GL_FLOAT};
    case Raster::planes:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
    case Raster::labels:
      return {GL_R32I, GL_RED_INTEGER, GL_INT};
  }
  throw std::invalid_argument("unknown raster");
}

GLuint make_buffer(const GlFunctions& gl, GLenum storage, const RenderTargets::TargetShape& shape, int samples) {
  GLuint buffer = 0;
  gl.GenRenderbuffers(1, &buffer);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
  if (samples > 1) {
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, storage, shape.width_px, shape.height_px);
  } else {
    gl.RenderbufferStorage(GL_RENDERBUFFER, storage, shape.width_px, shape.height_px);
  }
  return buffer;
}

/// @param depth  a depth buffer, or 0 for none.
GLuint make_framebuffer(const GlFunctions& gl, GLuint color, GLuint depth, const RenderTargets::TargetShape& shape) {
  GLuint framebuffer = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(
        fmt::format("OpenGL cannot create a framebuffer of {} x {} px with {} samples per pixel (status {:#06x})",
                    shape.width_px, shape.height_px, shape.samples, status));
  }
  return framebuffer;
}

}  // namespace

void require_samples(const GlFunctions& gl, int samples) {
  if (samples != 1 && samples != 2 && samples != 4 && samples != 8) {
    throw std::invalid_argument(fmt::format("{} samples per pixel; valid: 1, 2, 4, 8", samples));
  }
  GLint max_samples = 1, actual = 1;
  gl.GetIntegerv(GL_MAX_SAMPLES, &max_samples);
  if (samples > max_samples) {
    throw std::invalid_argument(
        fmt::format("{} samples per pixel are not possible; maximum of this OpenGL: {}", samples, max_samples));
  }
  if (samples == 1) return;
  const GLuint buffer = make_buffer(gl, GL_RGBA8, {1, 1, Raster::color, samples}, samples);
  gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &actual);
  gl.DeleteRenderbuffers(1, &buffer);
  if (actual != samples) {
    throw std::invalid_argument(
        fmt::format("{} samples per pixel are not possible; this OpenGL uses {}", samples, actual));
  }
}

RenderTargets::Target RenderTargets::make(const GlFunctions& gl, const TargetShape& shape) {
  GLint max_px = 0;
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &max_px);
  if (std::max(shape.width_px, shape.height_px) > max_px) {
    throw std::invalid_argument(fmt::format("an image of {} x {} px is too large; maximum of this OpenGL: {} px",
                                            shape.width_px, shape.height_px, max_px));
  }
  require_samples(gl, shape.samples);
  const GLenum storage = format_of(shape.raster).storage;
  Target target{.shape = shape};
  if (shape.samples > 1) target.read = make_framebuffer(gl, make_buffer(gl, storage, shape, 1), 0, shape);
  target.drawn = make_framebuffer(gl, make_buffer(gl, storage, shape, shape.samples),
                                  make_buffer(gl, GL_DEPTH_COMPONENT32F, shape, shape.samples), shape);
  if (shape.samples == 1) target.read = target.drawn;
  check_gl(gl, "creating a framebuffer");
  return target;
}

void RenderTargets::bind(const GlFunctions& gl, const TargetShape& shape) {
  auto target = std::ranges::find(targets_, shape, &Target::shape);
  if (target == targets_.end()) target = targets_.insert(target, make(gl, shape));
  bound_ = static_cast<size_t>(target - targets_.begin());
  gl.BindFramebuffer(GL_FRAMEBUFFER, target->drawn);
  gl.Viewport(0, 0, shape.width_px, shape.height_px);
}

void RenderTargets::read(const GlFunctions& gl, cv::Mat& out) {
  const Target& target = targets_[bound_];
  const auto& [width_px, height_px, raster, samples] = target.shape;
  const Format format = format_of(raster);
  out.create(height_px, width_px, type_of(targets_[bound_].shape.raster));
  if (out.step % out.elemSize() != 0) {
    throw std::invalid_argument("the row step of the output image must be a whole number of pixels");
  }
  if (samples > 1) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.read);
    gl.BlitFramebuffer(0, 0, width_px, height_px, 0, 0, width_px, height_px, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, target.read);
  }
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.PixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(out.step / out.elemSize()));
  gl.ReadPixels(0, 0, width_px, height_px, format.read_format, format.read_type, out.data);
}

}  // namespace hedgehop::sim
