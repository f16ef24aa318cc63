#include "vision/flow/ground_velocity.h"

#include <algorithm>

#include "sim/fields/quantities.h"

namespace hedgehop::vision::flow {
namespace {

/// 8 x 8 patches, as in [Garratt2009] sec. 4 for the ground camera; 64 px in its image of 400 x 400.
ImageInterpolationConfig ground_grid(const camera::PinholeCamera& camera) {
  ImageInterpolationConfig grid;
  const int side_px = std::min(camera.width_px, camera.height_px);
  grid.rows = grid.cols = 8;
  grid.patch_px = std::max(16, side_px * 64 / 400);
  grid.margin_px = side_px * 28 / 400;
  return grid;
}

}  // namespace

GroundVelocity::GroundVelocity(const camera::PinholeCamera& camera, const Eigen::Isometry3d& X_BC)
    : camera_(camera), X_BC_(X_BC), flow_(ground_grid(camera), camera.width_px, camera.height_px) {}

std::optional<GroundVelocityReading> GroundVelocity::measure(const cv::Mat& grey, const ExposureMotion& exposure) {
  const FlowField& field = flow_.update(grey);
  const std::optional<ExposureMotion> last = last_;
  last_ = exposure;
  if (!last) return {};

  const double dt_s = seconds(exposure.t_ns - last->t_ns);
  // Gyros only: a filter correction would look like a rotation and feed back into the next velocity.
  const Eigen::AngleAxisd rotation(last->q_WB_gyro.conjugate() * exposure.q_WB_gyro);
  const FlowMotion motion{last->q_WB_est, rotation.axis() * (rotation.angle() / dt_s), last->height_above_ground_m,
                          dt_s};
  const std::optional<FlowVelocity> velocity = flow_velocity(field, camera_, X_BC_, motion);
  if (!velocity) return {};
  return GroundVelocityReading{*velocity, motion};
}

}  // namespace hedgehop::vision::flow
