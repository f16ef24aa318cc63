#include "avoidance/flow_balance/approach_limit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace hedgehop::avoidance::flow_balance {

double closing_limit_mps(double range_m, const ApproachLimit& limit) {
  constexpr double kRetreatS = 1.0;  // faster than a drift, slower than the response of a helicopter's velocity
  const double left_m = range_m - limit.stand_off_m;
  if (left_m < 0.0) return left_m / kRetreatS;
  const double reaction_mps = limit.braking_mps2 * limit.reaction_s;
  return std::sqrt(reaction_mps * reaction_mps + 2.0 * limit.braking_mps2 * left_m) - reaction_mps;
}

std::vector<Eigen::Vector2d> confirmed_obstacles(const std::vector<Eigen::Vector2d>& obstacles_W) {
  constexpr double kCompanionM = 2.0;  // spacing of the sectors on a wall 16 m away, at 45 deg to the line of sight
  std::vector<Eigen::Vector2d> confirmed_W;
  std::ranges::copy_if(obstacles_W, std::back_inserter(confirmed_W), [&](const Eigen::Vector2d& p) {
    return std::ranges::count_if(obstacles_W, [&](const Eigen::Vector2d& q) { return (p - q).norm() <= kCompanionM; }) >
           1;
  });
  return confirmed_W;
}

Eigen::Vector2d limited_approach(const Eigen::Vector2d& v_W, std::vector<Eigen::Vector2d> obstacles_W,
                                 const ApproachLimit& limit, double speed_mps) {
  constexpr int kSweeps = 3;  // a correction for one obstacle can violate the limit of another
  // The nearest obstacle is the last one, so its limit holds exactly.
  std::ranges::stable_sort(obstacles_W, std::greater<>(), [](const Eigen::Vector2d& p) { return p.squaredNorm(); });
  Eigen::Vector2d v_limited_W = v_W;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const Eigen::Vector2d& p_BP_W : obstacles_W) {
      const Eigen::Vector2d direction_W = p_BP_W.normalized();
      const double excess_mps = v_limited_W.dot(direction_W) - closing_limit_mps(p_BP_W.norm(), limit);
      if (excess_mps > 0.0) v_limited_W -= excess_mps * direction_W;
    }
  }
  const double limited_mps = v_limited_W.norm();
  return limited_mps > speed_mps ? Eigen::Vector2d(v_limited_W * (speed_mps / limited_mps)) : v_limited_W;
}

}  // namespace hedgehop::avoidance::flow_balance
