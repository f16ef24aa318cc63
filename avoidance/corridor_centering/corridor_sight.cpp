#include "avoidance/corridor_centering/corridor_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "avoidance/heading.h"
#include "vision/corridor/wall_direction.h"

namespace hedgehop::avoidance::corridor_centering {
namespace {

Eigen::Matrix3d R_WH(const Eigen::Quaterniond& q_WB) {
  return Eigen::AngleAxisd(heading_rad(q_WB), Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// Pixels that the search for corners of the regions may look at.
cv::Mat round_about(const std::array<cv::Mat, vision::corridor::kRegions>& regions,
                    const vision::flow::FeatureFlowConfig& features) {
  cv::Mat wanted =
      regions[vision::corridor::kLeft] | regions[vision::corridor::kRight] | regions[vision::corridor::kAhead];
  const int side_px = features.window_px << (features.levels - 1);  // of a window on the coarsest level
  cv::dilate(wanted, wanted, cv::Mat::ones(side_px | 1, side_px | 1, CV_8UC1));
  return wanted;
}

}  // namespace

CorridorSight::CorridorSight(const CorridorSightConfig& config, const MountedCamera& camera)
    : config_(config),
      camera_(camera),
      regions_(
          vision::corridor::region_masks(camera.model, camera.X_BC, config.regions, config.features.window_px / 2)),
      turner_(camera.model, round_about(regions_, config.features)),
      approach_(config.approach, camera.model, camera.X_BC, config.regions, config.features.window_px / 2) {
  if (config.least_vectors < 1) throw std::invalid_argument("least_vectors: must be at least 1");
}

/// Source: [Zingg2010] sec. IV-B. Differs: the direction of travel is that of the velocity estimated, not the nose's,
/// and the camera may sit away from where the vehicle turns.
vision::corridor::CameraMotion CorridorSight::motion(const NavigationState& now, double dt_s) const {
  const Eigen::Matrix3d R_HW = R_WH(now.q_WB_est).transpose();
  const Eigen::Matrix3d R_HB2 = R_HW * now.q_WB_est;
  const Eigen::Matrix3d R_HB1 = R_HB2 * (now.q_WB_gyro.conjugate() * navigation_.q_WB_gyro);
  const Eigen::Vector3d v_WB_H = 0.5 * (R_HB1 * navigation_.v_WB_B_est + R_HB2 * now.v_WB_B_est);
  const Eigen::Vector3d p_BC_B = camera_.X_BC.translation();
  vision::corridor::CameraMotion motion;
  motion.R_HC1 = R_HB1 * camera_.X_BC.linear();
  motion.R_HC2 = R_HB2 * camera_.X_BC.linear();
  motion.traveled_H = v_WB_H * dt_s + (R_HB2 - R_HB1) * p_BC_B;
  motion.dt_s = dt_s;
  motion.height_m = now.height_above_ground_m - (R_HB2 * p_BC_B).z();
  return motion;
}

/// The median of a side; unknown too where so many corners are too slow that those left are the near ones.
vision::corridor::SideDistance CorridorSight::side(const std::vector<vision::corridor::WallPoint>& points,
                                                   vision::corridor::Region side) const {
  vision::corridor::SideDistance found = vision::corridor::side_distance(points, side, config_.least_vectors);
  const auto slow = std::ranges::count_if(points, [side](const vision::corridor::WallPoint& point) {
    return point.region == side && point.rejection == vision::corridor::RejectionReason::too_slow;
  });
  const double followed = static_cast<double>(slow) + found.count;
  if (static_cast<double>(slow) > config_.most_slow * followed) {
    found.distance_m = std::numeric_limits<double>::quiet_NaN();
  }
  return found;
}

std::optional<CorridorView> CorridorSight::update(const CameraFrame& frame, const NavigationState& estimate) {
  NavigationState navigation = estimate;
  // A lag cancels between two images of an even turn, but not of one that begins or ends.
  const Eigen::Vector3d turn_B = config_.attitude_lag_s * estimate.w_WB_B_est;
  if (turn_B.norm() > 0.0) {
    const Eigen::Quaterniond on(Eigen::AngleAxisd(turn_B.norm(), turn_B.normalized()));
    navigation.q_WB_est = estimate.q_WB_est * on;
    navigation.q_WB_gyro = estimate.q_WB_gyro * on;
  }
  const cv::Mat older = std::exchange(image_, frame.image.clone());
  std::optional<CorridorView> view;
  if (t_ns_ >= 0) {
    using vision::corridor::kLeft, vision::corridor::kRight;
    vision::corridor::CameraMotion moved = motion(navigation, 1e-9 * static_cast<double>(frame.t_ns - t_ns_));
    cv::Mat newer = image_;
    if (config_.derotation == CorridorSightConfig::Derotation::image) {
      newer = turner_.derotate(image_, moved.R_HC1.transpose() * moved.R_HC2);
      moved.R_HC2 = moved.R_HC1;
    }
    const auto pairs = vision::flow::feature_flow(older, newer, regions_, camera_.model, config_.features);
    view.emplace();
    for (size_t k = 0; k < pairs.size(); ++k) {
      for (const vision::flow::RayPair& pair : pairs[k]) {
        view->points.push_back(vision::corridor::wall_point(pair, static_cast<vision::corridor::Region>(k),
                                                            camera_.model, moved, config_.limits));
      }
    }
    view->corners_left = static_cast<int>(pairs[kLeft].size());
    view->corners_right = static_cast<int>(pairs[kRight].size());
    if (config_.across == CorridorSightConfig::Across::walls) {
      view->direction_rad =
          vision::corridor::wall_direction_rad(view->points, config_.most_turned_rad, config_.least_vectors);
    }
    const std::vector<vision::corridor::WallPoint> along =
        vision::corridor::rotate_points(view->points, view->direction_rad);
    view->left = side(along, kLeft);
    view->right = side(along, kRight);
    view->error = vision::corridor::centering_error(view->left.distance_m, view->right.distance_m);
    view->v_H = moved.traveled_H.head<2>() / moved.dt_s;
    view->approach = approach_.measure(older, newer, moved);
  }
  t_ns_ = frame.t_ns;
  navigation_ = navigation;
  return view;
}

}  // namespace hedgehop::avoidance::corridor_centering
