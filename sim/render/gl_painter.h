#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sim/render/gl_context.h"
#include "sim/render/painter.h"
#include "sim/render/render_targets.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/shaders.h"
#include "sim/render/sun_map.h"
#include "sim/render/visible_chunks.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// Draws with OpenGL.
class GlPainter : public Painter {
 public:
  /// Throws as Renderer does.
  GlPainter(const scenes::Scene& scene, Culling culling, RendererKind kind, Shadows shadows);

  void paint(const vision::camera::PinholeCamera& camera, const Eye& eye, Raster raster, int samples,
             cv::Mat& out) override;
  void require_samples(int samples) override;
  std::string info() override;

 private:
  void draw_scene(const vision::camera::PinholeCamera& camera, const Eye& eye, const Program& program, bool labeled);
  void light_by(const Eigen::Matrix4f& sun_from_W, float ambient);
  void draw_movers(const Eye& eye, const Program& program, bool labeled);
  void draw_sky(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, bool grey);
  void set_eye(const Program& program, const Eigen::Isometry3d& X_WC, const Eigen::Vector3d& p_WM);
  void draw_stretches(const Program& program, bool labeled);
  int label_of(const scenes::Chunk& stretch) const;

  std::unique_ptr<GlContext> context_;
  const GlFunctions& gl_ = context_->gl();
  Culling culling_;
  scenes::Sky sky_;
  std::vector<scenes::Motion> motions_;  ///< of the movers
  SceneGeometry geometry_;               ///< its chunks; the rest lies in the context
  VisibleChunks visible_;
  Program greys_, colors_, depths_, planes_, labels_, skies_;
  RenderTargets targets_;
  std::vector<GLsizei> counts_;  ///< of the stretches to draw next
  std::vector<const void*> offsets_;
  std::vector<int> stretch_labels_;
  size_t stretches_ = 0;
};

}  // namespace hedgehop::sim
