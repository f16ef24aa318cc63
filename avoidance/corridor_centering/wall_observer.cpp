#include "avoidance/corridor_centering/wall_observer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "avoidance/heading.h"
#include "sim/fields/quantities.h"
#include "vision/corridor/corridor_space.h"

namespace hedgehop::avoidance::corridor_centering {
namespace {

using vision::corridor::CorridorRegions;
using vision::corridor::kAhead, vision::corridor::kLeft, vision::corridor::kRight;
using vision::corridor::WallPoint;

/// Maximum angle between the heading and the walls in the search, equal to that of the course.
constexpr double kMaxTurnRad = 50.0 * std::numbers::pi / 180.0;
/// Maximum share of vectors of a side that are too slow for a distance. Above it the side is unknown, because the
/// remaining vectors are biased to near points.
constexpr double kMaxSlowShare = 0.5;

constexpr CorridorRegions kWallRegions;  // [Zingg2010] sec. IV-D

vision::flow::FeatureFlowConfig features_of(Law law) {
  vision::flow::FeatureFlowConfig features;
  if (law == Law::published) features.round_trip_px = 0.0;
  return features;
}

/// [Zingg2010] sec. IV-D has two filters: for flow that is too large and for flow off the tangent. Both laws also
/// reject flow that is too slow for the division, because the vehicle may hover, and flow of the floor, because the
/// region of interest in the paper contains only walls.
vision::corridor::FlowLimits limits_of(Law law) {
  vision::corridor::FlowLimits limits;
  if (law == Law::published) limits.stray_rad = std::numbers::pi;
  return limits;
}

Eigen::Matrix3d R_WH(const Eigen::Quaterniond& q_WB) {
  return Eigen::AngleAxisd(heading_rad(q_WB), Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// Pixels that the corner search of the regions may read.
cv::Mat surroundings(const std::array<cv::Mat, vision::corridor::kRegions>& regions,
                     const vision::flow::FeatureFlowConfig& features) {
  cv::Mat wanted = regions[kLeft] | regions[kRight] | regions[kAhead];
  const int side_px = features.window_px << (features.levels - 1);  // of a window on the coarsest level
  cv::dilate(wanted, wanted, cv::Mat::ones(side_px | 1, side_px | 1, CV_8UC1));
  return wanted;
}

}  // namespace

WallObserver::WallObserver(Law law, double attitude_lag_s, const MountedCamera& camera)
    : law_(law),
      attitude_lag_s_(attitude_lag_s),
      camera_(camera),
      features_(features_of(law)),
      limits_(limits_of(law)),
      regions_(vision::corridor::region_masks(camera.model, camera.X_BC, kWallRegions, features_.window_px / 2)),
      derotator_(camera.model, surroundings(regions_, features_)),
      approach_({}, camera.model, camera.X_BC, kWallRegions, features_.window_px / 2) {}

/// Source: [Zingg2010] sec. IV-B. Differs: the direction of travel comes from the estimated velocity instead of
/// the heading, and the camera may have an offset from the center of rotation.
vision::corridor::CameraMotion WallObserver::motion(const NavigationState& now, double dt_s) const {
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

/// The median of a side. [Zingg2010] sec. IV-E. Modified law: unknown also if most of the vectors are too slow for a
/// distance.
vision::corridor::SideDistance WallObserver::side(const std::vector<WallPoint>& points,
                                                  vision::corridor::Region side) const {
  vision::corridor::SideDistance found = vision::corridor::side_distance(points, side, kMinVectors);
  if (law_ == Law::published) return found;
  const auto slow = std::ranges::count_if(points, [side](const WallPoint& point) {
    return point.region == side && point.rejection == vision::corridor::RejectionReason::too_slow;
  });
  const double tracked = static_cast<double>(slow) + found.count;
  if (static_cast<double>(slow) > kMaxSlowShare * tracked) {
    found.distance_m = std::numeric_limits<double>::quiet_NaN();
  }
  return found;
}

std::optional<WallObservation> WallObserver::update(const CameraFrame& frame, const NavigationState& estimate) {
  NavigationState navigation = estimate;
  // A lag cancels between two images of a steady turn, but not if the turn begins or ends.
  const Eigen::Vector3d turn_B = attitude_lag_s_ * estimate.w_WB_B_est;
  if (turn_B.norm() > 0.0) {
    const Eigen::Quaterniond on(Eigen::AngleAxisd(turn_B.norm(), turn_B.normalized()));
    navigation.q_WB_est = estimate.q_WB_est * on;
    navigation.q_WB_gyro = estimate.q_WB_gyro * on;
  }
  const cv::Mat older = std::exchange(image_, frame.image.clone());
  std::optional<WallObservation> seen;
  if (t_ns_ >= 0) seen = compare(older, navigation, seconds(frame.t_ns - t_ns_));
  t_ns_ = frame.t_ns;
  navigation_ = navigation;
  return seen;
}

WallObservation WallObserver::compare(const cv::Mat& older, const NavigationState& navigation, double dt_s) const {
  vision::corridor::CameraMotion moved = motion(navigation, dt_s);
  cv::Mat newer = image_;
  if (law_ == Law::modified) {
    newer = derotator_.derotate(image_, moved.R_HC1.transpose() * moved.R_HC2);
    moved.R_HC2 = moved.R_HC1;
  }
  const auto pairs = vision::flow::feature_flow(older, newer, regions_, camera_.model, features_);
  WallObservation seen;
  for (size_t k = 0; k < pairs.size(); ++k) {
    for (const vision::flow::RayPair& pair : pairs[k]) {
      seen.points.push_back(
          vision::corridor::wall_point(pair, static_cast<vision::corridor::Region>(k), camera_.model, moved, limits_));
    }
  }
  seen.corners_left = static_cast<int>(pairs[kLeft].size());
  seen.corners_right = static_cast<int>(pairs[kRight].size());
  if (law_ == Law::modified) {
    seen.direction_rad = vision::corridor::wall_direction_rad(seen.points, kMaxTurnRad, kMinVectors);
  }
  const std::vector<WallPoint> along = vision::corridor::rotate_points(seen.points, seen.direction_rad);
  seen.left = side(along, kLeft);
  seen.right = side(along, kRight);
  seen.error = vision::corridor::centering_error(seen.left.distance_m, seen.right.distance_m);
  seen.v_H = moved.traveled_H.head<2>() / moved.dt_s;
  if (law_ == Law::modified) seen.approach = approach_.measure(older, newer, moved);
  return seen;
}

}  // namespace hedgehop::avoidance::corridor_centering
