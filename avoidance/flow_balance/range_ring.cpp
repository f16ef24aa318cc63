#include "avoidance/flow_balance/range_ring.h"

#include <cmath>
#include <numbers>

#include "avoidance/heading.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::flow_balance {

size_t RangeRing::sector_of(const Eigen::Vector2d& direction_W) {
  const double turns = std::atan2(direction_W.y(), direction_W.x()) / (2.0 * std::numbers::pi);
  return static_cast<size_t>(std::lround((turns + 1.0) * kSectors)) % kSectors;
}

void RangeRing::keep_nearer(const Place& place) {
  std::optional<Place>& held = places_[sector_of(place.p_BP_W)];
  if (!held || place.p_BP_W.squaredNorm() < held->p_BP_W.squaredNorm()) held = place;
}

void RangeRing::carry(const Eigen::Vector2d& v_WB_W, int64_t t_ns) {
  const Eigen::Vector2d moved_W = seconds(t_ns - now_ns_) * v_WB_W;
  now_ns_ = t_ns;
  const auto before = places_;
  places_.fill(std::nullopt);
  for (const std::optional<Place>& place : before) {
    if (place && t_ns - place->seen_ns <= kKeepNs) keep_nearer({place->p_BP_W - moved_W, place->seen_ns});
  }
}

void RangeRing::add(const std::vector<RangeColumn>& columns, double heading_rad) {
  constexpr double kLeastWeight = 0.5;  // with less, nothing measured does not mean nothing there
  constexpr double kFarM = 40.0;        // what is farther does not push
  for (const RangeColumn& column : columns) {
    const Eigen::Vector2d direction_W = rotated(column.direction_H, heading_rad);
    if (column.weight >= kLeastWeight) places_[sector_of(direction_W)].reset();
    if (column.inverse_range_per_m * kFarM > 1.0) keep_nearer({direction_W / column.inverse_range_per_m, now_ns_});
  }
}

std::vector<Eigen::Vector2d> RangeRing::places_W() const {
  std::vector<Eigen::Vector2d> places_W;
  for (const std::optional<Place>& place : places_) {
    if (place) places_W.push_back(place->p_BP_W);
  }
  return places_W;
}

}  // namespace hedgehop::avoidance::flow_balance
