#include "avoidance/local_map/outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kRoundM = 1e-6;
constexpr double kShortestM = 0.1;  // half the length of what a disc holds of a box

void cover(const Eigen::AlignedBox3d& box, double radius_m, std::vector<Outline::Disc>& discs) {
  const Eigen::Vector2d middle_H = box.center().head<2>(), half = 0.5 * box.sizes().head<2>();
  if ((middle_H.cwiseAbs() + half).norm() > radius_m + kRoundM) {
    discs.push_back({middle_H, half.maxCoeff()});
    return;
  }
  const Eigen::Index along = half.x() >= half.y() ? 0 : 1;
  const double wide_m = std::max(half(1 - along), kShortestM);
  const int count = std::max(1, static_cast<int>(std::ceil(half(along) / wide_m)));
  const double step_m = half(along) / count;  // half a disc's share of the length
  for (int i = 0; i < count; ++i) {
    Eigen::Vector2d p_H = middle_H;
    p_H(along) += (2 * i + 1 - count) * step_m;
    discs.push_back({p_H, std::hypot(step_m, half(1 - along))});
  }
}

/// How far the discs reach in a direction, m.
double reach_m(const std::vector<Outline::Disc>& discs, double azimuth_rad) {
  const Eigen::Vector2d u(std::cos(azimuth_rad), std::sin(azimuth_rad));
  double most_m = 0.0;
  for (const Outline::Disc& disc : discs) most_m = std::max(most_m, disc.p_H.dot(u) + disc.radius_m);
  return most_m;
}

}  // namespace

Outline::Outline(const VehicleLimits& limits) : discs_{{Eigen::Vector2d::Zero(), limits.radius_m}} {
  std::vector<Disc> all;
  for (const Eigen::AlignedBox3d& box_B : limits.outline_B) cover(box_B, limits.radius_m, all);
  // The largest first; what they hold is left out.
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
  constexpr size_t kMost = 12;
  double least_m = limits.radius_m;
  for (int i = 0; i < kDirections; ++i) least_m = std::min(least_m, reach_m(kept, 2.0 * M_PI * i / kDirections));
  if (!kept.empty() && kept.size() <= kMost && least_m < kLittle * limits.radius_m) discs_ = kept;
}

std::vector<Outline::Disc> sweep(const Outline& outline, double from_rad, double to_rad, double step_m) {
  const double turn_rad = std::remainder(to_rad - from_rad, 2.0 * M_PI);
  std::vector<Outline::Disc> swept;
  for (const Outline::Disc& disc : outline.discs()) {
    const int steps = static_cast<int>(std::ceil(std::abs(turn_rad) * disc.p_H.norm() / step_m));
    for (int i = 0; i <= steps; ++i) {
      const double heading_rad = from_rad + (steps > 0 ? turn_rad * i / steps : 0.0);
      swept.push_back({Eigen::Rotation2Dd(heading_rad) * disc.p_H, disc.radius_m});
    }
  }
  return swept;
}

}  // namespace hedgehop::avoidance::local_map
