#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"

namespace hedgehop::sim {

/// Clearances of the hull, and whether it collides.
struct Proximity {
  double obstacle_clearance_m = std::numeric_limits<double>::infinity();  ///< to the nearest solid; < 0: depth inside
  double ground_clearance_m =
      std::numeric_limits<double>::infinity();  ///< of the hull's lowest point; < 0: below ground
  std::optional<size_t> nearest_solid;          ///< index of scenes::solid_at(); nullopt beyond the search radius
  Eigen::Vector3d nearest_point_W = Eigen::Vector3d::Zero();  ///< on the nearest solid, m; zero without one
  bool collided = false;                                      ///< the hull is in contact with a solid or the ground
};

/// The solids of a scene and one hull, for one flight. Results depend on the arguments only; earlier queries speed up
/// later ones.
class CollisionWorld {
 public:
  /// Throws std::invalid_argument if the hull is empty, or as make_body() and make_bodies().
  CollisionWorld(const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull);
  ~CollisionWorld();
  CollisionWorld(CollisionWorld&&) noexcept;
  CollisionWorld& operator=(CollisionWorld&&) noexcept;

  /// Returns the exact clearances of the hull at a pose, to about 1e-6 m.
  /// @param X_WB             pose of the vehicle, finite.
  /// @param search_radius_m  solids farther than this from the hull are ignored, > 0; +inf for the whole scene.
  /// @param t_s              time of the movers' positions, >= 0.
  Proximity query(const Eigen::Isometry3d& X_WB, double search_radius_m, double t_s);

  /// Returns the height of a point above the roof or ground below it, m: 0 inside a solid or below ground, +inf without
  /// a surface below. @param t_s  time of the movers' positions, >= 0.
  double height_above_surface(const Eigen::Vector3d& p_WB, double t_s) const;

  /// Returns the distance from a point along a beam to the first solid or ground, m: 0 inside a solid or below ground,
  /// +inf without a surface within reach. @param direction_W  of length 1. @param reach_m  finite, > 0.
  /// @param t_s  time of the movers' positions, >= 0.
  double distance_along(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m,
                        double t_s) const;

 private:
  class World;
  std::unique_ptr<World> world_;
};

/// Returns the version of Bullet, such as "Bullet 3.24".
std::string bullet_version();

}  // namespace hedgehop::sim
