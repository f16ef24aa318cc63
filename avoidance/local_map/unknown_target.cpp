#include "avoidance/local_map/unknown_target.h"

#include <algorithm>
#include <cmath>

#include "avoidance/heading.h"

namespace hedgehop::avoidance::local_map {

bool is_unknown(const LevelSlice& slice, const Eigen::Vector2d& p_W) {
  const Eigen::Vector2i cell = slice.cell(p_W);
  return slice.contains(cell.x(), cell.y()) && slice.at(cell.x(), cell.y()) == LevelSlice::State::unknown;
}

std::optional<Eigen::Vector2d> unknown_on_path(const LevelSlice& slice, const HullClearance& hull_clearance,
                                               const std::vector<PathState>& path, double reach_m) {
  const auto first = std::ranges::find_if(
      path, [&](const PathState& m) { return hull_clearance.deficit(slice, m, true).unknown_m > 0.0; });
  if (first == path.end()) return std::nullopt;
  std::optional<Eigen::Vector2d> nearest;
  const Eigen::Vector2i here = slice.cell(first->p_W);
  const int reach = static_cast<int>(std::ceil(reach_m / slice.cell_m())) + 2;
  for (int row = here.x() - reach; row <= here.x() + reach; ++row) {
    for (int col = here.y() - reach; col <= here.y() + reach; ++col) {
      if (!slice.contains(row, col) || slice.at(row, col) != LevelSlice::State::unknown) continue;
      const Eigen::Vector2d center_W = slice.center(row, col);
      if (nearest && (center_W - first->p_W).norm() >= (*nearest - first->p_W).norm()) continue;
      nearest = center_W;
    }
  }
  return nearest;
}

bool points_at(const Eigen::Vector2d& place_W, const Eigen::Vector2d& p_W, double heading_rad) {
  constexpr double kAimedRad = 0.35;
  const Eigen::Vector2d off_W = place_W - p_W;
  return std::abs(wrap_angle(std::atan2(off_W.y(), off_W.x()) - heading_rad)) < kAimedRad;
}

double ProgressTimer::stalled_s(std::optional<double> route_m, double t_s) {
  constexpr double kShorterM = 1.0, kLongerM = 3.0;  // changes that indicate another route or new observations
  if (route_m && (!from_m_ || *route_m < *from_m_ - kShorterM || *route_m > *from_m_ + kLongerM)) {
    from_m_ = route_m;
    since_s_ = t_s;
  }
  return from_m_ ? t_s - since_s_ : 0.0;
}

void UnknownTarget::update(bool held, const std::vector<PathState>& hoped, const LevelSlice& slice,
                           const HullClearance& hull_clearance, double reach_m, const PathState& now,
                           double heading_rad) {
  const bool unknown_still = place_W_ && is_unknown(slice, *place_W_);
  if (!held && !(unknown_still && backs_off_ && points_at(*place_W_, now.p_W, heading_rad))) place_W_.reset();
  if (held && !unknown_still) place_W_ = unknown_on_path(slice, hull_clearance, hoped, reach_m);
  backs_off_ = place_W_ && (backs_off_ || is_hovering(now.v_W));
}

std::optional<double> UnknownTarget::inspected_s(const PathState& now, const Eigen::Vector2d& v_cmd_W,
                                                 double heading_rad) {
  return inspection_.update(
      place_W_ && is_hovering(now.v_W) && is_hovering(v_cmd_W) && points_at(*place_W_, now.p_W, heading_rad), now.t_s);
}

bool is_hovering(const Eigen::Vector2d& v_W) {
  constexpr double kStandsMps = 0.3;
  return v_W.norm() < kStandsMps;
}

}  // namespace hedgehop::avoidance::local_map
