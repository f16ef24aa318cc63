#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>

#include "scenes/scene.h"
#include "sim/render/drawing_options.h"
#include "sim/render/raster.h"
#include "sim/render/visible_chunks.h"
#include "sim/scenario/drawing.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// Draws undistorted pinhole images of a scene; Renderer composes all others from them. One for each kind of context.
class Painter {
 public:
  virtual ~Painter() = default;
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Where an image is taken from, and when.
  struct Eye {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    double t_s = 0.0;
  };

  /// Draws one image. @param samples  a pixel; more than one for grey and color only. @param out  created when its size
  /// or type does not fit, otherwise written in place.
  virtual void paint(const vision::camera::PinholeCamera& camera, const Eye& eye, Raster raster, int samples,
                     cv::Mat& out) = 0;

  /// Where the next image is taken from, and how far each mover moves until then.
  struct Next {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    std::span<const Eigen::Vector3d> moved_W_m;
  };

  /// Draws true flow, as Channel::flow. @return false, and nothing is drawn, where it has to be computed from depths.
  virtual bool paint_flow(const vision::camera::PinholeCamera& camera, const Eye& eye, const Next& next, cv::Mat& out);

  /// Throws std::invalid_argument, with the possible numbers, unless exactly so many samples a pixel can be drawn.
  virtual void require_samples(int samples) = 0;

  /// Who draws, with version, one line.
  virtual std::string info() = 0;

  /// What was drawn since the last call of start_count(): stretches of the index buffer and their triangles.
  struct Count {
    size_t stretches = 0, triangles = 0;
  };
  void start_count() { count_ = {}; }
  const Count& count() const { return count_; }

 protected:
  Painter() = default;
  Count count_;
};

/// Throws as Renderer does.
std::unique_ptr<Painter> make_painter(const scenes::Scene& scene, Culling culling, RendererKind kind, Shadows shadows);

}  // namespace hedgehop::sim
