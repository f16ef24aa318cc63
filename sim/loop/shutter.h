#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <opencv2/core.hpp>

#include "sim/scenario/rig.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Pose and motion of B at an instant, and the clearance.
struct BodyMotion {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_WB_W = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();  ///< rad/s
  double clearance_m = 0.0;                          ///< distance of the nearest object from the hull; 0: unknown

  /// Returns the pose a moment later (or earlier) at constant velocities. @param dt_s  short enough for that.
  Eigen::Isometry3d X_WB_after(double dt_s) const;
};

/// Renders some rows of a camera's image, `dt_s` after the image's instant, from a body at X_WB. The image is written
/// in place if it fits.
using DrawRows = std::function<void(const Eigen::Isometry3d& X_WB, double dt_s, const cv::Range& rows, cv::Mat& out)>;

/// Exposes one camera's images: the rows one after the other for a rolling shutter, each the mean of several moments
/// for motion blur, as the config says. Exposure ends at the image's instant. The moments divide it evenly, each in the
/// middle of its part; there is one per 0.4 px that the image moves, at least 1 and at most
/// `shutter_samples`.
class Shutter {
 public:
  explicit Shutter(const ImperfectionsConfig& config) : config_(config) {}

  /// @param image_speed_pxps  maximum speed of points in the image, >= 0. @param rows  of the image. @param out  the
  /// image, of the type that `draw` gives: of 8 bits if the image moves.
  void expose(const BodyMotion& body, double image_speed_pxps, int rows, const DrawRows& draw, cv::Mat& out) const;

 private:
  void expose_strip(const BodyMotion& body, double end_s, int moments, const cv::Range& rows, const DrawRows& draw,
                    cv::Mat& out) const;

  ImperfectionsConfig config_;
  mutable cv::Mat strip_, sums_;  ///< scratch
};

/// Returns the camera that shows some rows of another camera's image.
vision::camera::Camera cut(const vision::camera::Camera& camera, const cv::Range& rows);

}  // namespace hedgehop::sim
