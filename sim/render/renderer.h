#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "scenes/scene.h"
#include "sim/render/drawing_options.h"
#include "sim/scenario/drawing.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// What an image holds. Where a lens shows nothing (outside a fisheye's image circle): 0, and NaN in floats.
enum class Channel {
  grey,    ///< CV_8UC1, the mean of the color image's channels
  color,   ///< CV_8UC3, RGB
  depth,   ///< CV_32FC1, m; z in C of a pinhole, distorted or not, else the distance along the ray, as z is
           ///< no distance beside the camera and behind it; +infinity where nothing but sky is seen
  labels,  ///< CV_32SC1: 0 sky; 1 + i for chunk i of the scene's meshes, counted through all of them in order; then one
           ///< for each mover, in order
  flow,    ///< CV_32FC2: motion of each pixel's point, right and down, until CameraView::next, px; sky as if infinitely
           ///< far
};

/// One image to draw. C: x right, y down, z forward; pixel (0, 0) is the center of the top-left pixel.
struct CameraView {
  vision::camera::Camera camera;
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  Channel channel = Channel::grey;
  double t_s = 0.0;  ///< time of the scene, for what moves, >= 0
  /// Pose and time of the image that Channel::flow leads to.
  struct Next {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    double t_s = 0.0;
  } next;
  /// Samples in each pixel, 1, 2, 4 or 8, averaged for grey and color; the other channels sample the center alone.
  int samples = 1;
};

/// Draws a scene off screen, without a display (OpenGL 3.3 core). The scene is copied to the context once. Several
/// renderers may live in one process; each is used by one thread at a time. Row 0 of a texture lies at v = 0. Equal
/// views give equal pixels, however many are drawn. A camera that is no undistorted pinhole is drawn as pinhole images
/// first (LensFaces), which are planned at its first image. Further images of a camera and channel allocate nothing,
/// except that tiles may for a view that shows more than any before.
class Renderer {
 public:
  /// Throws std::invalid_argument when the scene contradicts itself (an index out of range, textures of several sizes),
  /// std::runtime_error with the cause when there is no OpenGL context or a shader does not compile.
  /// @param shadows  cast by what stands still and is not flat, on everything including movers.
  explicit Renderer(const scenes::Scene& scene, Culling culling = Culling::frustum_and_horizon,
                    RendererKind kind = RendererKind::osmesa, Shadows shadows = Shadows::none);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Draws a view. @param out  created when its size or type does not fit, otherwise written in place, row 0 on top.
  /// Throws std::invalid_argument for a camera that vision::check() refuses, a pose or time that is not finite, or a
  /// number of samples that require_samples() refuses.
  void draw(const CameraView& view, cv::Mat& out);

  /// Throws std::invalid_argument, with the possible numbers, unless the context draws exactly so many samples a pixel.
  void require_samples(int samples);

  /// Statistics of the last image.
  struct Drawn {
    size_t stretches = 0;  ///< of the index buffer; those of a face and channel are drawn by one call
    size_t triangles = 0;
  };
  const Drawn& drawn() const;

  /// OpenGL vendor, renderer and version, one line.
  std::string info() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hedgehop::sim
