#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "avoidance/module.h"

namespace hedgehop::avoidance {

/// Horizontal position from integrated velocity. It drifts slowly, while satellite positions change by up to half a
/// meter per second. Maps require an accurate position relative to recent observations, not an absolute position.
class DeadReckoning {
 public:
  /// Integrated velocity alone.
  DeadReckoning() = default;
  /// @param converge_s  time constant with which the position approaches the estimated one, s, > 0.
  explicit DeadReckoning(double converge_s) : converge_s_(converge_s) {}

  /// @param t_s  s, increases from call to call; the first call starts at the estimated position.
  /// @return the state with integrated north and east coordinates.
  NavigationState update(const NavigationState& navigation, double t_s) {
    const Eigen::Vector2d v_W = (navigation.q_WB_est * navigation.v_WB_B_est).head<2>();
    const Eigen::Vector2d p_W_est = navigation.p_WB_est.head<2>();
    if (last_) {
      const double dt_s = t_s - last_->t_s;
      p_W_ += 0.5 * dt_s * (last_->v_W + v_W);
      p_W_ += (1.0 - std::exp(-dt_s / converge_s_)) * (p_W_est - p_W_);
    } else {
      p_W_ = p_W_est;
    }
    last_ = Last{t_s, v_W};
    NavigationState reckoned = navigation;
    reckoned.p_WB_est.head<2>() = p_W_;
    return reckoned;
  }

 private:
  struct Last {
    double t_s;
    Eigen::Vector2d v_W;
  };
  double converge_s_ = std::numeric_limits<double>::infinity();
  Eigen::Vector2d p_W_ = Eigen::Vector2d::Zero();
  std::optional<Last> last_;
};

}  // namespace hedgehop::avoidance
