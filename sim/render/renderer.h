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

/// The pixel values of an image. Outside the image circle of a fisheye they are 0, or NaN for floats.
enum class ImageChannel {
  grey,    ///< CV_8UC1, mean of the channels of the color image
  color,   ///< CV_8UC3, RGB
  depth,   ///< CV_32FC1, m: z in C of a pinhole lens, distorted or not; distance along the ray of other lenses,
           ///< because their rays may have z <= 0; +infinity for the sky
  labels,  ///< CV_32SC1: 0 for the sky, 1 + i for element i of scenes::instances()
  flow,    ///< CV_32FC2: displacement of the point of each pixel until CameraView::next, right and down, px; sky is at
           ///< infinity
  semantic,  ///< CV_32SC1: 0 for the sky, otherwise scenes::class_id() of the instance
};

/// One image to render. C: x right, y down, z forward; pixel (0, 0) is the center of the top-left pixel.
struct CameraView {
  vision::camera::Camera camera;
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  ImageChannel channel = ImageChannel::grey;
  double t_s = 0.0;  ///< time of the scene, >= 0; determines the positions of the moving obstacles
  /// Pose and time of the next image, for ImageChannel::flow.
  struct Next {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    double t_s = 0.0;
  } next;
  /// Samples per pixel: 1, 2, 4 or 8, averaged. For grey and color only; the other channels sample the center.
  int samples = 1;
};

/// Renders camera images of a scene off screen, without a display. The scene is copied once. A process may have several
/// objects of this class; each must be used by one thread at a time. Row 0 of a texture is at v = 0. Equal views give
/// equal pixels, in any order. The image of a lens other than an undistorted pinhole is composed of pinhole images
/// (LensFaces), which are laid out at the first image of the camera. Later images of the same camera and channel
/// allocate no memory, except that `tiles` may allocate for a view with more surfaces than before.
class Renderer {
 public:
  /// @param shadows  cast by static solids that are not flat, on all surfaces including moving obstacles.
  /// Throws std::invalid_argument for an inconsistent scene (an index out of range), InputError with the reason if this
  /// machine lacks the renderer (no other replaces it).
  explicit Renderer(const scenes::Scene& scene, Culling culling = Culling::frustum_and_horizon,
                    RendererKind kind = RendererKind::osmesa, Shadows shadows = Shadows::none);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Renders a view. @param out  created if its size or type differs, otherwise overwritten; row 0 is the top row.
  /// Throws std::invalid_argument for a camera that vision::check() rejects, a pose or time that is not finite, or a
  /// number of samples that require_samples() rejects. Textures are painted at the first image in grey or color; if
  /// their sizes differ, each such image throws std::invalid_argument.
  void draw(const CameraView& view, cv::Mat& out);

  /// Throws std::invalid_argument that lists the valid numbers if this number of samples per pixel is not possible.
  void require_samples(int samples);

  /// Statistics of the last image.
  struct Drawn {
    size_t stretches = 0;  ///< of the index buffer; one call draws all stretches of a face and channel
    size_t triangles = 0;
  };
  const Drawn& drawn() const;

  /// Returns the renderer in use: "tiles: Hedgehop; AVX2", or its name and vendor, driver and version of OpenGL.
  std::string info() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hedgehop::sim
