#include "avoidance/stereo/stereo_sight.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hedgehop::avoidance::stereo {
namespace {

const MountedCamera& camera_of(const Setup& setup, const std::string& role) {
  const auto camera = std::ranges::find(setup.cameras, role, &MountedCamera::role);
  if (camera == setup.cameras.end()) throw std::invalid_argument("a stereo pair needs a camera '" + role + "'");
  return *camera;
}

vision::stereo::StereoGeometry geometry_of(const MountedCamera& left, const MountedCamera& right) {
  const vision::camera::PinholeCamera a = left.model.pinhole();
  const Eigen::Isometry3d X_LR = left.X_BC.inverse() * right.X_BC;
  constexpr double kNoTurn = 1e-9, kNoOffsetM = 1e-6;
  const bool parallel = (X_LR.linear() - Eigen::Matrix3d::Identity()).norm() < kNoTurn;
  const bool beside = X_LR.translation().tail<2>().norm() < kNoOffsetM && X_LR.translation().x() > 0.0;
  if (!(left.model == right.model) || !parallel || !beside || a.focal_x_px != a.focal_y_px) {
    throw std::invalid_argument("cameras '" + left.role + "' and '" + right.role +
                                "' must be equal pinholes with square pixels, parallel, the second to the right of the "
                                "first");
  }
  if (left.rate_hz != right.rate_hz) throw std::invalid_argument("the two cameras of a stereo pair need one rate");
  return {a.focal_x_px, a.center_u_px, a.center_v_px, X_LR.translation().x()};
}

}  // namespace

Needs StereoSight::needs() {
  constexpr bool kPinhole = true;
  return {{{kLeft, CameraNeed::Channel::grey, kPinhole}, {kRight, CameraNeed::Channel::grey, kPinhole}}};
}

StereoSight::StereoSight(const vision::stereo::StereoMatcherConfig& config, const Setup& setup) : matcher_(config) {
  const MountedCamera& left = camera_of(setup, kLeft);
  geometry_ = geometry_of(left, camera_of(setup, kRight));
  X_BC_ = left.X_BC;
  image_ = {left.model.width_px, left.model.height_px};
}

bool StereoSight::update(std::span<const CameraFrame> frames) {
  const auto left = std::ranges::find(frames, kLeft, &CameraFrame::role);
  const auto right = std::ranges::find(frames, kRight, &CameraFrame::role);
  if (left == frames.end() || right == frames.end() || left->t_ns != right->t_ns || left->t_ns <= t_ns_) return false;
  t_ns_ = left->t_ns;
  left->image.copyTo(grey_);
  matcher_.match(left->image, right->image, disparity16_);
  return true;
}

}  // namespace hedgehop::avoidance::stereo
