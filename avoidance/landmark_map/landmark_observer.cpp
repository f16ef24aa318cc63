#include "avoidance/landmark_map/landmark_observer.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::landmark_map {
namespace {

/// Three standard deviations. With a wider gate a landmark takes the corners of its neighbors.
constexpr double kGate = 2.25;
/// The adjustment divides by the uncertainties, of which the filter also accepts 0.
constexpr double kMinPositionSigmaM = 1e-3, kMinAttitudeSigmaRad = 1e-5;

vision::landmarks::LandmarkMapConfig with_law(vision::landmarks::LandmarkMapConfig map, Law law) {
  map.algorithm =
      law == Law::published ? vision::landmarks::MapAlgorithm::published : vision::landmarks::MapAlgorithm::modified;
  map.gate = kGate;
  return map;
}

vision::landmarks::LandmarkBundle bundle_of(const LandmarkObserverConfig& config, const MountedCamera& camera) {
  const vision::landmarks::LandmarkBundleConfig& c = fields::require_bounds(config.adjustment, "adjustment");
  const vision::landmarks::BundleNoise noise{
      .bearing = c.pixel_sigma_px / camera.model.pinhole().focal_x_px,
      .position_m = std::max(config.map.position_sigma_m, kMinPositionSigmaM),
      .attitude_rad = std::max(config.map.attitude_sigma_rad, kMinAttitudeSigmaRad),
      .step_m_rt_s = c.position_drift_m_rt_s,
      .turn_rad_rt_s = c.attitude_drift_rad_rt_s};
  return {camera.X_BC, noise, config.map.correlation_s};
}

CameraNeed::Channel channel(CornerSource source) {
  switch (source) {
    case CornerSource::grey:
      return CameraNeed::Channel::grey;
    case CornerSource::color:
      return CameraNeed::Channel::color;
    case CornerSource::corners:
      return CameraNeed::Channel::corners;
  }
  throw std::logic_error("unknown source of corners");
}

std::vector<Eigen::Vector2d> listed_corners(const cv::Mat& corners) {
  std::vector<Eigen::Vector2d> listed;
  for (int i = 0; i < corners.rows; ++i) {
    const auto& pixel = corners.at<cv::Vec2d>(i);
    listed.emplace_back(pixel[0], pixel[1]);
  }
  return listed;
}

}  // namespace

LandmarkObserver::LandmarkObserver(const LandmarkObserverConfig& config, Law law, const MountedCamera& camera)
    : config_(config), camera_(camera), map_(with_law(config.map, law), camera.model.pinhole()) {
  if (law == Law::modified) bundle_.emplace(bundle_of(config, camera));
}

CameraNeed LandmarkObserver::need(const LandmarkObserverConfig& config) {
  return {.role = "front", .channel = channel(config.source), .pinhole = true};
}

bool LandmarkObserver::update(const CameraFrame& frame, const NavigationState& navigation) {
  if (last_t_ns_ && frame.t_ns <= *last_t_ns_) return false;
  const double dt_s = last_t_ns_ ? seconds(frame.t_ns - *last_t_ns_) : 0.0;
  last_t_ns_ = frame.t_ns;
  if (config_.source == CornerSource::corners) {
    corners_px_ = listed_corners(frame.image);
  } else {
    if (frame.image.channels() == 3) {
      cv::cvtColor(frame.image, grey_, cv::COLOR_RGB2GRAY);
    } else {
      frame.image.copyTo(grey_);
    }
    corners_px_ = vision::landmarks::edge_corners(frame.image, config_.least_corner_angle_rad);
  }

  Eigen::Isometry3d X_WB_est = Eigen::Isometry3d::Identity();
  X_WB_est.linear() = navigation.q_WB_est.toRotationMatrix();
  X_WB_est.translation() = navigation.p_WB_est;
  pose_ = {X_WB_est * camera_.X_BC, config_.map.position_sigma_m, config_.map.attitude_sigma_rad};
  filter_time_.start();
  const std::vector<int64_t> ids = map_.update(corners_px_, pose_, dt_s);
  if (bundle_) adjust(navigation, X_WB_est, dt_s, ids);
  filter_time_.stop();
  return true;
}

/// Adds the image to the bundle and corrects the map by it if that is due.
void LandmarkObserver::adjust(const NavigationState& navigation, const Eigen::Isometry3d& X_WB_est, double dt_s,
                              std::span<const int64_t> ids) {
  std::vector<Eigen::Vector2d> bearings;
  for (const Eigen::Vector2d& corner : corners_px_) {
    bearings.emplace_back(camera_.model.pinhole().ray_at_unit_depth(corner).head<2>());
  }
  bundle_->add({X_WB_est, X_WB_est.linear() * navigation.v_WB_B_est, navigation.q_WB_gyro.toRotationMatrix()}, dt_s,
               bearings, ids);
  if (bundle_->is_due()) map_.refine(bundle_->adjust(map_.landmarks()));
}

}  // namespace hedgehop::avoidance::landmark_map
