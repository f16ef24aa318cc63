#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sim/render/gl_context.h"
#include "sim/render/render_targets.h"
#include "sim/render/scene_buffers.h"
#include "sim/render/shaders.h"
#include "sim/render/sun_map.h"
#include "sim/render/visible_chunks.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// Draws undistorted pinhole images of a scene with OpenGL; Renderer composes all others from them.
class ScenePainter {
 public:
  /// Throws as Renderer does.
  ScenePainter(const scenes::Scene& scene, Culling culling, ContextKind context, Shadows shadows);

  /// Where an image is taken from, and when.
  struct Eye {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    double t_s = 0.0;
  };

  /// Draws one image. @param samples  a pixel, see RenderTargets::Shape. @param out  created when its size or type
  /// does not fit, otherwise written in place.
  void paint(const vision::camera::PinholeCamera& camera, const Eye& eye, Raster raster, int samples, cv::Mat& out);

  /// Throws std::invalid_argument unless the context draws exactly so many samples a pixel.
  void require_samples(int samples);

  /// Stretches of the index buffer and triangles of the images since the last call of start_count().
  struct Count {
    size_t stretches = 0, triangles = 0;
  };
  void start_count() { count_ = {}; }
  const Count& count() const { return count_; }

  /// OpenGL vendor, renderer and version, one line.
  std::string info();

 private:
  void draw_scene(const vision::camera::PinholeCamera& camera, const Eye& eye, const Program& program, bool labeled);
  void light_by(const SunMap& map, float ambient);
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
  SceneBuffers buffers_;
  VisibleChunks visible_;
  Program greys_, colors_, depths_, planes_, labels_, skies_;
  RenderTargets targets_;
  std::vector<GLsizei> counts_;  ///< of the stretches to draw next
  std::vector<const void*> offsets_;
  std::vector<int> stretch_labels_;
  size_t stretches_ = 0;
  Count count_;
};

}  // namespace hedgehop::sim
