#include "sim/render/renderer.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "sim/render/gl_context.h"
#include "sim/render/render_targets.h"
#include "sim/render/scene_buffers.h"
#include "sim/render/shaders.h"
#include "sim/render/visible_chunks.h"

namespace hedgehop::sim {

namespace {

void check(const CameraView& view) {
  const vision::PinholeCamera& camera = view.camera;
  if (camera.width_px < 1 || camera.height_px < 1 || !(camera.focal_x_px > 0.0) || !(camera.focal_y_px > 0.0)) {
    throw std::invalid_argument(
        fmt::format("a camera needs pixels and positive focal lengths, got {} x {} px and {}, {} px", camera.width_px,
                    camera.height_px, camera.focal_x_px, camera.focal_y_px));
  }
  if (!view.X_WC.matrix().allFinite()) throw std::invalid_argument("a camera's pose is not finite");
}

/// Pixel to normalized device coordinates, y not flipped: (scale x, scale y, centre x, centre y).
Eigen::Vector4f lens(const vision::PinholeCamera& camera) {
  return Eigen::Vector4d(2.0 * camera.focal_x_px / camera.width_px, 2.0 * camera.focal_y_px / camera.height_px,
                         (2.0 * camera.center_u_px + 1.0) / camera.width_px - 1.0,
                         (2.0 * camera.center_v_px + 1.0) / camera.height_px - 1.0)
      .cast<float>();
}

/// The nearest point that floats hold exactly up to 16 km from the origin. Not the nearest float: g++ 12 at -O2 folds
/// double to float and back into nothing, and p - on_float_grid(p) with it.
Eigen::Vector3d on_float_grid(const Eigen::Vector3d& p) { return (1024.0 * p).array().round().matrix() / 1024.0; }

Eigen::Vector3f mean_of_channels(const Eigen::Vector3f& color) { return Eigen::Vector3f::Constant(color.mean()); }

}  // namespace

class Renderer::Impl {
 public:
  Impl(const scenes::Scene& scene, Culling culling, ContextKind context)
      : context_(make_context(context)),
        culling_(culling),
        sky_(scene.sky),
        buffers_(upload(gl_, scene)),
        visible_(buffers_.chunks, buffers_.tiles),
        greys_(grey_program(gl_)),
        colors_(color_program(gl_)),
        depths_(depth_program(gl_)),
        skies_(sky_program(gl_)),
        counts_(buffers_.chunks.size() + buffers_.tiles.size()),
        offsets_(counts_.size()) {
    gl_.Enable(GL_CULL_FACE);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.FrontFace(GL_CW);  // counter-clockwise in the picture, whose rows run down, is clockwise in OpenGL's window
    gl_.DepthFunc(GL_GEQUAL);
    gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    check_gl(gl_, "setting the context up");
  }

  void draw(const CameraView& view, cv::Mat& out) {
    check(view);
    context_->make_current();
    targets_.bind(gl_, view.camera.width_px, view.camera.height_px, view.channel);
    const float farthest = 0.0f;
    gl_.ClearBufferfv(GL_DEPTH, 0, &farthest);
    if (view.channel == Channel::depth) {
      const Eigen::Vector4f sky_m = Eigen::Vector4f::Constant(std::numeric_limits<float>::infinity());
      gl_.ClearBufferfv(GL_COLOR, 0, sky_m.data());
      draw_scene(view, depths_);
    } else {
      const bool grey = view.channel == Channel::grey;
      draw_scene(view, grey ? greys_ : colors_);
      draw_sky(view, grey);
    }
    targets_.read(gl_, out);
    check_gl(gl_, "drawing");
  }

  const Drawn& drawn() const { return drawn_; }

  std::string info() {
    context_->make_current();
    const auto word = [&](GLenum name) { return reinterpret_cast<const char*>(gl_.GetString(name)); };
    return fmt::format("{}; {}; OpenGL {}", word(GL_VENDOR), word(GL_RENDERER), word(GL_VERSION));
  }

 private:
  void draw_scene(const CameraView& view, const Program& program) {
    const Eigen::Vector3d p_WC = view.X_WC.translation();
    const Eigen::Vector3d eye_W = on_float_grid(p_WC);
    const Eigen::Vector3f eye_low_C = (view.X_WC.linear().transpose() * (p_WC - eye_W)).cast<float>();
    const Eigen::Matrix3f R_CW = view.X_WC.linear().transpose().cast<float>();
    gl_.UseProgram(program.id);
    gl_.Uniform3fv(program.eye_W, 1, eye_W.cast<float>().eval().data());
    gl_.Uniform3fv(program.eye_low_C, 1, eye_low_C.data());
    gl_.UniformMatrix3fv(program.rotation, 1, GL_FALSE, R_CW.data());
    gl_.Uniform4fv(program.lens, 1, lens(view.camera).data());

    drawn_ = {};
    for (const scenes::Chunk& chunk : visible_.find(view, culling_)) {
      counts_[drawn_.stretches] = static_cast<GLsizei>(chunk.index_count);
      offsets_[drawn_.stretches] = reinterpret_cast<const void*>(chunk.first_index * sizeof(uint32_t));
      ++drawn_.stretches;
      drawn_.triangles += chunk.index_count / 3;
    }
    gl_.MultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                          static_cast<GLsizei>(drawn_.stretches));
  }

  void draw_sky(const CameraView& view, bool grey) {
    const Eigen::Matrix3f R_WC = view.X_WC.linear().cast<float>();
    gl_.UseProgram(skies_.id);
    gl_.UniformMatrix3fv(skies_.rotation, 1, GL_FALSE, R_WC.data());
    gl_.Uniform4fv(skies_.lens, 1, lens(view.camera).data());
    gl_.Uniform3fv(skies_.horizon, 1, (grey ? mean_of_channels(sky_.horizon) : sky_.horizon).data());
    gl_.Uniform3fv(skies_.zenith, 1, (grey ? mean_of_channels(sky_.zenith) : sky_.zenith).data());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }

  std::unique_ptr<GlContext> context_;
  const GlFunctions& gl_ = context_->gl();
  Culling culling_;
  scenes::Sky sky_;
  SceneBuffers buffers_;
  VisibleChunks visible_;
  Program greys_, colors_, depths_, skies_;
  RenderTargets targets_;
  std::vector<GLsizei> counts_;
  std::vector<const void*> offsets_;
  Drawn drawn_;
};

Renderer::Renderer(const scenes::Scene& scene, Culling culling, ContextKind context)
    : impl_(std::make_unique<Impl>(scene, culling, context)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::draw(const CameraView& view, cv::Mat& out) { impl_->draw(view, out); }
const Renderer::Drawn& Renderer::drawn() const { return impl_->drawn(); }
std::string Renderer::info() const { return impl_->info(); }

}  // namespace hedgehop::sim
