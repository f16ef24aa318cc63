#include "avoidance/corridor_centering/pursuit.h"

#include <algorithm>
#include <cmath>

#include "avoidance/corridor_centering/centering_law.h"
#include "avoidance/heading.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::corridor_centering {
namespace {

constexpr vision::corridor::GapConfig kGap;  // defaults
constexpr double kSmoothingS = 0.25;         // time constant of the gap: averages the noise of single images
constexpr double kHeadingS = 0.7;  // time constant of the heading towards the course: slow turns keep the flow clean

}  // namespace

double pursuit_course_rad(const vision::corridor::Gap& gap, double ahead_m, double most_rad) {
  const double course_rad = std::atan2(vision::corridor::middle_offset_m(gap.left_m, gap.right_m), ahead_m);
  return std::clamp(course_rad, -most_rad, most_rad);
}

double clearance_speed_mps(double aside_m, double ahead_m, const SpeedLimits& limits) {
  const double a = limits.stop_mps2, t = limits.reaction_s;
  // v t + v^2 / (2 a) = path ahead
  const double path_m = std::max(0.0, ahead_m);
  const double stopping_mps = std::isinf(path_m) ? limits.speed_mps : a * (std::sqrt(t * t + 2.0 * path_m / a) - t);
  return std::min({limits.speed_mps, std::max(0.0, aside_m) / limits.aside_s, stopping_mps});
}

void Pursuit::observe(const WallObservation& seen, int64_t t_ns) {
  constexpr double kStandingMps = 0.2;  // below this, noise dominates the measurement of the approach
  const bool moves = seen.v_H.norm() > kStandingMps;
  if (!moves || seen.approach) {
    dark_ns_ = -1;
  } else if (dark_ns_ < 0) {
    dark_ns_ = t_ns;
  }
  free_s_ = kInfinity;
  if (moves) {
    free_s_ = vision::corridor::free_time_s(seen.points, seen.v_H, config_.radius_m + config_.margin_m, kGap.least);
    if (seen.approach && seen.approach->rate_per_s > 0.0) {
      free_s_ = std::min(free_s_, 1.0 / seen.approach->rate_per_s);
    }
  }
  if (!std::isnan(seen.error)) follow_gap(seen, t_ns);
}

/// Low-pass filter of the measured gap; restarts after a pause.
void Pursuit::follow_gap(const WallObservation& seen, int64_t t_ns) {
  const vision::corridor::Gap gap = vision::corridor::gap_ahead(seen.points, kGap);
  const bool follows = known_ns_ >= 0 && seconds(t_ns - known_ns_) <= kPatienceS;
  const double share = follows ? -std::expm1(-seconds(t_ns - known_ns_) / kSmoothingS) : 1.0;
  const auto follow = [share](double& known_m, double gap_m, double median_m) {
    const double now_m = std::isnan(gap_m) ? median_m : gap_m;
    known_m = share < 1.0 ? known_m + share * (now_m - known_m) : now_m;
  };
  follow(gap_.left_m, gap.left_m, seen.left.distance_m);
  follow(gap_.right_m, gap.right_m, seen.right.distance_m);
  known_ns_ = t_ns;
}

double Pursuit::hull_ahead_m(const WallObservation* seen) const {
  return free_s_ * (seen ? seen->v_H.norm() : 0.0) - config_.radius_m - config_.margin_m;
}

bool Pursuit::is_blocked(const WallObservation* seen, int64_t now_ns) const {
  const bool blank = dark_ns_ >= 0 && seconds(now_ns - dark_ns_) > kPatienceS;
  return blank || (seen && std::isfinite(free_s_) && hull_ahead_m(seen) <= 0.0);
}

Command Pursuit::update(const Observation& observation, const WallObservation* seen, bool is_new, double dt_s) {
  const int64_t now_ns = observation.t_ns;
  const double heading = heading_rad(observation.navigation.q_WB_est);
  course_rad_.reset();
  bool fresh = known_ns_ >= 0 && seconds(now_ns - known_ns_) <= kPatienceS;
  if (turn_from_rad_) {
    constexpr double kTurnRad = 25.0 * std::numbers::pi / 180.0;  // minimum turn that shows another direction
    if (std::abs(wrap_angle(heading - *turn_from_rad_)) < kTurnRad) return turn_away();
    turn_from_rad_.reset();
    known_ns_ = probing_ns_ = dark_ns_ = -1;  // the old measurements belong to another direction
    fresh = false;
  }
  if (is_blocked(seen, now_ns)) {
    turn_from_rad_ = heading;
    turn_ = gap_.right_m < gap_.left_m ? -1.0 : 1.0;
    return turn_away();
  }
  if (fresh) {
    probing_ns_ = -1;
    status_ = "cruise";
    const double aside_m = std::min(gap_.left_m, gap_.right_m) - config_.radius_m;
    const double free_m = std::isfinite(free_s_) ? hull_ahead_m(seen) : kInfinity;
    const double speed_mps = std::max(config_.probe_mps, clearance_speed_mps(aside_m, free_m, config_.limits));
    // Also limited relative to the walls: the heading follows the course and would otherwise turn without end.
    const double walls_rad = seen->direction_rad;
    const double course_rad = pursuit_course_rad(gap_, config_.lookahead_m, kMaxCourseRad);
    return fly(observation, speed_mps, std::clamp(course_rad, walls_rad - kMaxCourseRad, walls_rad + kMaxCourseRad),
               dt_s);
  }
  // Fly slowly while the sides are unknown but corners are tracked on both sides.
  if (probing_ns_ < 0) probing_ns_ = now_ns;
  const bool corners = seen && seen->corners_left >= kMinVectors && seen->corners_right >= kMinVectors;
  const bool patient = seconds(now_ns - probing_ns_) <= config_.probe_s;
  if (!is_new || !corners || !patient) {
    status_ = "blind";
    heading_rad_.reset();
    return HoverCommand{};
  }
  status_ = "probe";
  return fly(observation, config_.probe_mps, 0.0, dt_s);
}

Command Pursuit::fly(const Observation& observation, double speed_mps, double course_rad, double dt_s) {
  course_rad_ = course_rad;
  const double heading = heading_rad(observation.navigation.q_WB_est);
  const double travel_rad = wrap_angle(heading + course_rad);
  if (!heading_rad_) heading_rad_ = heading;
  const double share = -std::expm1(-dt_s / kHeadingS);
  heading_rad_ = wrap_angle(*heading_rad_ + share * wrap_angle(travel_rad - *heading_rad_));
  return VelocityCommand{speed_mps * Eigen::Vector2d(std::cos(travel_rad), std::sin(travel_rad)),
                         -observation.goal.p_WG.z(), *heading_rad_};
}

Command Pursuit::turn_away() {
  heading_rad_.reset();
  status_ = "blocked";
  return HoverCommand{turn_ * config_.yaw_rate_radps};
}

}  // namespace hedgehop::avoidance::corridor_centering
