#include "avoidance/section_grid/section_pilot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "avoidance/heading.h"

namespace hedgehop::avoidance::section_grid {
namespace {

void check(const SectionPilotConfig& c) {
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(std::string("section_grid: ") + message);
  };
  need(c.keep_share >= 0.0 && c.keep_share <= 1.0, "keep_share must lie in [0, 1]");
  need(c.aligned_rad > 0.0, "aligned must be above 0 deg");
  need(c.arrived_m > 0.0, "arrived must be above 0 m");
  need(c.yaw_rate_radps > 0.0, "yaw_rate must be above 0 deg/s");
}

/// Direction of a section's center in C, of length 1.
Eigen::Vector3d section_ray(const SectionCamera& camera, const vision::sections::SectionSearch& seen, int section) {
  const cv::Rect& s = seen.sections()[static_cast<size_t>(section)];
  return camera.geometry.ray({s.x + s.width / 2, s.y + s.height / 2}).normalized();
}

}  // namespace

SectionPilot::SectionPilot(const SectionPilotConfig& config) : config_(config) { check(config); }

void SectionPilot::reset(const SectionCamera& camera) {
  camera_ = camera;
  state_ = State::cruise;
  turn_ = 1.0;
  aside_W_.reset();
  held_W_.reset();
  post_W_.reset();
  away_ = 1.0;
  watched_rad_.reset();
  sweep_.reset();
  flown_ = false;
}

Command SectionPilot::update(const SectionView& view, const Goal& goal) {
  const auto& [seen, choice, passed, reach_m, navigation] = view;
  if (!flown_ && (goal.p_WG - navigation.p_WB_est).norm() < reach_m) post_W_ = goal.p_WG;
  flown_ = true;
  const bool hovers = post_W_ && !turns();
  // A turn that has begun is finished first: what passes by on the way says nothing of where it leads.
  if (choice.section < 0 && !held_W_ && !hovers) return hover_and_yaw(view, goal);

  const bool looked_round = state_ == State::hover_and_yaw;
  const bool arrived = aside_W_ && (*aside_W_ - navigation.p_WB_est).norm() < config_.arrived_m;
  if (aside_W_ && (arrived || (!post_W_ && is_free(goal.p_WG, view)))) {
    if (post_W_) post_W_ = aside_W_;
    aside_W_.reset();
    state_ = State::resume;
  }
  const Eigen::Vector3d& end_W = aside_W_ ? *aside_W_ : post_W_ ? *post_W_ : goal.p_WG;
  const bool off_route = hovers ? is_approached(view) && !aside_W_ : !held_W_ && is_spoilt(end_W, view);
  if (looked_round || off_route) {
    if (!looked_round && !aside_W_ && !hovers) {
      search(section_ray(camera_, seen, choice.section).x(), navigation, goal);
    }
    aside_W_ = place(navigation, seen, choice.section < 0 ? choice.best : choice.section, reach_m);
    state_ = State::avoid;
  }
  if (aside_W_ && !turns()) return PositionCommand{*aside_W_, watched_rad_.value_or(heading_rad(navigation.q_WB_est))};
  if (aside_W_) return go_to(*aside_W_, navigation);
  if (post_W_) {
    state_ = State::cruise;
    return PositionCommand{*post_W_, watched_rad_.value_or(goal.heading_rad)};
  }
  const Command command = go_to(goal.p_WG, navigation);
  if (!held_W_) state_ = State::cruise;
  return command;
}

/// [Perez2018] sec. on movement: without a section the vehicle hovers and yaws until there is one.
Command SectionPilot::hover_and_yaw(const SectionView& view, const Goal& goal) {
  if (state_ != State::hover_and_yaw) {
    search(section_ray(camera_, view.seen, view.choice.best).x(), view.navigation, goal);
  }
  state_ = State::hover_and_yaw;
  aside_W_.reset();
  held_W_.reset();
  return HoverCommand{turn_ * config_.yaw_rate_radps};
}

/// Settles to which side of the way to the goal the vehicle looks round. As long as the goal comes no nearer it keeps
/// to one side, then to the other, each time twice as far; else it would turn back before the end of a wall. `side` <
/// 0: the emptiest section lies to the left.
void SectionPilot::search(double side, const NavigationState& navigation, const Goal& goal) {
  constexpr double kFirstM = 15.0, kProgressM = 5.0;
  const Eigen::Vector2d p_WB = navigation.p_WB_est.head<2>();
  const Eigen::Vector2d way_W = goal.p_WG.head<2>() - p_WB;
  if (!sweep_ || way_W.norm() < sweep_->goal_distance_m - kProgressM) {
    sweep_ = Sweep{p_WB, Eigen::Vector2d(-way_W.y(), way_W.x()).normalized(), way_W.norm(), kFirstM};
    turn_ = side < 0.0 ? -1.0 : 1.0;
  } else if (turn_ * sweep_->right_W.dot(p_WB - sweep_->from_W) > sweep_->reach_m) {
    turn_ = -turn_;
    sweep_->reach_m *= 2.0;
  }
}

/// Where to go about a threat: as a rule ahead in the section's direction.
Eigen::Vector3d SectionPilot::place(const NavigationState& navigation, const vision::sections::SectionSearch& seen,
                                    int section, double reach_m) const {
  using Answer = SectionPilotConfig::Answer;
  const Eigen::Vector3d ray_B = camera_.X_BC.linear() * section_ray(camera_, seen, section);
  const double side = post_W_ ? away_ : ray_B.y() < 0.0 ? -1.0 : 1.0;
  const double back = post_W_ ? 1.0 : 0.0;  // what comes at the post may follow aside
  Eigen::Vector3d p_BS_B = Eigen::Vector3d::Zero();
  switch (config_.answer) {
    case Answer::waypoint:
      p_BS_B = ray_B;
      break;
    case Answer::heading:
      p_BS_B = {ray_B.x(), ray_B.y(), 0.0};
      break;
    case Answer::sideways:
      p_BS_B = {-back, side, 0.0};
      break;
    case Answer::climb:
      p_BS_B.z() = -1.0;
      break;
    case Answer::combined:
      p_BS_B = {-back, side, -1.0};
      break;
  }
  Eigen::Vector3d p_WS = navigation.p_WB_est + navigation.q_WB_est * (reach_m * p_BS_B.normalized());
  p_WS.z() = std::min(p_WS.z(), -config_.lowest_m);
  return p_WS;
}

/// Whether the vehicle faces the places it goes to.
bool SectionPilot::turns() const {
  return config_.answer == SectionPilotConfig::Answer::waypoint ||
         config_.answer == SectionPilotConfig::Answer::heading;
}

/// Whether anything within the threshold is in sight of a vehicle that hovers; settles where it is, and to which side
/// it leaves room. The side stays the same for what stands straight ahead.
bool SectionPilot::is_approached(const SectionView& view) {
  const vision::sections::SectionSearch& seen = view.seen;
  Eigen::Vector3d threats_C = Eigen::Vector3d::Zero();
  bool approached = false;
  for (size_t i = 0; i < seen.sections().size(); ++i) {
    const int section = static_cast<int>(i);
    threats_C += seen.threats()[i] * section_ray(camera_, seen, section);
    approached = approached || seen.share(section) > config_.keep_share;
  }
  if (!approached) return false;
  const Eigen::Vector3d threats_B = camera_.X_BC.linear() * threats_C;
  const double bearing_rad = std::atan2(threats_B.y(), threats_B.x());
  constexpr double kAheadRad = 0.03;
  if (std::abs(bearing_rad) > kAheadRad) away_ = bearing_rad < 0.0 ? 1.0 : -1.0;
  watched_rad_ = heading_rad(view.navigation.q_WB_est) + bearing_rad;
  return true;
}

/// Where in the image a place lies; nothing behind the camera.
std::optional<cv::Point2d> SectionPilot::pixel_of(const Eigen::Vector3d& p_W, const NavigationState& navigation) const {
  const Eigen::Vector3d p_B = navigation.q_WB_est.conjugate() * (p_W - navigation.p_WB_est);
  const Eigen::Vector3d p_C = camera_.X_BC.inverse() * p_B;
  if (p_C.z() <= 0.0) return {};
  const vision::stereo::StereoGeometry& g = camera_.geometry;
  return cv::Point2d(g.center_u_px + g.focal_px * p_C.x() / p_C.z(), g.center_v_px + g.focal_px * p_C.y() / p_C.z());
}

/// Whether a place some way off is in sight with a whole section about it that is free.
bool SectionPilot::is_free(const Eigen::Vector3d& p_W, const SectionView& view) const {
  const auto& [seen, choice, passed, reach_m, navigation] = view;
  const auto pixel = pixel_of(p_W, navigation);
  if (!pixel || (p_W - navigation.p_WB_est).norm() < config_.arrived_m) return false;
  const int section = seen.nearest(*pixel);
  const cv::Rect& s = seen.sections()[static_cast<size_t>(section)];
  const double off_u_px = std::abs(pixel->x - (s.x + 0.5 * s.width));
  const double off_v_px = std::abs(pixel->y - (s.y + 0.5 * s.height));
  constexpr double kWithin = 0.25;  // of the section's size: more, and it says too little of the place's far side
  return off_u_px < kWithin * s.width && off_v_px < kWithin * s.height && seen.share(section) <= config_.keep_share &&
         passed.free(p_W - navigation.p_WB_est);
}

/// Whether the way to `end_W` aside, or without one the way ahead, has filled up and another section is better.
bool SectionPilot::is_spoilt(const Eigen::Vector3d& end_W, const SectionView& view) const {
  const auto& [seen, choice, passed, reach_m, navigation] = view;
  if (aside_W_ && !turns()) return false;
  const auto pixel = aside_W_ ? pixel_of(end_W, navigation) : std::nullopt;
  const int section = pixel ? seen.nearest(*pixel) : seen.center();
  if (section == choice.section) return false;
  const Eigen::Vector3d way_W = end_W - navigation.p_WB_est;
  const auto meets_passed = [&] {
    if (way_W.norm() < config_.arrived_m || view.passed.free(way_W)) return false;
    const Eigen::Vector3d other_W = place(view.navigation, view.seen, view.choice.section, view.reach_m);
    return view.passed.free(other_W - view.navigation.p_WB_est);
  };
  return seen.share(section) > config_.keep_share || meets_passed();
}

/// Turns to face a place, waiting where it is, then moves there, climbing evenly on the way.
Command SectionPilot::go_to(const Eigen::Vector3d& p_W, const NavigationState& navigation) {
  const Eigen::Vector3d& p_WB = navigation.p_WB_est;
  const Eigen::Vector3d way_W = p_W - p_WB;
  const double distance_m = way_W.head<2>().norm();
  const double now_rad = heading_rad(navigation.q_WB_est);
  constexpr double kTooNearToFaceM = 1.0;
  const double bearing_rad = distance_m > kTooNearToFaceM ? std::atan2(way_W.y(), way_W.x()) : now_rad;
  if (std::abs(std::remainder(bearing_rad - now_rad, 2.0 * M_PI)) > config_.aligned_rad) {
    if (!held_W_) held_W_ = p_WB;
    return PositionCommand{*held_W_, bearing_rad};
  }
  held_W_.reset();
  // An autopilot told the final height would leave the straight line, which alone was found free.
  constexpr double kLeadM = 2.0;
  const double lead = distance_m > kLeadM ? kLeadM / distance_m : 1.0;
  return PositionCommand{{p_W.x(), p_W.y(), p_WB.z() + lead * way_W.z()}, bearing_rad};
}

}  // namespace hedgehop::avoidance::section_grid
