#pragma once

#include <optional>

#include "avoidance/module.h"

namespace hedgehop::avoidance::local_map {

/// Horizontal position from integrated velocity alone. It drifts slowly, while satellite positions change by up to half
/// a meter per second. The map requires an accurate position relative to recent observations, not an absolute position.
class DeadReckoning {
 public:
  /// @param t_s  s, increases from call to call; the first call starts at the estimated position.
  /// @return the state with integrated north and east coordinates.
  NavigationState update(const NavigationState& navigation, double t_s) {
    const Eigen::Vector2d v_W = (navigation.q_WB_est * navigation.v_WB_B_est).head<2>();
    p_W_ =
        last_ ? p_W_ + 0.5 * (t_s - last_->t_s) * (last_->v_W + v_W) : Eigen::Vector2d(navigation.p_WB_est.head<2>());
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
  Eigen::Vector2d p_W_ = Eigen::Vector2d::Zero();
  std::optional<Last> last_;
};

}  // namespace hedgehop::avoidance::local_map
