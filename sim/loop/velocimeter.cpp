#include "sim/loop/velocimeter.h"

namespace hedgehop::sim {

Velocimeter::Velocimeter(size_t camera, const Cameras& cameras)
    : camera_(camera), ground_(cameras.mounted(camera).model.pinhole(), cameras.mounted(camera).X_BC) {}

std::optional<dynamics::VelocityReading> Velocimeter::measure(const avoidance::CameraFrame& frame,
                                                              const dynamics::control::NavigationEstimate& navigation) {
  const auto reading = ground_.measure(
      frame.image, {frame.t_ns, navigation.q_WB_est, navigation.q_WB_gyro, navigation.height_above_ground_m});
  if (!reading) return {};
  return dynamics::VelocityReading{reading->velocity.v_WB_B_xy_meas, reading->velocity.sigma_mps};
}

}  // namespace hedgehop::sim
