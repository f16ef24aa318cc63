#include "avoidance/section_grid/section_law.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "avoidance/heading.h"

namespace hedgehop::avoidance::section_grid {

const char* name_of(State state) {
  switch (state) {
    case State::cruise:
      return "cruise";
    case State::avoid:
      return "avoid";
    case State::resume:
      return "resume";
    case State::hover_and_yaw:
      return "hover_and_yaw";
  }
  throw std::logic_error("unknown state");
}

Eigen::Vector3d section_ray_C(const SectionCamera& camera, const vision::sections::SectionSearch& search, int section) {
  const cv::Rect& s = search.sections()[static_cast<size_t>(section)];
  return camera.geometry.ray_at_unit_depth({s.x + s.width / 2, s.y + s.height / 2}).normalized();
}

Command TurnThenMove::go_to(const Eigen::Vector3d& p_W, const NavigationState& navigation) {
  constexpr double kAlignedRad = 0.17453292519943295;  // 10 deg: well within half the width of a section
  const Eigen::Vector3d& p_WB = navigation.p_WB_est;
  const Eigen::Vector3d path_W = p_W - p_WB;
  const double distance_m = path_W.head<2>().norm();
  const double now_rad = heading_rad(navigation.q_WB_est);
  constexpr double kTooNearToFaceM = 1.0;
  const double bearing_rad = distance_m > kTooNearToFaceM ? std::atan2(path_W.y(), path_W.x()) : now_rad;
  if (std::abs(wrap_angle(bearing_rad - now_rad)) > kAlignedRad) {
    if (!wait_W_) wait_W_ = p_WB;
    return PositionCommand{*wait_W_, bearing_rad};
  }
  wait_W_.reset();
  // With the final altitude as setpoint, the autopilot would leave the straight line, the only path that is known free.
  constexpr double kLeadM = 2.0;
  const double lead = distance_m > kLeadM ? kLeadM / distance_m : 1.0;
  return PositionCommand{{p_W.x(), p_W.y(), p_WB.z() + lead * path_W.z()}, bearing_rad};
}

void SectionLaw::reset(const SectionCamera& camera) {
  camera_ = camera;
  state_ = State::cruise;
  mover_ = {};
  aside_W_.reset();
}

Command SectionLaw::update(const SectionView& view, const Goal& goal) {
  const auto& [search, choice, passed, seen, reach_m, navigation] = view;
  if (aside_W_ && (*aside_W_ - navigation.p_WB_est).norm() < kArrivedM) aside_W_.reset();
  // "The UAV then yaws in order to align with this new GPS point, before moving": a turn is always completed.
  if (!mover_.is_turning()) {
    if (choice.section < 0) {
      state_ = State::hover_and_yaw;
      aside_W_.reset();
      return HoverCommand{kYawRateRadps};
    }
    if (choice.section != search.center()) {
      const Eigen::Vector3d ray_B = camera_.X_BC.linear() * section_ray_C(camera_, search, choice.section);
      aside_W_ = navigation.p_WB_est + navigation.q_WB_est * (reach_m * ray_B);
      aside_W_->z() = std::min(aside_W_->z(), -lowest_m_);
    }
  }
  state_ = aside_W_ ? State::avoid : State::cruise;
  return mover_.go_to(aside_W_.value_or(goal.p_WG), navigation);
}

}  // namespace hedgehop::avoidance::section_grid
