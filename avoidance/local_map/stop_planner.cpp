#include "avoidance/local_map/stop_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kStepS = 0.1;
constexpr double kHoldS = 0.4;  // duration of a command in a plan: longer than the image period
constexpr std::array<double, 2> kLongHoldsS = {1.2,
                                               2.4};  // for passing in front of moving obstacles, or fleeing from them
constexpr double kStoppedMps = 0.05;
constexpr int kDirections = 36;
constexpr std::array<double, 6> kShares = {1.0, 0.75, 0.5, 0.35, 0.2, 0.1};
constexpr double kImpactPriceS = 0.5;     // cost of speed, as a distance, on a path with a violation
constexpr double kFleeShare = 0.3;        // weight of the threat of moving obstacles there: a wall is worse
constexpr double kTurnPriceS2pm = 0.006;  // cost of a change of the command, as a distance, times the speed
constexpr double kBlindMps = 2.0;         // maximum speed in directions out of view
constexpr double kBlindPriceS = 3.0;      // cost, as a distance, of each m/s above it
constexpr double kSlackM = 0.02;          // additional violation that is allowed if a path begins with one
constexpr double kFaultPrice = 10.0, kBesidePrice = 10.0, kThreatPrice = 30.0;  // per missing meter

/// The best of the velocities considered so far.
class Search {
 public:
  using Plan = StopPlanner::Plan;

  Search(const StopPlanner& planner, const PathState& now, const Eigen::Vector2d& last_cmd_W,
         const StopPlanner::DeficitAt& deficit, const StopPlanner::Threat& threat_m,
         const StopPlanner::ToGoal& to_goal_m)
      : planner_(planner),
        now_(now),
        last_cmd_W_(last_cmd_W),
        deficit_(deficit),
        threat_m_(threat_m),
        to_goal_m_(to_goal_m),
        here_m_(to_goal(now.p_W)) {
    // A vehicle that violates a clearance may leave on any path that does not increase the same violation. A violation
    // of the distance to obstacles does not excuse one of the distance to unknown space, or vice versa.
    const ClearanceDeficit fault_now = deficit(now);
    const auto most_m = [](double now_m) { return now_m > 0.0 ? now_m + kSlackM : 0.0; };
    most_ = {most_m(fault_now.occupied_m), most_m(fault_now.unknown_m)};
  }

  /// @param turn_price_m  cost of the change of the command. @param blind_mps  excess speed in directions out of view.
  void consider(const Eigen::Vector2d& v_cmd_W, double turn_price_m, double blind_mps) {
    std::vector<PathState> path = planner_.predict(now_, last_cmd_W_, v_cmd_W, kHoldS);
    double bad_m = excess_m(path, best_.safe ? 0.0 : least_bad_m_);
    if (bad_m > 0.0) {  // flown only if no safe path exists
      if (best_.safe || bad_m >= least_bad_m_) return;
      bad_m += kFleeShare * threat_m_(path);
      if (bad_m >= least_bad_m_) return;
      least_bad_m_ = bad_m;
      best_ = {v_cmd_W, false, 0.0, std::move(path)};
      return;
    }
    const ClearanceDeficit end = deficit_(path.back());
    const double there_m = to_goal(path.back().p_W);
    double cost = there_m + kFaultPrice * std::max(end.occupied_m, end.unknown_m) + turn_price_m +
                  kBlindPriceS * blind_mps + kBesidePrice * beside_m_;
    if (cost < best_cost_) cost += kThreatPrice * threatened_m(v_cmd_W, path);
    if (cost >= best_cost_) return;
    best_cost_ = cost;
    best_ = {v_cmd_W, true, here_m_ - there_m, std::move(path)};
  }

  Plan best() && { return std::move(best_); }

 private:
  double to_goal(const Eigen::Vector2d& p_W) const {
    constexpr double kNoWayM = 1e4;
    return to_goal_m_(p_W).value_or(kNoWayM);
  }

  /// Returns the maximum violation of a path, increased by the speed there; 0 without a violation. Sets `beside_m_` to
  /// the violation of the preferred distance from unknown space; it is valid for paths without excess.
  double excess_m(const std::vector<PathState>& path, double enough_m) {
    double worst_m = 0.0;
    beside_m_ = 0.0;
    for (const PathState& state : path) {
      const ClearanceDeficit there = deficit_(state);
      beside_m_ = std::max(beside_m_, there.beside_unknown_m);
      const double past_m = std::max(there.occupied_m - most_.occupied_m, there.unknown_m - most_.unknown_m);
      if (past_m > 0.0) worst_m = std::max(worst_m, past_m + kImpactPriceS * state.v_W.norm());
      if (worst_m > enough_m) break;
    }
    return worst_m;
  }

  /// Returns the minimum threat of all paths that begin with a velocity.
  double threatened_m(const Eigen::Vector2d& v_cmd_W, const std::vector<PathState>& path) {
    double least_m = threat_m_(path);
    for (const double hold_s : kLongHoldsS) {
      if (least_m == 0.0) break;
      const std::vector<PathState> longer = planner_.predict(now_, last_cmd_W_, v_cmd_W, hold_s);
      if (excess_m(longer, 0.0) == 0.0) least_m = std::min(least_m, threat_m_(longer));
    }
    return least_m;
  }

  static constexpr double kNever = std::numeric_limits<double>::infinity();
  const StopPlanner& planner_;
  const PathState& now_;
  const Eigen::Vector2d& last_cmd_W_;
  const StopPlanner::DeficitAt& deficit_;
  const StopPlanner::Threat& threat_m_;
  const StopPlanner::ToGoal& to_goal_m_;
  ClearanceDeficit most_;
  double here_m_, beside_m_ = 0.0;
  Plan best_;
  double best_cost_ = kNever, least_bad_m_ = kNever;
};

constexpr double kForeseenS = 4.0;
constexpr double kNearM = 4.0;      // between hulls: nearer obstacles are kept in view
constexpr double kVagueMps = 0.7;   // 1-sigma velocity error above which the current position also stays blocked
constexpr double kMaxSigmaM = 1.0;  // maximum growth of the disc due to the predicted position error
constexpr double kBesideM = 0.5;    // near obstacles are hardly matched, and a tree crown is no disc

}  // namespace

std::vector<PathState> StopPlanner::predict(const PathState& now, const Eigen::Vector2d& last_cmd_W,
                                            const Eigen::Vector2d& v_cmd_W, double hold_s) const {
  std::vector<PathState> path = {now};
  const double brakes_s = response_.delay_s + hold_s;
  constexpr double kMaxDurationS = 20.0;
  while (path.back().t_s - now.t_s < kMaxDurationS) {
    const PathState& last = path.back();
    const double t_s = last.t_s - now.t_s + 0.5 * kStepS;
    const bool brakes = t_s >= brakes_s;
    const Eigen::Vector2d wanted_W = t_s < response_.delay_s ? last_cmd_W : brakes ? Eigen::Vector2d::Zero() : v_cmd_W;
    if (brakes && last.v_W.norm() < kStoppedMps) break;
    Eigen::Vector2d a_W = (wanted_W - last.v_W) / response_.lag_s;
    const double most = brakes ? response_.braking_mps2 : response_.acceleration_mps2;
    if (a_W.norm() > most) a_W *= most / a_W.norm();
    const Eigen::Vector2d v_W = last.v_W + kStepS * a_W;
    path.push_back({last.t_s + kStepS, last.p_W + 0.5 * kStepS * (last.v_W + v_W), v_W});
  }
  return path;
}

StopPlanner::Plan StopPlanner::choose(const PathState& now, const Eigen::Vector2d& last_cmd_W, const DeficitAt& deficit,
                                      const Threat& threat_m, const ToGoal& to_goal_m) const {
  Search search(*this, now, last_cmd_W, deficit, threat_m, to_goal_m);
  // Directions out of view are known only from memory, with a less accurate position.
  const auto blind_mps = [&](const Eigen::Vector2d& v_cmd_W) {
    const double past_mps = v_cmd_W.norm() - kBlindMps;
    return past_mps > 0.0 && !looks_along_(std::atan2(v_cmd_W.y(), v_cmd_W.x())) ? past_mps : 0.0;
  };
  const auto consider = [&](const Eigen::Vector2d& v_cmd_W) {
    search.consider(v_cmd_W, kTurnPriceS2pm * speed_mps_ * (v_cmd_W - last_cmd_W).norm(), blind_mps(v_cmd_W));
  };
  consider(Eigen::Vector2d::Zero());
  for (int i = 0; i < kDirections; ++i) {
    const double azimuth_rad = 2.0 * std::numbers::pi * i / kDirections;
    const Eigen::Vector2d direction_W(std::cos(azimuth_rad), std::sin(azimuth_rad));
    for (const double share : kShares) consider(share * speed_mps_ * direction_W);
  }
  return std::move(search).best();
}

double threat_m(std::span<const PathState> path, std::span<const MovingObstacle> moving_obstacles,
                const Clearance& clearance, double t_s) {
  constexpr double kStepS = 0.1;
  double worst_m = 0.0, sum_m = 0.0;
  const auto meet = [&](const PathState& state) {
    const double margin_m = clearance.margin_m + clearance.margin_s * state.v_W.norm();
    double here_m = 0.0;
    for (const MovingObstacle& obstacle : moving_obstacles) {
      const double dt_s = state.t_s - t_s;
      const double sigma_m = std::min(obstacle.p_sigma_m + obstacle.v_sigma_mps * std::max(0.0, dt_s), kMaxSigmaM);
      const Eigen::Vector2d then_W = state.p_W - dt_s * obstacle.v_W;
      double from_m = (then_W - obstacle.p_W).norm() - obstacle.radius_m;
      if (obstacle.v_sigma_mps > kVagueMps)
        from_m = std::min(from_m, (state.p_W - obstacle.p_W).norm() - obstacle.radius_m);
      if (!obstacle.surface_W.empty()) from_m = std::min(from_m, away_m(obstacle.surface_W, then_W));
      here_m = std::max(here_m, clearance.hull_m + margin_m + kBesideM + sigma_m - from_m);
    }
    worst_m = std::max(worst_m, here_m);
    sum_m += here_m;
  };
  if (moving_obstacles.empty()) return 0.0;
  for (const PathState& state : path) meet(state);
  PathState stands{path.back().t_s, path.back().p_W, Eigen::Vector2d::Zero()};
  while ((stands.t_s += kStepS) < path.front().t_s + kForeseenS) meet(stands);
  return 0.5 * (worst_m + sum_m * kStepS / kForeseenS);
}

const MovingObstacle* nearest_approaching(const PathState& now, std::span<const MovingObstacle> moving_obstacles,
                                          double hull_m) {
  const MovingObstacle* nearest = nullptr;
  double least_m = kNearM;
  for (const MovingObstacle& obstacle : moving_obstacles) {
    const Eigen::Vector2d off_W = obstacle.p_W - now.p_W, v_W = obstacle.v_W - now.v_W;
    constexpr double kStandsM2ps2 = 1e-6;
    const double closest_s = std::clamp(-off_W.dot(v_W) / std::max(v_W.squaredNorm(), kStandsM2ps2), 0.0, kForeseenS);
    const double away_m = (off_W + closest_s * v_W).norm() - obstacle.radius_m - hull_m;
    if (away_m >= least_m) continue;
    least_m = away_m;
    nearest = &obstacle;
  }
  return nearest;
}

}  // namespace hedgehop::avoidance::local_map
