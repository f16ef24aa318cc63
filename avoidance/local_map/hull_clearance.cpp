#include "avoidance/local_map/hull_clearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "avoidance/heading.h"

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kRoundM = 1e-6;
constexpr double kMinHalfLengthM = 0.1;  // minimum half length of the part of a box in one disc

void cover(const Eigen::AlignedBox3d& box, double radius_m, std::vector<HullDiscs::Disc>& discs) {
  const Eigen::Vector2d middle_H = box.center().head<2>(), half = 0.5 * box.sizes().head<2>();
  if ((middle_H.cwiseAbs() + half).norm() > radius_m + kRoundM) {
    discs.push_back({middle_H, half.maxCoeff()});
    return;
  }
  const Eigen::Index along = half.x() >= half.y() ? 0 : 1;
  const double wide_m = std::max(half(1 - along), kMinHalfLengthM);
  const int count = std::max(1, static_cast<int>(std::ceil(half(along) / wide_m)));
  const double step_m = half(along) / count;  // half the length of the part in one disc
  for (int i = 0; i < count; ++i) {
    Eigen::Vector2d p_H = middle_H;
    p_H(along) += (2 * i + 1 - count) * step_m;
    discs.push_back({p_H, std::hypot(step_m, half(1 - along))});
  }
}

/// Returns the extent of the discs in a direction, m.
double reach_m(const std::vector<HullDiscs::Disc>& discs, double azimuth_rad) {
  const Eigen::Vector2d u(std::cos(azimuth_rad), std::sin(azimuth_rad));
  double most_m = 0.0;
  for (const HullDiscs::Disc& disc : discs) most_m = std::max(most_m, disc.p_H.dot(u) + disc.radius_m);
  return most_m;
}

constexpr double kUnsureS = 0.05;  // flight time that corresponds to the error of the boundary of unknown space

}  // namespace

HullDiscs::HullDiscs(const VehicleLimits& limits) : discs_{{Eigen::Vector2d::Zero(), limits.radius_m}} {
  std::vector<Disc> all;
  for (const Eigen::AlignedBox3d& box_B : limits.outline_B) cover(box_B, limits.radius_m, all);
  // Largest first; discs inside larger ones are omitted.
  std::ranges::sort(all, std::ranges::greater{}, &Disc::radius_m);
  std::vector<Disc> kept;
  for (const Disc& disc : all) {
    const auto holds = [&](const Disc& larger) {
      return (disc.p_H - larger.p_H).norm() + disc.radius_m <= larger.radius_m + kRoundM;
    };
    if (std::ranges::none_of(kept, holds)) kept.push_back(disc);
  }
  constexpr int kDirections = 16;
  constexpr double kLittle = 0.85;
  constexpr size_t kMaxSquares = 12;
  double least_m = limits.radius_m;
  for (int i = 0; i < kDirections; ++i) least_m = std::min(least_m, reach_m(kept, 2.0 * M_PI * i / kDirections));
  if (!kept.empty() && kept.size() <= kMaxSquares && least_m < kLittle * limits.radius_m) discs_ = kept;
}

std::vector<HullDiscs::Disc> sweep(const HullDiscs& hull_discs, double from_rad, double to_rad, double step_m) {
  const double turn_rad = wrap_angle(to_rad - from_rad);
  std::vector<HullDiscs::Disc> swept;
  for (const HullDiscs::Disc& disc : hull_discs.discs()) {
    const int steps = static_cast<int>(std::ceil(std::abs(turn_rad) * disc.p_H.norm() / step_m));
    for (int i = 0; i <= steps; ++i) {
      const double heading_rad = from_rad + (steps > 0 ? turn_rad * i / steps : 0.0);
      swept.push_back({Eigen::Rotation2Dd(heading_rad) * disc.p_H, disc.radius_m});
    }
  }
  return swept;
}

void HullClearance::keep_from_unknown(const LevelSlice& slice, const Eigen::Vector2d& p_W, double margin_m,
                                      double half_view_rad) {
  unknown_margin_ = {};
  if (margin_m <= 0.0) return;
  double now_m = margin_m;
  for (const HullDiscs::Disc& disc : swept_) {
    now_m = std::min(now_m, slice.to_unknown_m(p_W + disc.p_H) - disc.radius_m - 0.5 * slice.cell_m());
  }
  const double wide_m = clearance_.hull_m + margin_m + slice.cell_m();
  unknown_margin_ = {p_W, wide_m / std::sin(half_view_rad), std::max(now_m, 0.0), margin_m};
}

ClearanceDeficit HullClearance::deficit(const LevelSlice& slice, const PathState& state, bool unknown_too) const {
  const double margin_m = clearance_.margin_m + clearance_.margin_s * state.v_W.norm();
  const double unsure_m = kUnsureS * state.v_W.norm();
  const bool close_by = clearance_.margin_m <= 0.5 * slice.cell_m();  // below the error of a look-up
  const bool is_far = (state.p_W - unknown_margin_.from_W).norm() > unknown_margin_.beyond_m;
  const double from_unknown_m = is_far ? unknown_margin_.far_m : unknown_margin_.near_m;
  ClearanceDeficit worst;
  for (const HullDiscs::Disc& disc : swept_) {
    const Eigen::Vector2d p_W = state.p_W + disc.p_H;
    const double keeps_m = disc.radius_m + margin_m;
    const double away_m = close_by ? slice.exactly_to_occupied_m(p_W, keeps_m) : slice.to_occupied_m(p_W);
    worst.occupied_m = std::max(worst.occupied_m, keeps_m - away_m);
    if (!unknown_too) continue;
    worst.unknown_m = std::max(worst.unknown_m, disc.radius_m + from_unknown_m - slice.to_unknown_m(p_W));
    worst.beside_unknown_m = std::max(worst.beside_unknown_m, disc.radius_m + unsure_m - slice.to_unknown_m(p_W));
  }
  return worst;
}

double HullClearance::free_turn_rad(const LevelSlice& slice, const std::vector<PathState>& path, double from_rad,
                                    double to_rad) const {
  constexpr double kStepRad = 0.2, kSlackM = 0.02;
  const double turn_rad = wrap_angle(to_rad - from_rad);
  const int steps = hull_discs_.discs().size() > 1 ? static_cast<int>(std::ceil(std::abs(turn_rad) / kStepRad)) : 0;
  const auto worst_of = [&](const HullClearance& turned) {
    ClearanceDeficit most;
    for (const PathState& state : path) {
      const ClearanceDeficit there = turned.deficit(slice, state, true);
      most.occupied_m = std::max(most.occupied_m, there.occupied_m);
      most.unknown_m = std::max(most.unknown_m, there.unknown_m);
    }
    return most;
  };
  HullClearance turned = *this;
  turned.set_turn(from_rad, from_rad);
  const ClearanceDeficit before = worst_of(turned);
  for (int i = 1; i <= steps; ++i) {
    const double from = from_rad + turn_rad * (i - 1) / steps, to = from_rad + turn_rad * i / steps;
    turned.set_turn(from, to);
    const ClearanceDeficit then = worst_of(turned);
    if (then.occupied_m > before.occupied_m + kSlackM || then.unknown_m > before.unknown_m + kSlackM) return from;
  }
  return to_rad;
}

}  // namespace hedgehop::avoidance::local_map
