#include "avoidance/section_grid/upright_view.h"

#include <array>
#include <cmath>

namespace hedgehop::avoidance::section_grid {
namespace {

/// Returns the number of clockwise quarter turns of an image that make a direction of C point down.
int turns_for(const Eigen::Vector3d& down_C) {
  if (std::abs(down_C.x()) > std::abs(down_C.y())) return down_C.x() > 0.0 ? 1 : 3;
  return down_C.y() < 0.0 ? 2 : 0;
}

/// Returns the camera of images that are turned clockwise by 90 degrees: (u, v) becomes (height - 1 - v, u).
SectionCamera turned(const SectionCamera& camera) {
  SectionCamera out = camera;
  out.geometry.center_u_px = camera.image.height - 1 - camera.geometry.center_v_px;
  out.geometry.center_v_px = camera.geometry.center_u_px;
  out.image = {camera.image.height, camera.image.width};
  out.X_BC.linear().col(0) = -camera.X_BC.linear().col(1);
  out.X_BC.linear().col(1) = camera.X_BC.linear().col(0);
  return out;
}

}  // namespace

UprightView::UprightView(const SectionCamera& mounted)
    : turns_(turns_for(mounted.X_BC.linear().row(2).transpose())), camera_(mounted) {
  for (int i = 0; i < turns_; ++i) camera_ = turned(camera_);
}

void UprightView::rotate(const cv::Mat& mounted, cv::Mat& upright) const {
  constexpr std::array kTurns{cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180, cv::ROTATE_90_COUNTERCLOCKWISE};
  if (turns_ == 0) {
    upright = mounted;
  } else {
    cv::rotate(mounted, upright, kTurns[static_cast<size_t>(turns_ - 1)]);
  }
}

}  // namespace hedgehop::avoidance::section_grid
