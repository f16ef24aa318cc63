#include "sim/collision/disc_clearance.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::sim {
namespace {

constexpr double kCellM = 4.0;

}  // namespace

std::optional<DiscClearance::Upright> DiscClearance::upright(const scenes::Solid& solid, const LevelDisc& disc) {
  constexpr double kLevel = 1e-12;  // of the rotation matrix's entries
  const Eigen::Matrix3d R_WS = solid.X_WS.linear();
  const bool is_upright =
      std::max({std::abs(R_WS(0, 2)), std::abs(R_WS(1, 2)), std::abs(R_WS(2, 0)), std::abs(R_WS(2, 1))}) < kLevel;
  if (solid.shape != scenes::Solid::Shape::sphere &&
      (!is_upright || (solid.shape != scenes::Solid::Shape::box && solid.shape != scenes::Solid::Shape::cylinder)))
    return {};
  Upright found{.center_NE_m = solid.X_WS.translation().head<2>()};
  const double apart_m = std::abs(solid.X_WS.translation().z() + disc.altitude_m);
  double half_height_m = disc.half_thickness_m;
  if (solid.shape == scenes::Solid::Shape::sphere) {
    found.rounding_m = solid.half_extents_m.x();
  } else {
    half_height_m += solid.half_extents_m.z();
    if (solid.shape == scenes::Solid::Shape::cylinder) {
      found.footprint_radius_m = solid.half_extents_m.x();
    } else {
      found.R_SW = R_WS.topLeftCorner<2, 2>().transpose();
      found.half_extents_m = solid.half_extents_m.head<2>();
    }
  }
  found.gap_m = std::max(0.0, apart_m - half_height_m);
  return found;
}

double DiscClearance::clearance_m(const Upright& solid, const Eigen::Vector2d& p_NE_m) const {
  const Eigen::Array2d outside_m =
      (solid.R_SW * (p_NE_m - solid.center_NE_m)).array().abs() - solid.half_extents_m.array();
  const double apart_m = outside_m.max(0.0).matrix().norm() - solid.footprint_radius_m - disc_.radius_m;
  const double rim_m = std::max(0.0, apart_m);
  return std::sqrt(rim_m * rim_m + solid.gap_m * solid.gap_m) - solid.rounding_m;
}

DiscClearance::DiscClearance(const scenes::Scene& scene, const LevelDisc& disc, const Eigen::AlignedBox2d& bounds_NE_m,
                             double reach_m)
    : disc_(disc),
      reach_m_(reach_m),
      on_ground_(scene.has_ground && disc.altitude_m <= disc.half_thickness_m),
      origin_NE_m_(bounds_NE_m.min()),
      cells_((bounds_NE_m.sizes().array() / kCellM).cast<int>() + 1),
      near_(static_cast<size_t>(cells_.x()) * static_cast<size_t>(cells_.y())) {
  scenes::Scene others;
  others.has_ground = false;
  others.movers = scene.movers;
  for (const scenes::Solid& solid : scene.solids) {
    if (const std::optional<Upright> found = upright(solid, disc)) {
      if (found->gap_m - found->rounding_m < reach_m) list(*found, scenes::bounds_W(solid));
    } else {
      others.solids.push_back(solid);
    }
  }
  if (others.solids.empty() && others.movers.empty()) return;
  const dynamics::HullPart hull{.shape = dynamics::HullPart::Shape::cylinder,
                                .half_extents_m = {disc.radius_m, disc.radius_m, disc.half_thickness_m}};
  others_.emplace(others, std::vector{hull});
}

Eigen::Array2i DiscClearance::cell(const Eigen::Vector2d& p_NE_m) const {
  return ((p_NE_m - origin_NE_m_).array() / kCellM).floor().cast<int>().max(0).min(cells_ - 1);
}

void DiscClearance::list(const Upright& solid, const Eigen::AlignedBox3d& bounds_W) {
  const double margin_m = reach_m_ + disc_.radius_m;
  const Eigen::Array2i first = cell(bounds_W.min().head<2>().array() - margin_m),
                       last = cell(bounds_W.max().head<2>().array() + margin_m);
  for (int row = first.x(); row <= last.x(); ++row) {
    for (int col = first.y(); col <= last.y(); ++col)
      near_[static_cast<size_t>(row * cells_.y() + col)].push_back(solid);
  }
}

double DiscClearance::at(const Eigen::Vector2d& p_NE_m) {
  if (on_ground_) return 0.0;
  const Eigen::Array2i at = cell(p_NE_m);
  double min_m = reach_m_;
  for (const Upright& solid : near_[static_cast<size_t>(at.x() * cells_.y() + at.y())]) {
    min_m = std::min(min_m, clearance_m(solid, p_NE_m));
  }
  if (others_ && min_m > 0.0) {
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    X_WB.translation() = Eigen::Vector3d(p_NE_m.x(), p_NE_m.y(), -disc_.altitude_m);
    min_m = std::min(min_m, others_->query(X_WB, min_m, 0.0).obstacle_clearance_m);
  }
  return std::max(0.0, min_m);
}

}  // namespace hedgehop::sim
