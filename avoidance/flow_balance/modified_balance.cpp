#include "avoidance/flow_balance/modified_balance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "avoidance/heading.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::flow_balance {

size_t RangeRing::sector_of(const Eigen::Vector2d& direction_W) {
  const double turns = std::atan2(direction_W.y(), direction_W.x()) / (2.0 * std::numbers::pi);
  return static_cast<size_t>(std::lround((turns + 1.0) * kSectors)) % kSectors;
}

void RangeRing::keep_nearer(const RingPoint& point) {
  std::optional<RingPoint>& held = points_[sector_of(point.p_BP_W)];
  if (!held || point.p_BP_W.squaredNorm() < held->p_BP_W.squaredNorm()) held = point;
}

void RangeRing::carry(const Eigen::Vector2d& v_WB_W, int64_t t_ns) {
  const Eigen::Vector2d moved_W = seconds(t_ns - now_ns_) * v_WB_W;
  now_ns_ = t_ns;
  const int64_t memory_ns = std::llround(options_.memory_s * 1e9);
  const auto before = points_;
  points_.fill(std::nullopt);
  for (const std::optional<RingPoint>& point : before) {
    if (point && t_ns - point->seen_ns <= memory_ns) keep_nearer({point->p_BP_W - moved_W, point->seen_ns});
  }
}

void RangeRing::release(std::optional<RingPoint>& point, double inverse_range_per_m, double share) const {
  if (!point) return;
  if (share >= 1.0) {
    point.reset();
    return;
  }
  const double held_per_m = 1.0 / point->p_BP_W.norm();
  const double released_per_m = held_per_m + share * (inverse_range_per_m - held_per_m);
  if (released_per_m >= held_per_m) return;
  if (released_per_m * kFarM <= 1.0) {
    point.reset();
    return;
  }
  point->p_BP_W *= held_per_m / released_per_m;
  if (inverse_range_per_m * kFarM > 1.0) point->seen_ns = now_ns_;
}

void RangeRing::add(const std::vector<RangeColumn>& columns, double heading_rad, double dt_s) {
  constexpr double kMinWeight = 0.5;  // below this weight, a missing range does not mean free space
  const double share = options_.release_s > 0.0 ? 1.0 - std::exp(-dt_s / options_.release_s) : 1.0;
  for (const RangeColumn& column : columns) {
    const Eigen::Vector2d direction_W = rotated(column.direction_H, heading_rad);
    if (column.weight >= kMinWeight) release(points_[sector_of(direction_W)], column.inverse_range_per_m, share);
    if (column.inverse_range_per_m * kFarM > 1.0) keep_nearer({direction_W / column.inverse_range_per_m, now_ns_});
  }
}

std::vector<Eigen::Vector2d> RangeRing::obstacles_W() const {
  std::vector<Eigen::Vector2d> obstacles_W;
  for (const std::optional<RingPoint>& point : points_) {
    if (point) obstacles_W.push_back(point->p_BP_W);
  }
  return obstacles_W;
}

Eigen::Vector2d push_from_obstacles(const std::vector<Eigen::Vector2d>& obstacles_W, const Eigen::Vector2d& aim_W,
                                    double gain_m2ps) {
  constexpr size_t kNearest = 3;   // a single point may come from a wrong vector
  constexpr double kTouchM = 0.1;  // minimum distance that is distinguished
  Eigen::Vector2d push_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d axis_W = aim_W.normalized();
  for (int quarter = 0; quarter < 4; ++quarter, axis_W = {-axis_W.y(), axis_W.x()}) {
    std::vector<Eigen::Vector2d> inverse_W;  // along the direction of each point, with its inverse range as length
    for (const Eigen::Vector2d& p_BP_W : obstacles_W) {
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

double Detour::update(double goal_distance_m, double t_s) {
  constexpr double kProgressM = 3.0;  // more than the drift of the position estimate in a few seconds
  if (patience_s_ <= 0.0) return 0.0;
  if (goal_distance_m < nearest_m_ - kProgressM) {
    nearest_m_ = goal_distance_m;
    progress_s_ = t_s;
    fruitless_ = 0;
  }
  if (t_s < until_s_) return side_ * kAngleRad;
  if (t_s - progress_s_ < patience_s_) return 0.0;
  side_ = -side_;
  until_s_ = t_s + std::ldexp(kDurationS, std::min(fruitless_ / 2, kMaxDoublings));
  progress_s_ = until_s_;
  ++count_;
  ++fruitless_;
  return side_ * kAngleRad;
}

}  // namespace hedgehop::avoidance::flow_balance
