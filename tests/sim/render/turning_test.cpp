#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>

#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"
#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;

// A box that turns about a tilted axis while it moves east.
struct TurningBox {
  Vector3d half_m{0.6, 1.1, 1.7};
  Vector3d axis_W = Vector3d(0.3, -0.5, 0.8).normalized();
  double rate_radps = 0.9;

  Vector3d center_W(double t_s) const { return {9.0, -1.0 + 0.8 * t_s, -5.0}; }
  Eigen::Matrix3d rotation(double t_s) const { return Eigen::AngleAxisd(rate_radps * t_s, axis_W).toRotationMatrix(); }

  scenes::Motion motion() const {
    std::vector<scenes::PoseRow> rows;
    for (int i = 0; i <= 100; ++i) {
      const double t_s = 0.05 * i;
      rows.push_back({t_s, center_W(t_s), Eigen::Quaterniond(Eigen::AngleAxisd(rate_radps * t_s, axis_W))});
    }
    return scenes::TableMotion{.poses = std::make_shared<const scenes::PoseTable>(rows)};
  }

  /// Returns the first point of a ray in the box, in W: slabs in the frame of the box. @param axis  normal of the face.
  std::optional<Vector3d> hit_W(const Vector3d& from_W, const Vector3d& ray_W, double t_s, int& axis) const {
    const Vector3d from = rotation(t_s).transpose() * (from_W - center_W(t_s));
    const Vector3d ray = rotation(t_s).transpose() * ray_W;
    double enter = 0.0, leave = 1e9;
    for (int i = 0; i < 3; ++i) {
      const double a = (-half_m[i] - from[i]) / ray[i], b = (half_m[i] - from[i]) / ray[i];
      if (std::min(a, b) > enter) axis = i;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter >= leave) return std::nullopt;
    return from_W + enter * ray_W;
  }
};

scenes::Scene scene_of(const TurningBox& box) {
  SmallWorld world, own;
  own.add_box(Eigen::AlignedBox3d(-box.half_m, box.half_m).cast<float>());
  world.scene.movers.push_back({"box", own.scene.meshes.front(), {}, box.motion()});
  return world.scene;
}

CameraView view_at(const vision::camera::Camera& camera, ImageChannel channel, double t_s) {
  CameraView view{camera, Eigen::Isometry3d::Identity(), channel, t_s};
  view.X_WC.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // looks north
  view.X_WC.translation() = Vector3d(0.5, 0.0, -5.0);
  view.next.t_s = t_s;
  view.next.X_WC = view.X_WC;
  return view;
}

TEST(TurningMovers, AreDrawnInTheirAttitudeAtThatTime) {
  const TurningBox box;
  Renderer renderer = make_renderer(scene_of(box));
  const auto camera = vision::camera::PinholeCamera::from_fov(160, 120, 1.2);
  constexpr double kEdgePx = 0.1, kDepthShare = 1e-4;
  int on_box = 0;
  for (const double t_s : {0.0, 0.7, 1.93, 3.1, 4.4}) {
    const CameraView view = view_at(camera, ImageChannel::depth, t_s);
    cv::Mat depth;
    renderer.draw(view, depth);
    int axis = 0;
    const auto hit = [&](double u, double v) {
      return box.hit_W(view.X_WC.translation(), view.X_WC.linear() * camera.ray_at_unit_depth({u, v}), t_s, axis);
    };
    for (int v = 0; v < depth.rows; ++v) {
      for (int u = 0; u < depth.cols; ++u) {
        const auto here = hit(u, v);
        const bool edge = hit(u - kEdgePx, v).has_value() != here.has_value() ||
                          hit(u + kEdgePx, v).has_value() != here.has_value() ||
                          hit(u, v - kEdgePx).has_value() != here.has_value() ||
                          hit(u, v + kEdgePx).has_value() != here.has_value();
        if (edge) continue;
        const double z_m = here ? (view.X_WC.inverse() * *here).z() : HUGE_VAL;
        ASSERT_EQ(std::isfinite(depth.at<float>(v, u)), here.has_value()) << u << " " << v << " at " << t_s << " s";
        if (!here) continue;
        ASSERT_NEAR(depth.at<float>(v, u), z_m, kDepthShare * z_m) << u << " " << v << " at " << t_s << " s";
        ++on_box;
      }
    }
  }
  EXPECT_GT(on_box, 2000);
}

TEST(TurningMovers, HaveTheFlowOfTheirPoints) {
  const TurningBox box;
  Renderer renderer = make_renderer(scene_of(box));
  std::mt19937_64 random(11);
  constexpr double kTurningFlowPx = 0.05, kEdgePx = 2.5;
  int on_box = 0;
  for (const vision::camera::Camera& camera :
       {vision::camera::Camera(vision::camera::PinholeCamera::from_fov(160, 120, 1.2)),
        vision::random_fisheye(random)}) {
    CameraView view = view_at(camera, ImageChannel::flow, 1.3);
    view.next.t_s = 1.5;
    view.next.X_WC.translation() += Vector3d(0.3, 0.1, -0.1);
    cv::Mat flow;
    renderer.draw(view, flow);
    int axis = 0;
    const auto hit = [&](double u, double v) -> std::optional<Vector3d> {
      const auto ray_C = camera.unit_ray({u, v});
      if (!ray_C) return std::nullopt;
      return box.hit_W(view.X_WC.translation(), view.X_WC.linear() * *ray_C, view.t_s, axis);
    };
    for (int v = 0; v < flow.rows; ++v) {
      for (int u = 0; u < flow.cols; ++u) {
        const auto here = hit(u, v);
        if (!here) continue;
        const int face = axis;
        const auto on_face = [&](double at_u, double at_v) { return hit(at_u, at_v).has_value() && axis == face; };
        // A lens draws an edge of the box from several pixels.
        if (!on_face(u - kEdgePx, v) || !on_face(u + kEdgePx, v) || !on_face(u, v - kEdgePx) ||
            !on_face(u, v + kEdgePx))
          continue;
        const Eigen::Matrix3d turned = box.rotation(view.next.t_s) * box.rotation(view.t_s).transpose();
        const Vector3d next_W = box.center_W(view.next.t_s) + turned * (*here - box.center_W(view.t_s));
        const auto next = camera.project(view.next.X_WC.inverse() * next_W);
        if (!next) continue;
        EXPECT_NEAR(flow.at<cv::Vec2f>(v, u)[0], next->x() - u, kTurningFlowPx) << u << " " << v;
        EXPECT_NEAR(flow.at<cv::Vec2f>(v, u)[1], next->y() - v, kTurningFlowPx) << u << " " << v;
        ++on_box;
      }
    }
  }
  EXPECT_GT(on_box, 500);
}

}  // namespace
}  // namespace hedgehop::sim
