#include "avoidance/corridor_centering/centering_law.h"

#include <cmath>

#include "avoidance/heading.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::corridor_centering {

double published_control(const CenteringGains& gains, double error, double last_error) {
  return (gains.kp + gains.kd) * error - gains.kp * last_error;
}

void CenteringLaw::observe(double error, int64_t t_ns) {
  error_ = error;
  if (!std::isnan(error)) known_ns_ = t_ns;
}

Command CenteringLaw::update(const Observation& observation, double dt_s) {
  const int64_t now_ns = observation.t_ns;
  if (begun_ns_ < 0) begun_ns_ = now_ns;
  const bool fresh = known_ns_ >= 0 && seconds(now_ns - known_ns_) <= kPatienceS;
  if (!heading_rad_) heading_rad_ = heading_rad(observation.navigation.q_WB_est);
  heading_rad_ = *heading_rad_ + control_ * dt_s;  // roll, rad, and turn rate, rad/s, are the same number
  if (!fresh && seconds(now_ns - begun_ns_) > config_.probe_s) {
    status_ = "blind";
    control_ = 0.0;
    sampled_error_.reset();
    heading_rad_.reset();
    return HoverCommand{};
  }
  status_ = fresh ? "cruise" : "probe";
  constexpr double kRoundOffS = 1e-6;
  const bool due = sampled_ns_ < 0 || seconds(now_ns - sampled_ns_) >= config_.sample_s - kRoundOffS;
  if (fresh && due && !std::isnan(error_)) {
    control_ = published_control(config_.gains, error_, sampled_error_.value_or(error_));
    sampled_error_ = error_;
    sampled_ns_ = now_ns;
  }
  return AttitudeCommand{control_, -config_.pitch_rad, *heading_rad_, -observation.goal.p_WG.z()};
}

}  // namespace hedgehop::avoidance::corridor_centering
