#include "avoidance/landmark_map/landmark_observer.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::landmark_map {
namespace {

/// Three standard deviations. With a wider gate a landmark takes the corners of its neighbors.
constexpr double kGate = 2.25;

vision::landmarks::LandmarkMapConfig with_law(vision::landmarks::LandmarkMapConfig map, Law law) {
  map.algorithm =
      law == Law::published ? vision::landmarks::MapAlgorithm::published : vision::landmarks::MapAlgorithm::modified;
  map.gate = kGate;
  return map;
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
    : config_(config), camera_(camera), map_(with_law(config.map, law), camera.model.pinhole()) {}

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
  map_.update(corners_px_, pose_, dt_s);
  filter_time_.stop();
  return true;
}

}  // namespace hedgehop::avoidance::landmark_map
