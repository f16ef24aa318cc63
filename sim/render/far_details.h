#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "scenes/scene.h"
#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// A chunk is drawn as its far detail if each part that the far detail omits is at most this wide in the image, px.
inline constexpr double kMaxLostPx = 1.0;

/// Selects the far detail of chunks whose full detail the image cannot resolve. The choice depends on the focal length
/// and on z in C of the boxes only, so that both cameras of a rectified stereo pair draw the same surfaces.
class FarDetails {
 public:
  FarDetails(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC)
      : forward_W_(X_WC.linear().col(2)),
        eye_m_(forward_W_.dot(X_WC.translation())),
        z_per_lost_(std::max(camera.focal_x_px, camera.focal_y_px) / kMaxLostPx) {}

  /// Returns whether a chunk is drawn as its far detail.
  bool suffices(const scenes::FarDetail& far, const Eigen::AlignedBox3f& box_W) const {
    return far.index_count > 0 && !(nearest_z_m(box_W) < z_per_lost_ * far.lost_m);
  }

  /// Returns the stretch of the index buffer to draw: the chunk or its far detail.
  scenes::Chunk detail_for_view(const scenes::Chunk& chunk) const {
    if (!suffices(chunk.far, chunk.box_W)) return chunk;
    scenes::Chunk far = chunk;
    far.first_index = chunk.far.first_index;
    far.index_count = chunk.far.index_count;
    return far;
  }

 private:
  double nearest_z_m(const Eigen::AlignedBox3f& box_W) const {
    const double half_m = 0.5 * forward_W_.cwiseAbs().dot(box_W.sizes().cast<double>());
    return forward_W_.dot(box_W.center().cast<double>()) - half_m - eye_m_;
  }

  Eigen::Vector3d forward_W_;
  double eye_m_;
  double z_per_lost_;
};

}  // namespace hedgehop::sim
