#include "avoidance/flow_balance/range_balance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace hedgehop::avoidance::flow_balance {

Eigen::Vector2d push_from_places(const std::vector<Eigen::Vector2d>& places_W, const Eigen::Vector2d& aim_W,
                                 double gain_m2ps) {
  constexpr size_t kNearest = 3;   // one alone may be a wrong vector
  constexpr double kTouchM = 0.1;  // nearer is no more urgent
  Eigen::Vector2d push_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d axis_W = aim_W.normalized();
  for (int quarter = 0; quarter < 4; ++quarter, axis_W = {-axis_W.y(), axis_W.x()}) {
    std::vector<Eigen::Vector2d> inverse_W;  // along each place's direction, as long as its inverse range
    for (const Eigen::Vector2d& p_BP_W : places_W) {
      if (p_BP_W.dot(axis_W) < std::numbers::sqrt2 / 2.0 * p_BP_W.norm()) continue;
      inverse_W.push_back(p_BP_W / std::max(kTouchM * kTouchM, p_BP_W.squaredNorm()));
    }
    const size_t count = std::min(kNearest, inverse_W.size());
    std::ranges::partial_sort(inverse_W, inverse_W.begin() + static_cast<std::ptrdiff_t>(count), std::greater<>(),
                              [](const Eigen::Vector2d& inverse) { return inverse.squaredNorm(); });
    for (size_t i = 0; i < count; ++i) push_W -= gain_m2ps / kNearest * inverse_W[i];
  }
  return push_W;
}

Eigen::Vector2d low_pass(const Eigen::Vector2d& v_last_W, const Eigen::Vector2d& v_W, double dt_s,
                         double time_constant_s) {
  if (time_constant_s <= 0.0) return v_W;
  return v_last_W + (1.0 - std::exp(-dt_s / time_constant_s)) * (v_W - v_last_W);
}

}  // namespace hedgehop::avoidance::flow_balance
