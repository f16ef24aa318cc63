#include "avoidance/local_map/velocity_obstacles.h"

#include <algorithm>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kForeseenS = 4.0;
constexpr double kVaguestM = 1.0;  // of a position to come, that is kept free besides

}  // namespace

double threat_m(std::span<const Moment> path, std::span<const Mover> movers, const Clearance& clearance, double t_s) {
  double worst_m = 0.0;
  const auto meet = [&](const Moment& moment) {
    const double margin_m = clearance.margin_m + clearance.margin_s * moment.v_W.norm();
    for (const Mover& mover : movers) {
      const double dt_s = moment.t_s - t_s;
      const double sigma_m = std::min(mover.p_sigma_m + mover.v_sigma_mps * std::max(0.0, dt_s), kVaguestM);
      const double away_m = (moment.p_W - mover.p_W - dt_s * mover.v_W).norm() - mover.radius_m;
      worst_m = std::max(worst_m, clearance.hull_m + margin_m + sigma_m - away_m);
    }
  };
  if (movers.empty()) return 0.0;
  for (const Moment& moment : path) meet(moment);
  constexpr double kStepS = 0.1;
  Moment stands{path.back().t_s, path.back().p_W, Eigen::Vector2d::Zero()};
  while ((stands.t_s += kStepS) < path.front().t_s + kForeseenS) meet(stands);
  return worst_m;
}

}  // namespace hedgehop::avoidance::local_map
