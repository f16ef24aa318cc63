#include "avoidance/camera_flow.h"

#include "sim/fields/quantities.h"

namespace hedgehop::avoidance {

Eigen::Vector3d velocity_in_camera(const Eigen::Isometry3d& X_BC, const NavigationState& navigation) {
  const Eigen::Vector3d v_WC_B = navigation.v_WB_B_est + navigation.w_WB_B_est.cross(X_BC.translation());
  return X_BC.linear().transpose() * v_WC_B;
}

CameraFlow::CameraFlow(const MountedCamera& camera, const Options& options)
    : camera_(camera),
      pinhole_(camera.model.pinhole()),
      options_(options),
      flow_(options.flow, camera.model.width_px, camera.model.height_px),
      field_(flow_.field()) {}

bool CameraFlow::update(const CameraFrame& frame, const Eigen::Vector3d& w_WB_B) {
  if (last_t_ns_ && frame.t_ns <= *last_t_ns_) return false;
  field_ = flow_.update(frame.image);
  frame.image.copyTo(image_);
  const bool first = !last_t_ns_;
  const double dt_s = first ? 0.0 : seconds(frame.t_ns - *last_t_ns_);
  const Eigen::Vector3d w_mean_B = 0.5 * (w_WB_B + last_w_WB_B_);
  last_t_ns_ = frame.t_ns;
  last_w_WB_B_ = w_WB_B;
  if (first) return false;

  if (options_.derotate) {
    const Eigen::Vector3d w_WC_C = camera_.X_BC.linear().transpose() * w_mean_B;
    vision::flow::derotate(field_, pinhole_, w_WC_C, dt_s);
  }
  const auto flow = vision::flow::mean_horizontal_flow(field_, pinhole_, dt_s, options_.missing);
  measure_ = Measure{flow.value, vision::flow::loom(field_, dt_s, options_.missing).value, field_.valid_share(), dt_s};
  return true;
}

std::optional<CameraFlow::Measure> CameraFlow::measure(int64_t now_ns) const {
  constexpr double kFreshPeriods = 3.0;  // an older measurement belongs to another position
  if (!measure_ || seconds(now_ns - *last_t_ns_) > kFreshPeriods / camera_.rate_hz) {
    return std::nullopt;
  }
  return measure_;
}

}  // namespace hedgehop::avoidance
