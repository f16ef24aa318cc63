#include "avoidance/local_map/velocity_obstacles.h"

#include <algorithm>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kForeseenS = 4.0;
constexpr double kNearM = 4.0;     // between hulls: who comes nearer is kept in view
constexpr double kVagueMps = 0.7;  // 1-sigma of a velocity that may as well be none: the mover's place stays free, too
constexpr double kVaguestM = 1.0;  // of a position to come, that is kept free besides
constexpr double kBesideM = 0.5;   // what is nearer is hardly matched, and a crown is no disc

}  // namespace

double threat_m(std::span<const Moment> path, std::span<const Mover> movers, const Clearance& clearance, double t_s) {
  constexpr double kStepS = 0.1;
  double worst_m = 0.0, sum_m = 0.0;
  const auto meet = [&](const Moment& moment) {
    const double margin_m = clearance.margin_m + clearance.margin_s * moment.v_W.norm();
    double here_m = 0.0;
    for (const Mover& mover : movers) {
      const double dt_s = moment.t_s - t_s;
      const double sigma_m = std::min(mover.p_sigma_m + mover.v_sigma_mps * std::max(0.0, dt_s), kVaguestM);
      const Eigen::Vector2d then_W = moment.p_W - dt_s * mover.v_W;
      double from_m = (then_W - mover.p_W).norm() - mover.radius_m;
      if (mover.v_sigma_mps > kVagueMps) from_m = std::min(from_m, (moment.p_W - mover.p_W).norm() - mover.radius_m);
      if (!mover.face_W.empty()) from_m = std::min(from_m, away_m(mover.face_W, then_W));
      here_m = std::max(here_m, clearance.hull_m + margin_m + kBesideM + sigma_m - from_m);
    }
    worst_m = std::max(worst_m, here_m);
    sum_m += here_m;
  };
  if (movers.empty()) return 0.0;
  for (const Moment& moment : path) meet(moment);
  Moment stands{path.back().t_s, path.back().p_W, Eigen::Vector2d::Zero()};
  while ((stands.t_s += kStepS) < path.front().t_s + kForeseenS) meet(stands);
  return 0.5 * (worst_m + sum_m * kStepS / kForeseenS);
}

const Mover* nearest_to_come(const Moment& now, std::span<const Mover> movers, double hull_m) {
  const Mover* nearest = nullptr;
  double least_m = kNearM;
  for (const Mover& mover : movers) {
    const Eigen::Vector2d off_W = mover.p_W - now.p_W, v_W = mover.v_W - now.v_W;
    constexpr double kStandsM2ps2 = 1e-6;
    const double closest_s = std::clamp(-off_W.dot(v_W) / std::max(v_W.squaredNorm(), kStandsM2ps2), 0.0, kForeseenS);
    const double away_m = (off_W + closest_s * v_W).norm() - mover.radius_m - hull_m;
    if (away_m >= least_m) continue;
    least_m = away_m;
    nearest = &mover;
  }
  return nearest;
}

}  // namespace hedgehop::avoidance::local_map
