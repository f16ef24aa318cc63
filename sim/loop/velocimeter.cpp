#include "sim/loop/velocimeter.h"

#include <algorithm>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

/// 8 x 8 patches, as in [Garratt2009] sec. 4 for the ground camera; 64 px in its image of 400 x 400.
vision::flow::ImageInterpolationConfig ground_grid(const vision::camera::PinholeCamera& camera) {
  vision::flow::ImageInterpolationConfig grid;
  const int side_px = std::min(camera.width_px, camera.height_px);
  grid.rows = grid.cols = 8;
  grid.patch_px = std::max(16, side_px * 64 / 400);
  grid.margin_px = side_px * 28 / 400;
  return grid;
}

}  // namespace

Velocimeter::Velocimeter(size_t camera, const Cameras& cameras)
    : camera_(camera),
      pinhole_(cameras.mounted(camera).model.pinhole()),
      X_BC_(cameras.mounted(camera).X_BC),
      flow_(ground_grid(pinhole_), pinhole_.width_px, pinhole_.height_px) {}

std::optional<dynamics::VelocityReading> Velocimeter::measure(const avoidance::CameraFrame& frame,
                                                              const dynamics::control::NavigationEstimate& navigation) {
  const vision::flow::FlowField& field = flow_.update(frame.image);
  const std::optional<Exposure> last = last_;
  last_ = Exposure{frame.t_ns, navigation.q_WB_est, navigation.q_WB_gyro, navigation.height_above_ground_m};
  if (!last) return {};

  const double dt_s = seconds(frame.t_ns - last->t_ns);
  // Gyros only: a filter correction would look like a rotation and feed back into the next velocity.
  const Eigen::AngleAxisd rotation(last->q_WB_gyro.conjugate() * navigation.q_WB_gyro);
  const vision::flow::FlowMotion motion{last->q_WB_est, rotation.axis() * (rotation.angle() / dt_s),
                                        last->height_above_ground_m, dt_s};
  const auto velocity = vision::flow::flow_velocity(field, pinhole_, X_BC_, motion);
  if (!velocity) return {};
  return dynamics::VelocityReading{velocity->v_WB_B_xy_meas, velocity->sigma_mps};
}

}  // namespace hedgehop::sim
