#include "avoidance/section_grid/section_pilot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "avoidance/heading.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::section_grid {

Eigen::Vector3d direction_B(Answer answer, const Eigen::Vector3d& ray_B, double side, bool recedes) {
  const double back = recedes ? 1.0 : 0.0;
  switch (answer) {
    case Answer::waypoint:
      return ray_B.normalized();
    case Answer::heading:
      return Eigen::Vector3d(ray_B.x(), ray_B.y(), 0.0).normalized();
    case Answer::sideways:
      return Eigen::Vector3d(-back, side, 0.0).normalized();
    case Answer::climb:
      return {0.0, 0.0, -1.0};
    case Answer::combined:
      return Eigen::Vector3d(-back, side, -1.0).normalized();
  }
  throw std::logic_error("unknown answer");
}

bool faces_path(Answer answer) { return answer == Answer::waypoint || answer == Answer::heading; }

SectionPilot::SectionPilot(const SectionGridConfig& config)
    : answer_(config.answer), keep_share_(config.keep_share), lowest_m_(config.lowest_m) {}

void SectionPilot::reset(const SectionCamera& camera, double radius_m) {
  camera_ = camera;
  radius_m_ = radius_m;
  state_ = State::cruise;
  mover_ = {};
  turn_ = 1.0;
  aside_W_.reset();
  post_W_.reset();
  away_ = 1.0;
  watched_rad_.reset();
  sweep_.reset();
  level_z_W_.reset();
  flown_ = false;
}

Command SectionPilot::update(const SectionView& view, const Goal& goal) {
  const auto& [search, choice, passed, seen, reach_m, navigation] = view;
  if (!flown_ && (goal.p_WG - navigation.p_WB_est).norm() < reach_m) post_W_ = goal.p_WG;
  flown_ = true;
  const bool hovers = post_W_ && !faces_path(answer_);
  // A turn is always completed: images during the turn do not show the final direction.
  if (choice.section < 0 && !mover_.is_turning() && !hovers) return hover_and_yaw(view, goal);

  const bool looked_round = state_ == State::hover_and_yaw;
  const bool arrived = aside_W_ && (*aside_W_ - navigation.p_WB_est).norm() < kArrivedM;
  // If the section straight ahead were not free, the next image would block the route again, closer to the obstacle.
  const bool resumes = !post_W_ && search.share(search.center()) <= keep_share_ && is_free(goal.p_WG, view);
  if (aside_W_ && (arrived || resumes)) {
    if (post_W_) post_W_ = aside_W_;
    aside_W_.reset();
    state_ = State::resume;
  }
  const Eigen::Vector3d& end_W = aside_W_ ? *aside_W_ : post_W_ ? *post_W_ : goal.p_WG;
  const bool off_route = hovers ? is_approached(view) && !aside_W_ : !mover_.is_turning() && is_blocked(end_W, view);
  if (looked_round || off_route) {
    if (!looked_round && !aside_W_ && !hovers) {
      choose_side(section_ray_C(camera_, search, choice.section).x(), navigation, goal);
    }
    aside_W_ = position_W(navigation, search, choice.section < 0 ? choice.best : choice.section, reach_m);
    state_ = State::avoid;
  }
  if (aside_W_ && !faces_path(answer_))
    return PositionCommand{*aside_W_, watched_rad_.value_or(heading_rad(navigation.q_WB_est))};
  if (aside_W_) return mover_.go_to(*aside_W_, navigation);
  if (post_W_) {
    state_ = State::cruise;
    return PositionCommand{*post_W_, watched_rad_.value_or(goal.heading_rad)};
  }
  const Command command = mover_.go_to(descent_W(goal.p_WG, view), navigation);
  if (!mover_.is_turning()) state_ = State::cruise;
  return command;
}

/// Returns a position over or at `end_W`, as low as images have shown the path to be free; at the vehicle's altitude if
/// no descent is free. It therefore does not descend into an obstacle that it has climbed over and no longer sees. The
/// tested path descends first, because a slow vehicle sinks faster than it moves ahead.
Eigen::Vector3d SectionPilot::descent_W(const Eigen::Vector3d& end_W, const SectionView& view) {
  constexpr double kLevelM = 0.5;  // of altitude: about the error of the estimate
  const Eigen::Vector3d& p_WB = view.navigation.p_WB_est;
  const double down_m = end_W.z() - p_WB.z();
  if (down_m > kLevelM) {
    for (const double share : {1.0, 0.5, 0.25}) {
      Eigen::Vector3d lower_W = end_W;
      lower_W.z() = p_WB.z() + share * down_m;
      const double ahead_m = (end_W - p_WB).head<2>().norm();
      const double sinking_share = share * down_m < ahead_m ? share * down_m / ahead_m : 1.0;  // of the way: at 45 deg
      Eigen::Vector3d low_W = p_WB + sinking_share * (end_W - p_WB);
      low_W.z() = lower_W.z();
      if (!is_seen_free(p_WB, low_W, view) || !is_seen_free(low_W, lower_W, view)) continue;
      level_z_W_.reset();
      return lower_W;
    }
    if (!level_z_W_) level_z_W_ = p_WB.z();
    return {end_W.x(), end_W.y(), *level_z_W_};
  }
  level_z_W_.reset();
  return end_W;
}

/// Returns whether images have shown that a straight path is free, with 0.5 m around the hull, within the reach of the
/// threats.
bool SectionPilot::is_seen_free(const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W,
                                const SectionView& view) const {
  constexpr double kClearM = 0.5;
  const double left_m = view.reach_m - (from_W - view.navigation.p_WB_est).norm();
  const Eigen::Vector3d path_W = to_W - from_W;
  if (left_m <= 0.0 || path_W.isZero()) return true;
  const Eigen::Vector3d tested_W = from_W + std::min(1.0, left_m / path_W.norm()) * path_W;
  return view.seen.free_path(from_W, tested_W, radius_m_ + kClearM);
}

/// Hovers and yaws until a section is free. [Perez2018] sec. V-D.
Command SectionPilot::hover_and_yaw(const SectionView& view, const Goal& goal) {
  if (state_ != State::hover_and_yaw) {
    choose_side(section_ray_C(camera_, view.search, view.choice.best).x(), view.navigation, goal);
  }
  state_ = State::hover_and_yaw;
  aside_W_.reset();
  mover_.stop();
  return HoverCommand{turn_ * kYawRateRadps};
}

/// Chooses the side of the path to the goal on which the vehicle searches. While the distance to the goal does not
/// decrease, the vehicle searches on one side, then on the other, each time twice as far. Otherwise it would turn back
/// before the end of a wall.
/// @param side  < 0: the emptiest section is on the left.
void SectionPilot::choose_side(double side, const NavigationState& navigation, const Goal& goal) {
  constexpr double kFirstM = 15.0, kProgressM = 5.0;
  const Eigen::Vector2d p_WB = navigation.p_WB_est.head<2>();
  const Eigen::Vector2d path_W = goal.p_WG.head<2>() - p_WB;
  if (!sweep_ || path_W.norm() < sweep_->goal_distance_m - kProgressM) {
    sweep_ = Sweep{p_WB, Eigen::Vector2d(-path_W.y(), path_W.x()).normalized(), path_W.norm(), kFirstM};
    turn_ = side < 0.0 ? -1.0 : 1.0;
  } else if (turn_ * sweep_->right_W.dot(p_WB - sweep_->from_W) > sweep_->reach_m) {
    turn_ = -turn_;
    sweep_->reach_m *= 2.0;
  }
}

Eigen::Vector3d SectionPilot::position_W(const NavigationState& navigation,
                                         const vision::sections::SectionSearch& search, int section,
                                         double reach_m) const {
  const Eigen::Vector3d ray_B = camera_.X_BC.linear() * section_ray_C(camera_, search, section);
  const double side = post_W_ ? away_ : ray_B.y() < 0.0 ? -1.0 : 1.0;
  const bool recedes = post_W_.has_value();  // the approaching obstacle may follow a sidestep
  const Eigen::Vector3d p_BP_B = reach_m * direction_B(answer_, ray_B, side, recedes);
  Eigen::Vector3d p_WP = navigation.p_WB_est + navigation.q_WB_est * p_BP_B;
  p_WP.z() = std::min(p_WP.z(), -lowest_m_);
  return p_WP;
}

/// Returns whether the image of a hovering vehicle shows a threat. Stores the bearing of the threat and the side that
/// is free. For a threat straight ahead the side does not change.
bool SectionPilot::is_approached(const SectionView& view) {
  const vision::sections::SectionSearch& search = view.search;
  Eigen::Vector3d threats_C = Eigen::Vector3d::Zero();
  bool approached = false;
  for (size_t i = 0; i < search.sections().size(); ++i) {
    const int section = static_cast<int>(i);
    threats_C += search.threats()[i] * section_ray_C(camera_, search, section);
    approached = approached || search.share(section) > keep_share_;
  }
  if (!approached) return false;
  const Eigen::Vector3d threats_B = camera_.X_BC.linear() * threats_C;
  const double bearing_rad = std::atan2(threats_B.y(), threats_B.x());
  constexpr double kAheadRad = 0.03;
  if (std::abs(bearing_rad) > kAheadRad) away_ = bearing_rad < 0.0 ? 1.0 : -1.0;
  watched_rad_ = heading_rad(view.navigation.q_WB_est) + bearing_rad;
  return true;
}

/// Returns the pixel of a position, possibly outside the image; empty behind the camera.
std::optional<cv::Point2d> SectionPilot::pixel_of(const Eigen::Vector3d& p_W, const NavigationState& navigation) const {
  const Eigen::Vector3d p_B = navigation.q_WB_est.conjugate() * (p_W - navigation.p_WB_est);
  const Eigen::Vector3d p_C = camera_.X_BC.inverse() * p_B;
  if (p_C.z() <= 0.0) return {};
  const vision::stereo::StereoGeometry& g = camera_.geometry;
  return cv::Point2d(g.center_u_px + g.focal_px * p_C.x() / p_C.z(), g.center_v_px + g.focal_px * p_C.y() / p_C.z());
}

/// Whether a position farther than kArrivedM is within a free section. A section that is narrower than the vehicle near
/// an obstacle does not suffice, so near obstacles in view count like those out of view.
bool SectionPilot::is_free(const Eigen::Vector3d& p_W, const SectionView& view) const {
  const auto& [search, choice, passed, seen, reach_m, navigation] = view;
  const auto pixel = pixel_of(p_W, navigation);
  if (!pixel || (p_W - navigation.p_WB_est).norm() < kArrivedM) return false;
  const int section = search.nearest(*pixel);
  const cv::Rect& s = search.sections()[static_cast<size_t>(section)];
  const double off_u_px = std::abs(pixel->x - (s.x + 0.5 * s.width));
  const double off_v_px = std::abs(pixel->y - (s.y + 0.5 * s.height));
  constexpr double kWithin =
      0.25;  // share of the section size: farther out, the section shows too little of the far side of the position
  return off_u_px < kWithin * s.width && off_v_px < kWithin * s.height && search.share(section) <= keep_share_ &&
         passed.free(p_W - navigation.p_WB_est, kInfinity, stereo::PassedObstacles::Among::all);
}

/// Whether the path to `end_W` has filled up and another section is better. If no section contains `end_W`, the path
/// ahead is tested.
bool SectionPilot::is_blocked(const Eigen::Vector3d& end_W, const SectionView& view) const {
  const auto& [search, choice, passed, seen, reach_m, navigation] = view;
  if (aside_W_ && !faces_path(answer_)) return false;
  const auto pixel = aside_W_ ? pixel_of(end_W, navigation) : std::nullopt;
  const int section = pixel ? search.nearest(*pixel) : search.center();
  if (section == choice.section) return false;
  const Eigen::Vector3d path_W = end_W - navigation.p_WB_est;
  const auto meets_passed = [&] {
    if (path_W.norm() < kArrivedM || view.passed.free(path_W)) return false;
    const Eigen::Vector3d other_W = position_W(view.navigation, view.search, view.choice.section, view.reach_m);
    return view.passed.free(other_W - view.navigation.p_WB_est);
  };
  return search.share(section) > keep_share_ || meets_passed();
}

}  // namespace hedgehop::avoidance::section_grid
