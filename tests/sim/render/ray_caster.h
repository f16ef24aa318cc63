#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "sim/render/renderer.h"

/// Images of boxes and ground by ray casting: an oracle that is independent of the rasterizers.
namespace hedgehop::sim {

/// The first intersection of a ray. `face` identifies the face of the body; -1 if there is no intersection.
struct Hit {
  double distance_m = std::numeric_limits<double>::infinity();
  double z_m = std::numeric_limits<double>::infinity();  ///< in C
  int face = -1;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();

  /// 0 for the ground, 1 + i for box i.
  int body() const { return (face + 2) / 3; }
};

/// Boxes and the plane z = 0, intersected analytically (slabs) from outside.
struct RayCaster {
  std::vector<Eigen::AlignedBox3d> boxes_W;
  double ground_half_m = 0.0;

  /// @param ray_W  of length 1.
  Hit operator()(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& ray_W) const {
    Hit hit;
    const double ground = -eye_W.z() / ray_W.z();
    const Eigen::Vector3d p_W = eye_W + ground * ray_W;
    const bool on_ground = p_W.head<2>().cwiseAbs().maxCoeff() <= ground_half_m;
    if (ray_W.z() > 0.0 && ground > 0.0 && on_ground) hit = {ground, 0.0, 0};
    for (size_t i = 0; i < boxes_W.size(); ++i) {
      double in = -std::numeric_limits<double>::infinity(), out = -in;
      int axis_in = 0;
      for (int axis = 0; axis < 3; ++axis) {
        double a = (boxes_W[i].min()[axis] - eye_W[axis]) / ray_W[axis];
        double b = (boxes_W[i].max()[axis] - eye_W[axis]) / ray_W[axis];
        if (a > b) std::swap(a, b);
        if (a > in) axis_in = axis;
        in = std::max(in, a);
        out = std::min(out, b);
      }
      if (in < out && in > 0.0 && in < hit.distance_m) hit = {in, 0.0, 1 + 3 * static_cast<int>(i) + axis_in};
    }
    hit.p_W = eye_W + hit.distance_m * ray_W;
    return hit;
  }
};

/// Returns the hit of a pixel; none within `edge_px` of an edge, at which the rasterizer may choose either side, and
/// none outside the image circle.
inline std::optional<Hit> clear_hit(const RayCaster& cast, const CameraView& view, int col, int row, double edge_px) {
  const auto at = [&](double du, double dv) -> std::optional<Hit> {
    const auto ray_C = view.camera.unit_ray({col + du, row + dv});
    if (!ray_C) return std::nullopt;
    Hit hit = cast(view.X_WC.translation(), view.X_WC.linear() * *ray_C);
    hit.z_m = hit.distance_m * ray_C->z();
    return hit;
  };
  const std::optional<Hit> center = at(0, 0);
  if (!center) return std::nullopt;
  // A wide neighborhood is also searched for slivers.
  const int steps = edge_px > 0.1 ? 6 : 1;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const std::optional<Hit> neighbor = at((2.0 * i / steps - 1.0) * edge_px, (2.0 * j / steps - 1.0) * edge_px);
      if (!neighbor || neighbor->face != center->face) return std::nullopt;
    }
  }
  return center;
}

}  // namespace hedgehop::sim
