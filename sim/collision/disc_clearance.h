#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "scenes/scene.h"
#include "sim/collision/proximity.h"

namespace hedgehop::sim {

/// A level disc: an upright cylinder with its center at an altitude.
struct LevelDisc {
  double radius_m = 0.0, half_thickness_m = 0.0, altitude_m = 0.0;
};

/// The clearance of a level disc in a scene at time 0. Upright boxes, upright cylinders and spheres, of which most
/// scenes consist, have closed forms; all other solids are left to a CollisionWorld, which takes about twenty times
/// longer.
class DiscClearance {
 public:
  /// @param bounds_NE_m  of the places, not empty. @param reach_m  obstacles beyond have no effect, > 0.
  DiscClearance(const scenes::Scene& scene, const LevelDisc& disc, const Eigen::AlignedBox2d& bounds_NE_m,
                double reach_m);

  /// Returns the clearance of the disc at a place within the bounds, m, 0 to reach_m; 0 in contact, also with the
  /// ground.
  double at(const Eigen::Vector2d& p_NE_m);

 private:
  /// A solid whose distance from the disc is sqrt(h^2 + gap^2) - rounding, where h is the horizontal distance of the
  /// disc's rim from the footprint: a rectangle, a disc or, for a sphere, a point.
  struct Upright {
    Eigen::Vector2d center_NE_m;
    Eigen::Matrix2d R_SW = Eigen::Matrix2d::Identity();              ///< in the plan
    Eigen::Vector2d half_extents_m = Eigen::Vector2d::Zero();        ///< of the rectangle
    double footprint_radius_m = 0.0, rounding_m = 0.0, gap_m = 0.0;  ///< gap: vertical
  };

  static std::optional<Upright> upright(const scenes::Solid& solid, const LevelDisc& disc);
  double clearance_m(const Upright& solid, const Eigen::Vector2d& p_NE_m) const;
  void list(const Upright& solid, const Eigen::AlignedBox3d& bounds_W);
  Eigen::Array2i cell(const Eigen::Vector2d& p_NE_m) const;

  LevelDisc disc_;
  double reach_m_;
  bool on_ground_;
  Eigen::Vector2d origin_NE_m_;
  Eigen::Array2i cells_;
  std::vector<std::vector<Upright>> near_;  ///< of each cell of the plan, those within reach of a place in it
  std::optional<CollisionWorld> others_;
};

}  // namespace hedgehop::sim
