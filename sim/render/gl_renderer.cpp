#include "sim/render/gl_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sim/render/gl_scene.h"

namespace hedgehop::sim {

namespace {

/// Returns the projection to normalized device coordinates, y not flipped: (scale x, scale y, center x, center y).
Eigen::Vector4f lens(const vision::camera::PinholeCamera& camera) {
  return Eigen::Vector4d(2.0 * camera.focal_x_px / camera.width_px, 2.0 * camera.focal_y_px / camera.height_px,
                         (2.0 * camera.center_u_px + 1.0) / camera.width_px - 1.0,
                         (2.0 * camera.center_v_px + 1.0) / camera.height_px - 1.0)
      .cast<float>();
}

/// Returns the nearest point of a grid that floats represent exactly up to 16 km from the origin. A conversion to float
/// and back would not do: g++ 12 at -O2 removes it, and p - on_float_grid(p) would be 0.
Eigen::Vector3d on_float_grid(const Eigen::Vector3d& p) { return (1024.0 * p).array().round().matrix() / 1024.0; }

Eigen::Vector3f mean_of_channels(const Eigen::Vector3f& color) { return Eigen::Vector3f::Constant(color.mean()); }

std::vector<scenes::Motion> motions_of(const scenes::Scene& scene) {
  std::vector<scenes::Motion> motions;
  for (const scenes::Mover& mover : scene.movers) motions.push_back(mover.motion);
  return motions;
}

size_t max_stretches(const SceneGeometry& geometry) {
  size_t count = geometry.chunks.size() + geometry.tiles.size();
  for (const auto& chunks : geometry.mover_chunks) count = std::max(count, chunks.size());
  return count;
}

}  // namespace

GlRenderer::GlRenderer(const scenes::Scene& scene, Culling culling, RendererKind kind, Shadows shadows)
    : context_(make_context(kind)),
      culling_(culling),
      sky_(scene.sky),
      motions_(motions_of(scene)),
      textures_(scene.textures),
      geometry_(make_geometry(scene)),
      visible_(geometry_.chunks, geometry_.tiles),
      greys_(grey_program(gl_, shadows)),
      colors_(color_program(gl_, shadows)),
      depths_(depth_program(gl_)),
      planes_(plane_program(gl_)),
      labels_(label_program(gl_)),
      skies_(sky_program(gl_)),
      counts_(max_stretches(geometry_)),
      offsets_(counts_.size()) {
  upload_meshes(gl_, geometry_);
  geometry_.vertices = {};
  geometry_.indices = {};
  gl_.Enable(GL_CULL_FACE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.FrontFace(GL_CW);  // counter-clockwise in the image, whose rows run down, is clockwise in OpenGL's window
  gl_.DepthFunc(GL_GEQUAL);
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  if (shadows == Shadows::sun)
    set_sunlight(draw_sun_map(gl_, geometry_.chunks, scene.lights.to_sun_W), scene.lights.ambient);
  check_gl(gl_, "setting up the context");
}

void GlRenderer::render(const vision::camera::PinholeCamera& camera, const Viewpoint& view, Raster raster, int samples,
                        cv::Mat& out) {
  context_->make_current();
  if (textures_ && (raster == Raster::grey || raster == Raster::color)) {
    upload_textures(gl_, textures_->images());
    textures_.reset();
  }
  targets_.bind(gl_, {camera.width_px, camera.height_px, raster, samples});
  const float farthest = 0.0f;
  gl_.ClearBufferfv(GL_DEPTH, 0, &farthest);
  switch (raster) {
    case Raster::grey:
    case Raster::color:
      draw_scene(camera, view, raster == Raster::grey ? greys_ : colors_);
      draw_sky(camera, view.X_WC, raster == Raster::grey);
      break;
    case Raster::depth:
    case Raster::planes: {
      const bool depth = raster == Raster::depth;
      const float sky = depth ? std::numeric_limits<float>::infinity() : 0.0f;
      gl_.ClearBufferfv(GL_COLOR, 0, Eigen::Vector4f::Constant(sky).eval().data());
      draw_scene(camera, view, depth ? depths_ : planes_);
      break;
    }
    case Raster::labels: {
      const Eigen::Vector4i sky = Eigen::Vector4i::Zero();
      gl_.ClearBufferiv(GL_COLOR, 0, sky.data());
      draw_scene(camera, view, labels_);
      break;
    }
  }
  targets_.read(gl_, out);
  check_gl(gl_, "drawing");
}

void GlRenderer::require_samples(int samples) {
  context_->make_current();
  sim::require_samples(gl_, samples);
}

std::string GlRenderer::info() {
  context_->make_current();
  const auto word = [&](GLenum name) { return reinterpret_cast<const char*>(gl_.GetString(name)); };
  return fmt::format("{}: {}; {}; OpenGL {}", kRendererNames[static_cast<size_t>(context_->kind())], word(GL_VENDOR),
                     word(GL_RENDERER), word(GL_VERSION));
}

void GlRenderer::set_sunlight(const Eigen::Matrix4f& sun_from_W, float ambient) {
  for (const Program& program : {greys_, colors_}) {
    gl_.UseProgram(program.id);
    gl_.UniformMatrix4fv(program.sun_from_W, 1, GL_FALSE, sun_from_W.data());
    gl_.Uniform1f(program.ambient, ambient);
    gl_.Uniform1i(program.sun, 1);
  }
}

/// Each moving obstacle is drawn as static in its frame M, with the camera at X_MC. For static solids, M is W.
void GlRenderer::set_camera_pose(const Program& program, const Eigen::Isometry3d& X_WC, const Eigen::Isometry3d& X_WM) {
  const Eigen::Matrix3d R_CM = X_WC.linear().transpose() * X_WM.linear();
  const Eigen::Vector3d p_MC = X_WM.linear().transpose() * (X_WC.translation() - X_WM.translation());
  const Eigen::Vector3d camera_M = on_float_grid(p_MC);
  gl_.UniformMatrix3fv(program.rotation, 1, GL_FALSE, R_CM.cast<float>().eval().data());
  gl_.Uniform3fv(program.camera_W, 1, camera_M.cast<float>().eval().data());
  gl_.Uniform3fv(program.camera_low_C, 1, (R_CM * (p_MC - camera_M)).cast<float>().eval().data());
  if (program.X_WM >= 0) gl_.UniformMatrix4fv(program.X_WM, 1, GL_FALSE, X_WM.matrix().cast<float>().eval().data());
}

void GlRenderer::draw_scene(const vision::camera::PinholeCamera& camera, const Viewpoint& view,
                            const Program& program) {
  gl_.UseProgram(program.id);
  set_camera_pose(program, view.X_WC, Eigen::Isometry3d::Identity());
  gl_.Uniform4fv(program.lens, 1, lens(camera).data());

  stretches_ = 0;
  for (const scenes::Chunk& chunk : visible_.find(camera, view.X_WC, culling_)) {
    counts_[stretches_] = static_cast<GLsizei>(chunk.index_count);
    offsets_[stretches_] = reinterpret_cast<const void*>(chunk.first_index * sizeof(uint32_t));
    ++stretches_;
  }
  draw_stretches();
  draw_movers(view, program);
}

void GlRenderer::draw_movers(const Viewpoint& view, const Program& program) {
  for (size_t mover = 0; mover < motions_.size(); ++mover) {
    const Eigen::Isometry3d X_WM = scenes::X_WM(motions_[mover], view.t_s);
    stretches_ = 0;
    for (const scenes::Chunk& chunk : geometry_.mover_chunks[mover]) {
      // Float coordinates in W are rounded; the margin of the box is larger than the rounding.
      constexpr float kMarginM = 0.01f;
      const Eigen::AlignedBox3f moved_W = chunk.box_W.transformed(X_WM.cast<float>());
      const Eigen::Vector3f margin = Eigen::Vector3f::Constant(kMarginM);
      const Eigen::AlignedBox3f box_W(moved_W.min() - margin, moved_W.max() + margin);
      if (chunk.index_count == 0 || !visible_.shows(box_W)) continue;
      counts_[stretches_] = static_cast<GLsizei>(chunk.index_count);
      offsets_[stretches_] = reinterpret_cast<const void*>(chunk.first_index * sizeof(uint32_t));
      ++stretches_;
    }
    if (stretches_ == 0) continue;
    set_camera_pose(program, view.X_WC, X_WM);
    draw_stretches();
  }
}

void GlRenderer::draw_stretches() {
  for (size_t i = 0; i < stretches_; ++i) count_.triangles += static_cast<size_t>(counts_[i]) / 3;
  count_.stretches += stretches_;
  gl_.MultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                        static_cast<GLsizei>(stretches_));
}

void GlRenderer::draw_sky(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, bool grey) {
  const Eigen::Matrix3f R_WC = X_WC.linear().cast<float>();
  gl_.UseProgram(skies_.id);
  gl_.UniformMatrix3fv(skies_.rotation, 1, GL_FALSE, R_WC.data());
  gl_.Uniform4fv(skies_.lens, 1, lens(camera).data());
  gl_.Uniform3fv(skies_.horizon, 1, (grey ? mean_of_channels(sky_.horizon) : sky_.horizon).data());
  gl_.Uniform3fv(skies_.zenith, 1, (grey ? mean_of_channels(sky_.zenith) : sky_.zenith).data());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace hedgehop::sim
