#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sim/render/gl_context.h"
#include "sim/render/gl_scene.h"
#include "sim/render/pinhole_renderer.h"
#include "sim/render/render_targets.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/shaders.h"
#include "sim/render/visible_chunks.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// Renders with OpenGL.
class GlRenderer : public PinholeRenderer {
 public:
  /// Throws as the constructor of Renderer.
  GlRenderer(const scenes::Scene& scene, Culling culling, RendererKind kind, Shadows shadows);

  void render(const vision::camera::PinholeCamera& camera, const Viewpoint& view, Raster raster, int samples,
              cv::Mat& out) override;
  void require_samples(int samples) override;
  std::string info() override;

 private:
  void draw_scene(const vision::camera::PinholeCamera& camera, const Viewpoint& view, const Program& program);
  void set_sunlight(const Eigen::Matrix4f& sun_from_W, float ambient);
  void draw_movers(const Viewpoint& view, const Program& program);
  void draw_sky(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, bool grey);
  void set_camera_pose(const Program& program, const Eigen::Isometry3d& X_WC, const Eigen::Isometry3d& X_WM);
  void draw_stretches();

  std::unique_ptr<GlContext> context_;
  const GlFunctions& gl_ = context_->gl();
  Culling culling_;
  scenes::Sky sky_;
  std::vector<scenes::Motion> motions_;          ///< of the moving obstacles
  std::optional<scenes::TextureList> textures_;  ///< until they are in the context
  SceneGeometry geometry_;                       ///< chunks only; vertices and indices are in the context
  VisibleChunks visible_;
  Program greys_, colors_, depths_, planes_, labels_, skies_;
  RenderTargets targets_;
  std::vector<GLsizei> counts_;  ///< of the stretches of the next call
  std::vector<const void*> offsets_;
  size_t stretches_ = 0;
};

}  // namespace hedgehop::sim
