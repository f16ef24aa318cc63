#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "scenes/scene.h"
#include "sim/render/gl_context.h"
#include "vision/pinhole_camera.h"

namespace hedgehop::sim {

/// What a picture holds.
enum class Channel {
  grey,   ///< CV_8UC1, the mean of the colour picture's channels
  color,  ///< CV_8UC3, RGB
  depth,  ///< CV_32FC1, z in C, m; +infinity where nothing but sky is seen
};

/// One picture to be drawn. C: x right, y down, z forward; pixel (0, 0) is the centre of the top-left pixel.
struct CameraView {
  vision::PinholeCamera camera;
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  Channel channel = Channel::grey;
};

/// How much of a scene is left out before it is drawn. Pictures do not depend on it, only their cost does (but for a
/// pixel that looks through a crack of a mesh: it may see something else behind).
enum class Culling { none, frustum, frustum_and_horizon };

/// Nothing nearer than this is drawn, z in C.
inline constexpr double kNearPlaneM = 0.05;

/// Draws a scene off screen, without a display (OpenGL 3.3 core). The scene is copied to the context once. Several
/// renderers may live in one process; each is used by one thread at a time. Row 0 of a texture lies at v = 0. Equal
/// views give equal pixels whatever their number.
class Renderer {
 public:
  /// Throws std::invalid_argument when the scene contradicts itself (an index out of range, textures of several sizes),
  /// std::runtime_error with the cause when there is no OpenGL context or a shader does not compile.
  explicit Renderer(const scenes::Scene& scene, Culling culling = Culling::frustum_and_horizon,
                    ContextKind context = ContextKind::osmesa);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Draws a view. @param out  created when its size or type does not fit, otherwise written in place, row 0 on top.
  /// Throws std::invalid_argument for a camera without pixels or focal length, or a pose that is not finite.
  void draw(const CameraView& view, cv::Mat& out);

  /// What the last picture was made of.
  struct Drawn {
    size_t stretches = 0;  ///< of the index buffer, all drawn by one call
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
