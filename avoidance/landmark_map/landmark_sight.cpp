#include "avoidance/landmark_map/landmark_sight.h"

#include <opencv2/imgproc.hpp>

namespace hedgehop::avoidance::landmark_map {

LandmarkSight::LandmarkSight(const LandmarkSightConfig& config, const MountedCamera& camera)
    : config_(config), camera_(camera), map_(config.map, camera.model.pinhole()) {
  vision::landmarks::check(config.corners);
}

CameraNeed LandmarkSight::need(const LandmarkSightConfig& config) {
  return {.role = "front",
          .channel = config.color ? CameraNeed::Channel::color : CameraNeed::Channel::grey,
          .pinhole = true,
          .true_corners = config.front_end == FrontEnd::corners};
}

bool LandmarkSight::update(const CameraFrame& frame, const NavigationState& navigation) {
  if (last_t_ns_ && frame.t_ns <= *last_t_ns_) return false;
  const double dt_s = last_t_ns_ ? 1e-9 * static_cast<double>(frame.t_ns - *last_t_ns_) : 0.0;
  last_t_ns_ = frame.t_ns;
  if (frame.image.channels() == 3) {
    cv::cvtColor(frame.image, grey_, cv::COLOR_RGB2GRAY);
  } else {
    frame.image.copyTo(grey_);
  }
  const bool images = config_.front_end == FrontEnd::images;
  corners_px_ = images ? vision::landmarks::edge_corners(frame.image, config_.corners) : frame.corners_px;

  Eigen::Isometry3d X_WB_est = Eigen::Isometry3d::Identity();
  X_WB_est.linear() = navigation.q_WB_est.toRotationMatrix();
  X_WB_est.translation() = navigation.p_WB_est;
  pose_ = {X_WB_est * camera_.X_BC, config_.map.position_sigma_m, config_.map.attitude_sigma_rad};
  filter_time_.start();
  map_.update(corners_px_, pose_, dt_s);
  filter_time_.stop();
  return true;
}

}  // namespace hedgehop::avoidance::landmark_map
