#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>

#include "scenes/scene.h"
#include "sim/render/drawing_options.h"
#include "sim/render/visible_chunks.h"
#include "sim/scenario/drawing.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// Renders undistorted pinhole images of a scene. Renderer composes the images of all other lenses from them.
class PinholeRenderer {
 public:
  virtual ~PinholeRenderer() = default;
  PinholeRenderer(const PinholeRenderer&) = delete;
  PinholeRenderer& operator=(const PinholeRenderer&) = delete;

  /// Pose of the camera and time of the scene.
  struct Viewpoint {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    double t_s = 0.0;
  };

  /// Renders one image.
  /// @param samples  per pixel; more than one for grey and color only.
  /// @param out      created if its size or type differs, otherwise overwritten.
  virtual void render(const vision::camera::PinholeCamera& camera, const Viewpoint& view, Raster raster, int samples,
                      cv::Mat& out) = 0;

  /// Pose of the next image, and the motion of each moving obstacle until then.
  struct FlowTarget {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    std::span<const Eigen::Isometry3d> moved_W;  ///< from the points of W at this image to those at the next
  };

  /// Renders true flow, as ImageChannel::flow. Returns false without rendering if the flow must be computed from depth.
  virtual bool render_flow(const vision::camera::PinholeCamera& camera, const Viewpoint& view, const FlowTarget& next,
                           cv::Mat& out);

  /// Throws std::invalid_argument that lists the valid numbers if this number of samples per pixel is not possible.
  virtual void require_samples(int samples) = 0;

  /// Returns the name and version of the renderer, one line.
  virtual std::string info() = 0;

  /// Stretches of the index buffer, and triangles, drawn since the last call of start_count().
  struct Count {
    size_t stretches = 0, triangles = 0;
  };
  void start_count() { count_ = {}; }
  const Count& count() const { return count_; }

 protected:
  PinholeRenderer() = default;
  Count count_;
};

/// Throws as the constructor of Renderer.
std::unique_ptr<PinholeRenderer> make_pinhole_renderer(const scenes::Scene& scene, Culling culling, RendererKind kind,
                                                       Shadows shadows);

}  // namespace hedgehop::sim
